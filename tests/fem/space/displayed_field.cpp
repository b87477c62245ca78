#include <gtest/gtest.h>

#include <cmath>

#include "fem/space/space.h"
#include "mesh/smooth_mesh.h"
#include "mesh/uniform.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

double wave(const Vec3& x) { return std::sin(2 * x.x() + 1) * std::cos(1.5 * x.y()) + x.x() * x.z(); }

/// sqrt(int (displayed - f)²) of f's best approximation of an order, made continuous, on elements of which every third is
/// cut into four.
double distance(const mesh::ElementMesh& mesh, int order) {
  std::vector<Panel> panels;
  for (const scene::SurfacePatch& patch : mesh.patches()) panels.push_back(panel_of(patch));
  const Space space(std::move(panels), order);
  const Eigen::VectorXd c = space.project([](Index, const Vec3& x) { return wave(x); }, 4);
  const mesh::SmoothMesh smooth = mesh::smooth_mesh(mesh);
  const auto values = mesh::smoothed<double>(smooth, [&](std::uint32_t element, const Vec3& x) {
    const mesh::ElementPoint at = mesh::coordinates_in(mesh.patches()[element], {element}, x);
    return space.value(c, static_cast<Index>(element), at.u, at.v);
  });
  double sum = 0;
  for (const mesh::SmoothMesh::Triangle& t : smooth.triangles) {
    std::array<Vec3, 3> p{smooth.points[t[0]], smooth.points[t[1]], smooth.points[t[2]]};
    const double area = 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
    for (const RuleNode& node : triangle_rule(8)) {
      const std::array<double, 3> l{1 - node.u - node.v, node.u, node.v};
      double shown = 0;
      for (std::size_t k = 0; k < 3; ++k)
        shown += l[k] * (2 * l[k] - 1) * values[t[k]] + 4 * l[k] * l[(k + 1) % 3] * values[t[3 + k]];
      const double off = shown - wave(l[0] * p[0] + l[1] * p[1] + l[2] * p[2]);
      sum += node.weight * area * off * off;
    }
  }
  return std::sqrt(sum);
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
