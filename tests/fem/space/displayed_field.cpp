#include <gtest/gtest.h>

#include <cmath>

#include "fem/space/space.h"
#include "mesh/uniform.h"
#include "tests/fem/rooms.h"
#include "tests/fem/space/displayed.h"

namespace interflect::fem {
namespace {

double wave(const Vec3& x) { return std::sin(2 * x.x() + 1) * std::cos(1.5 * x.y()) + x.x() * x.z(); }

/// sqrt(int (displayed - f)²) of f's best approximation of an order, made continuous, on elements of which every third
/// is cut into four.
double distance(const mesh::ElementMesh& mesh, int order) {
  std::vector<Panel> panels;
  for (const scene::SurfacePatch& patch : mesh.patches()) panels.push_back(panel_of(patch));
  const Space space(std::move(panels), order);
  const Eigen::VectorXd c = space.project([](Index, const Vec3& x) { return wave(x); }, 4);
  return test::displayed_distance(
      mesh,
      [&](std::uint32_t element, const Vec3& x) {
        const mesh::ElementPoint at = mesh::coordinates_in(mesh.patches()[element], {element}, x);
        return space.value(c, static_cast<Index>(element), at.u, at.v);
      },
      [](std::uint32_t, const Vec3& x) { return wave(x); });
}

// What is looked at converges as the polynomials do: order 2 of linear ones, 3 of quadratic ones, with hanging corners.
TEST(DisplayedField, has_the_order_of_its_polynomials) {
  test::Room room;
  room.wall({0, 0, 0}, {1, 0, .3}, {0, 1, 0}, 1);
  room.triangle({2, 0, 0}, {3.2, .1, 0}, {2.3, 1, .4});
  const scene::Scene scene = room.finish();
  for (const int order : {0, 1, 2}) {
    double before = 0;
    for (const double size : {.26, .13, .065}) {
      const mesh::ElementMesh coarse = mesh::uniform(scene, size);
      std::vector<bool> which(coarse.patches().size());
      for (std::size_t i = 0; i < which.size(); i += 3) which[i] = true;
      const double now = distance(mesh::quartered(coarse, which).mesh, order);
      if (before > 0) {
        EXPECT_GT(std::log2(before / now), order + 1 - .2) << order << ' ' << size << ' ' << now;
      }
      before = now;
    }
  }
}

}  // namespace
}  // namespace interflect::fem
