#include "fem/neighbour_error.h"

#include <gtest/gtest.h>

#include "mesh/uniform.h"
#include "scene/builder.h"

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
  for (const scene::SurfacePatch& patch : solution.mesh.patches()) solution.irradiance.push_back(field(patch.centroid()));
  for (std::size_t j = 0; j < solution.irradiance.size(); ++j) {
    const scene::SurfacePatch& patch = solution.mesh.patches()[j];
    for (const Vec3& corner : patch.ring())
      EXPECT_NEAR((solution.irradiance[j] + linear_deviation(solution, j, corner))[0], field(corner)[0], 1e-12) << j;
  }
}

}  // namespace
}  // namespace interflect::fem
