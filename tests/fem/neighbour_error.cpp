#include "fem/neighbour_error.h"

#include <gtest/gtest.h>

#include "fem/assembly.h"
#include "fem/form_factor/point_to_polygon.h"
#include "fem/operator/dense_symmetric.h"
#include "mesh/uniform.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

/// A plane of quartered triangles and quads with an irradiance that is linear in x and y, given by its element means.
TEST(NeighbourError, a_linear_field_is_continued_linearly) {
  scene::SceneBuilder builder({"y"});
  const auto grey = builder.add_material({"grey", Spectrum(0.5), Spectrum(0.0), scene::Sides::front});
  builder.add_polygon("quad", {{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {0, 1, 0}}, {}}, grey);
  builder.add_polygon("triangle", {{{0, 0, 1}, {2, 0, 1}, {0, 1, 1}}, {}}, grey);
  const scene::Scene scene = builder.finish();
  RadiositySolution solution(mesh::quartered(mesh::uniform(scene, 1.0)), 0.5);
  const auto field = [](const Vec3& x) { return Spectrum(7 + 2 * x.x() - 3 * x.y()); };
  for (const scene::SurfacePatch& patch : solution.mesh.patches())
    solution.irradiance.push_back(field(patch.centroid()));
  for (std::size_t j = 0; j < solution.irradiance.size(); ++j) {
    const scene::SurfacePatch& patch = solution.mesh.patches()[j];
    for (const Vec3& corner : patch.ring())
      EXPECT_NEAR((solution.irradiance[j] + linear_deviation(solution, j, corner))[0], field(corner)[0], 1e-12) << j;
  }
}

/// The height at which a point of the floor sees a rectangle of the wall x = 0: the mean over it, weighted by what it
/// sends there.
double seen_height(const Vec3& from, const scene::SurfacePatch& element) {
  constexpr int n = 64;
  const Vec3 corner = element.corner[0], u = (element.corner[1] - corner) / n, v = (element.corner[3] - corner) / n;
  double sum = 0, weight = 0;
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      const Vec3 p = corner + a * u + b * v;
      const double factor =
          point_to_polygon(from, Vec3::UnitZ(), std::array{p, Vec3(p + u), Vec3(p + u + v), Vec3(p + v)});
      sum += factor * (p + (u + v) / 2).z();
      weight += factor;
    }
  return sum / weight;
}

// A floor beside a wall whose irradiance rises with height, 2 + 3 z: the floor's elements see the wall's low end more
// than its constants say (16 parts of a neighbour find where it is seen to some 6 %).  The wall's do not mind the
// floor, which is lit evenly; nor does anything mind a wall that is.
TEST(NeighbourError, is_what_the_near_end_of_a_neighbour_makes_of_its_gradient) {
  test::Room room;
  room.wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, .5);
  room.wall({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1, .5);
  const scene::Scene scene = room.finish();
  RadiositySolution s(mesh::quartered(mesh::uniform(scene, 1.0)), 0.5);
  std::vector<double> areas;
  for (const auto& patch : s.mesh.patches()) areas.push_back(patch.area);
  const auto rays = raycast::make_ray_caster("brute", scene);
  const auto method = make_form_factor_method("gauss-lambert", {scene, s.mesh.patches(), *rays, 1, 1e-6, 16});
  core::LocalRun run(1, 1);
  DenseSymmetric K(areas);
  assemble(*method, s.mesh.patches(), K, run);
  for (const double slope : {3.0, 0.0}) {
    s.irradiance.clear();
    s.reflectance.assign(8, Spectrum(.5));
    for (const auto& patch : s.mesh.patches())
      s.irradiance.emplace_back(patch.surface.value == 0 ? 7.0 : 2 + slope * patch.centroid().z());
    const auto errors = neighbour_errors(s, K, run);
    for (std::size_t i = 0; i < 8; ++i) {
      const scene::SurfacePatch& here = s.mesh.patches()[i];
      double sum = 0;
      for (std::size_t j = 4; j < 8 && i < 4; ++j) {
        const scene::SurfacePatch& there = s.mesh.patches()[j];
        if ((here.centroid() - there.centroid()).norm() >= 1.5 * 2 * std::sqrt(.125)) continue;
        const double F = K.entry(static_cast<Index>(i), static_cast<Index>(j)) / here.area;
        sum += F * .5 * slope * (seen_height(here.centroid(), there) - there.centroid().z());
      }
      const double expected = (1 + std::sqrt(2.0)) * std::abs(sum);
      EXPECT_NEAR(errors[i][0], expected, 0.07 * expected + 1e-12) << i;
    }
    EXPECT_EQ(errors[0][0] > 0.01, slope > 0) << "it is not nothing";
  }
}

}  // namespace
}  // namespace interflect::fem
