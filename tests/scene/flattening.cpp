#include "scene/flattening.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "scene/builder.h"

namespace interflect::scene {
namespace {

using geometry::Ring;

const Eigen::Matrix3d turn = (Eigen::AngleAxisd(0.7, Vec3::UnitX()) * Eigen::AngleAxisd(1.1, Vec3::UnitY()) *
                              Eigen::AngleAxisd(-0.4, Vec3::UnitZ()))
                                 .toRotationMatrix();

/// Turned, and written with so many digits behind the point.
Vec3 written(const Vec3& x, double digit = 1e-6, const Vec3& offset = Vec3::Zero()) {
  const Vec3 y = turn * x / digit;
  return digit * Vec3(std::round(y.x()), std::round(y.y()), std::round(y.z())) + offset;
}

auto bent(const Scene& scene) {
  return std::count_if(scene.surfaces.begin(), scene.surfaces.end(), [](const Surface& surface) {
    return geometry::relative_planarity_error(*surface.outline) > 1e-12;
  });
}

double bend(const Scene& scene) {
  double most = 0;
  for (const Surface& surface : scene.surfaces)
    if (surface.outline) most = std::max(most, geometry::relative_planarity_error(*surface.outline));
  return most;
}

std::size_t places(const Scene& scene) {
  std::set<std::array<double, 3>> places;
  for (const Facet& facet : scene.facets)
    for (const Vec3& x : facet.corner) places.insert({x.x(), x.y(), x.z()});
  return places.size();
}

MaterialId black(SceneBuilder& builder) {
  return builder.add_material({"black", Spectrum(), Spectrum(), Sides::front});
}

// What is closed stays closed, and its volume and areas are right to the digits that there were.
TEST(Flattening, a_turned_box_keeps_its_eight_corners) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    SceneBuilder builder({"y"});
    builder.add_box("room", {Vec3::Zero(), Vec3(5, 4, 3)}, black(builder), SceneBuilder::Facing::inward,
                    [&](const Vec3& x) -> Vec3 { return scale * written(x); });
    const Scene scene = builder.finish("room");
    EXPECT_LT(bend(scene), 1e-15);
    EXPECT_EQ(places(scene), 8u);
    double volume = 0;
    for (const Facet& f : scene.facets) volume -= f.corner[0].dot(f.normal) * f.area / 3;
    EXPECT_NEAR(volume / std::pow(scale, 3), 60, 1e-4);
    ASSERT_EQ(scene.repairs.size(), 1u);
    EXPECT_NE(scene.repairs[0].message.find(" polygons flattened, by "), std::string::npos)
        << "some are flat by chance";
  }
}

TEST(Flattening, moves_no_corner_further_than_some_roundings) {
  SceneBuilder builder({"y"});
  builder.add_box("box", {Vec3(1, 1, 1), Vec3(2, 3, 4)}, black(builder), SceneBuilder::Facing::outward,
                  [](const Vec3& x) { return written(x); });
  Scene scene = std::move(builder.scene());
  const Scene before = scene;
  const Flattened done = flatten_polygons(scene);
  double furthest = 0;
  for (std::size_t f = 0; f < scene.facets.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      furthest = std::max(furthest, (scene.facets[f].corner[k] - before.facets[f].corner[k]).norm());
  EXPECT_EQ(done.polygons, std::size_t(bent(before)));
  EXPECT_GE(done.polygons, 2u);
  EXPECT_EQ(done.furthest, furthest);
  EXPECT_GT(furthest, 1e-8);
  EXPECT_LT(furthest, 2e-6);
  EXPECT_EQ(flatten_polygons(scene).polygons, 0u) << "once is enough";
}

// A wall of 8 x 8 tiles, which cannot all become flat in a few steps, a triangle and a mesh beside it.
TEST(Flattening, what_stays_bent_is_flattened_by_itself_and_what_touches_a_corner_moves_along) {
  for (const double offset : {0.0, 1e6}) {
    SceneBuilder builder({"y"});
    const MaterialId m = black(builder);
    const auto at = [&](int i, int j) { return written(Vec3(i, j, 0), 1e-6, Vec3::Constant(offset)); };
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 8; ++j)
        builder.add_polygon("tile", {{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}, {}}, m);
    const Vec3 top = written(Vec3(0, 0, 3), 1e-6, Vec3::Constant(offset));
    builder.add_polygon("triangle", {{at(0, 0), at(8, 0), top}, {}}, m);
    const geometry::TriangleCorners of_mesh{at(0, 8), top, at(0, 0)};
    builder.add_facets("mesh", std::span(&of_mesh, 1), m);
    const Scene scene = builder.finish("wall");
    EXPECT_LT(bend(scene), offset == 0 ? 1e-12 : 1e-9);
    EXPECT_EQ(scene.surfaces[64].outline->outer[0], scene.facets.back().corner[2]);
    for (const Facet& facet : scene.facets) {
      EXPECT_NEAR(facet.normal.norm(), 1, 1e-15);
      EXPECT_NEAR((facet.corner[1] - facet.corner[0]).cross(facet.corner[2] - facet.corner[0]).norm(), 2 * facet.area,
                  1e-12);
    }
  }
}

TEST(Flattening, leaves_what_is_flat_as_it_is_to_the_last_bit) {
  SceneBuilder builder({"y"});
  builder.add_box("room", {Vec3::Zero(), Vec3(5, 4, 3)}, black(builder), SceneBuilder::Facing::inward,
                  [](const Vec3& x) -> Vec3 { return turn * x; });
  Scene scene = std::move(builder.scene());
  const Scene before = scene;
  EXPECT_EQ(flatten_polygons(scene).polygons, 0u);
  for (std::size_t f = 0; f < scene.facets.size(); ++f) EXPECT_EQ(scene.facets[f].corner, before.facets[f].corner);
}

}  // namespace
}  // namespace interflect::scene
