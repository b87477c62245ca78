#include "mesh/shared_corners.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "mesh/uniform.h"
#include "scene/builder.h"
#include "tests/mesh/scenes.h"

namespace interflect::mesh {
namespace {

ElementMesh hanging(const scene::Scene& scene, int passes) {
  ElementMesh mesh = uniform(scene, 0.9);
  for (int pass = 0; pass < passes; ++pass) {
    std::vector<bool> which(mesh.patches().size());
    for (std::size_t i = static_cast<std::size_t>(pass); i < which.size(); i += 5) which[i] = true;
    mesh = quartered(mesh, which).mesh;
  }
  return mesh;
}

// Every corner is where its mean of others says, hanging or not; of a conforming mesh each is its own.
TEST(SharedCorners, are_means_of_corners_that_do_not_hang) {
  for (const int passes : {0, 1, 3}) {
    const ElementMesh mesh = hanging(mixed_scene(), passes);
    const SharedCorners corners = shared_corners(mesh);
    int hang = 0;
    for (std::size_t i = 0; i < mesh.patches().size(); ++i)
      for (std::size_t k = 0; k < mesh.patches()[i].corners; ++k) {
        Vec3 place = Vec3::Zero();
        double sum = 0;
        for (const auto& [corner, weight] : corners.of[i][k]) {
          place += weight * corners.position[corner];
          sum += weight;
        }
        EXPECT_NEAR(sum, 1, 1e-15);
        EXPECT_LT((place - mesh.patches()[i].corner[k]).norm(), 1e-14);
        hang += corners.of[i][k].size() > 1 ? 1 : 0;
      }
    EXPECT_EQ(hang > 0, passes > 0);
  }
}

// Quads on both sides of a line whose corners there alternate, each in the middle of the other side's edge: none can
// hang on all others.
TEST(SharedCorners, that_hang_on_each_other_are_told_apart) {
  scene::SceneBuilder builder({"y"}, scene::Quantity::radiometric);
  const scene::Material white{"white", Spectrum(.5), Spectrum(0.0), scene::Sides::front};
  const auto id =
      builder.add_polygon("zip", {{{0, -1, 0}, {6, -1, 0}, {6, 1, 0}, {0, 1, 0}}, {}}, builder.add_material(white));
  std::vector<scene::SurfacePatch> patches;
  for (const double x : {0., 2., 4.}) {
    const std::array<Vec3, 4> below{Vec3(x, -1, 0), Vec3(x + 2, -1, 0), Vec3(x + 2, 0, 0), Vec3(x, 0, 0)},
        above{Vec3(x + 1, 0, 0), Vec3(x + 3, 0, 0), Vec3(x + 3, 1, 0), Vec3(x + 1, 1, 0)};
    patches.push_back(scene::make_patch(id, scene::Side::front, below));
    patches.push_back(scene::make_patch(id, scene::Side::front, above));
  }
  const ElementMesh mesh(std::move(patches));
  const SharedCorners corners = shared_corners(mesh);
  for (const auto& of_element : corners.of)
    for (const SharedCorners::Mean& mean : of_element) {
      double sum = 0;
      for (const auto& part : mean) {
        sum += part.weight;
        EXPECT_LT(part.corner, corners.position.size());
      }
      EXPECT_NEAR(sum, 1, 1e-15);
    }
}

// A grid of n x n quads has (n + 1)² corners, and the element that each names has it.
TEST(SharedCorners, of_a_grid_are_counted_once) {
  scene::SceneBuilder builder({"y"}, scene::Quantity::radiometric);
  const scene::Material white{"white", Spectrum(.5), Spectrum(0.0), scene::Sides::front};
  builder.add_polygon("square", {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}}, builder.add_material(white));
  const ElementMesh mesh = uniform(builder.finish(), .3);
  const SharedCorners corners = shared_corners(mesh);
  const auto n = static_cast<std::size_t>(std::lround(std::sqrt(double(mesh.size()))));
  EXPECT_EQ(corners.position.size(), (n + 1) * (n + 1));
  for (std::size_t k = 0; k < corners.position.size(); ++k) {
    const auto ring = mesh.patches()[corners.element[k]].ring();
    EXPECT_TRUE(std::find(ring.begin(), ring.end(), corners.position[k]) != ring.end());
  }
}

// Few elements, none longer than asked for, that cover the same area.
TEST(Coarse, has_whole_faces_unless_they_are_too_long) {
  const scene::Scene scene = mixed_scene();
  const ElementMesh whole = whole_faces(scene);
  EXPECT_EQ(coarse(scene, 1.01 * whole.longest_edge()).size(), whole.size());
  for (const double part : {.7, .3, .1}) {
    const ElementMesh mesh = coarse(scene, part * whole.longest_edge());
    EXPECT_LE(mesh.longest_edge(), part * whole.longest_edge());
    double area = 0, expected = 0;
    for (const auto& patch : mesh.patches()) area += patch.area;
    for (const auto& patch : whole.patches()) expected += patch.area;
    EXPECT_NEAR(area, expected, 1e-12 * expected);
  }
  EXPECT_THROW(coarse(scene, 0), core::InputError);
}

}  // namespace
}  // namespace interflect::mesh
