#include "scene/builder.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "core/error.h"

namespace interflect::scene {
namespace {

using geometry::Box;
using geometry::PlanarPolygon;

Material grey(double reflectance) { return {"grey", Spectrum(reflectance), Spectrum(), Sides::front}; }

TEST(Builder, a_box_closes_around_its_volume) {
  for (const auto facing : {SceneBuilder::Facing::outward, SceneBuilder::Facing::inward}) {
    SceneBuilder builder({"y"});
    builder.add_box("box", Box(Vec3(1, 2, 3), Vec3(2, 4, 6)), builder.add_material(grey(0.5)), facing);
    const Scene scene = builder.finish();
    double volume = 0;  // the divergence theorem: sum of x . n A / 3
    for (const Facet& f : scene.facets) volume += f.corner[0].dot(f.normal) * f.area / 3;
    EXPECT_DOUBLE_EQ(volume, facing == SceneBuilder::Facing::outward ? 6 : -6);
  }
}

TEST(Builder, facets_of_a_polygon_share_its_normal_to_the_last_bit) {
  SceneBuilder builder({"y"});
  const PlanarPolygon polygon{{{0, 0, 0}, {1, 1, 1}, {1.1, 1.2, 0.4}, {0.7, 0.4, -1}, {0.35, 0.2, -0.5}}, {}};
  PlanarPolygon flat = polygon;  // into one plane
  const geometry::Plane plane{Vec3(1, 2, 3).normalized(), 0};
  for (Vec3& x : flat.outer) x -= plane.distance(x) * plane.normal;
  builder.add_polygon("p", flat, builder.add_material(grey(0.5)));
  const Scene scene = builder.finish();
  for (const Facet& f : scene.facets) EXPECT_EQ(f.normal, scene.facets[0].normal);
}

TEST(Builder, names_become_unique) {
  SceneBuilder builder({"y"});
  const MaterialId m = builder.add_material(grey(0.5));
  const PlanarPolygon p{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {}};
  for (const char* name : {"a", "a", "a-2", "", ""}) builder.add_polygon(name, p, m);
  const Scene scene = builder.finish();
  std::vector<std::string> names;
  for (const Surface& s : scene.surfaces) names.push_back(s.name);
  EXPECT_EQ(names, (std::vector<std::string>{"a", "a-3", "a-2", "surface", "surface-2"}));
}

TEST(Builder, names_of_backs_are_unique_too_and_what_that_changes_is_said) {
  const PlanarPolygon p{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {}};
  for (const bool back_first : {false, true}) {
    SceneBuilder builder({"y"});
    const MaterialId one = builder.add_material(grey(0.5));
    const MaterialId both = builder.add_material({"leaf", Spectrum(0.5), Spectrum(), Sides::both});
    if (back_first) builder.add_polygon("a/back", p, one);
    builder.add_polygon("a", p, both);
    if (!back_first) builder.add_polygon("a/back", p, one);
    builder.add_polygon("b", p, one);
    builder.add_polygon("b/back", p, one);  // b's back bears no name: it is black
    const Scene scene = builder.finish("s.json");
    std::set<std::string> names;
    std::size_t sides = 0;
    for (const SurfaceId id : scene.surface_ids())
      for (const Side side : {Side::front, Side::back}) {
        if (!scene.material(id).active(side)) continue;
        names.insert(scene.side_name(id, side));
        ++sides;
      }
    EXPECT_EQ(names.size(), sides);
    EXPECT_TRUE(names.contains("b/back"));
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_EQ(scene.warnings[0].line(), std::string("s.json: the surface ") +
                                            (back_first ? "'a' is called 'a-2'" : "'a/back' is called 'a/back-2'") +
                                            ": the back of a surface is called NAME/back, and that name is taken");
  }
}

TEST(Builder, facets_without_area_are_refused_and_leave_nothing_behind) {
  SceneBuilder builder({"y"});
  const MaterialId m = builder.add_material(grey(0.5));
  const std::vector<geometry::TriangleCorners> triangles{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)},
                                                         {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)}};
  EXPECT_THROW(builder.add_facets("f", triangles, m), geometry::Defect);
  EXPECT_TRUE(builder.scene().facets.empty());
}

TEST(Builder, channels_are_as_many_as_the_build_holds) {
  EXPECT_THROW(SceneBuilder({}), core::PreconditionError);
  EXPECT_THROW(SceneBuilder(std::vector<std::string>(Spectrum::capacity + 1, "c")), core::PreconditionError);
}

TEST(Camera, pixels_span_the_angle_of_view) {
  const Camera camera{"c", {0, -3, 0}, {0, 0, 0}, Vec3::UnitZ(), 90, 200, 100};
  EXPECT_NEAR((camera.direction(100, 50) - Vec3(0, 1, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((camera.direction(100, 0) - Vec3(0, 1, 1).normalized()).norm(), 0, 1e-15);  // top
  EXPECT_NEAR((camera.direction(200, 50) - Vec3(2, 1, 0).normalized()).norm(), 0,
              1e-15);  // right is +x: seen along +y, up z
  EXPECT_NEAR((camera.direction(0, 100) - Vec3(-2, 1, -1).normalized()).norm(), 0, 1e-15);
}

TEST(Patch, centroid_and_area_of_a_quad_are_those_of_its_halves) {
  const std::vector<Vec3> ring{{0, 0, 1}, {4, 0, 1}, {2, 2, 1}, {0, 2, 1}};  // a trapezoid
  const SurfacePatch patch = make_patch(SurfaceId{3}, Side::front, ring);
  EXPECT_DOUBLE_EQ(patch.area, 6);
  EXPECT_NEAR((patch.centroid() - Vec3(14.0 / 9, 8.0 / 9, 1)).norm(), 0, 1e-15);
  EXPECT_EQ(patch.normal(), Vec3::UnitZ());
}

TEST(Scene, a_channel_without_weight_is_left_out_even_where_it_is_infinite) {
  Scene scene;
  scene.channels = {"visible", "heat"};
  scene.weights[0] = 1;
  Spectrum error(0.5);
  error[1] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(scene.weigh(error), 0.5);
}

// With a hole, which is moved along.
TEST(Builder, flattens_what_is_flat_but_for_rounding_and_says_so) {
  geometry::PlanarPolygon polygon{{{0, 0, 0}, {3, 0, 1e-6}, {3, 4, 0}, {0, 4, 1e-6}},
                                  {{{1, 1, 0}, {1, 2, 0}, {2, 2, 0}}}};
  for (const bool bent : {false, true}) {
    SceneBuilder builder({"y"});
    if (!bent) polygon.outer[1].z() = polygon.outer[3].z() = 0;
    builder.add_polygon("p", polygon, builder.add_material(grey(0.5)));
    const Scene scene = builder.finish("room");
    polygon.outer[1].z() = polygon.outer[3].z() = 1e-6;
    EXPECT_LT(geometry::relative_planarity_error(*scene.surfaces[0].outline), 1e-15);
    const geometry::Plane plane = geometry::plane_of(scene.surfaces[0].outline->outer);
    for (const Facet& facet : scene.facets)
      for (const Vec3& p : facet.corner) EXPECT_LT(std::abs(plane.distance(p)), 1e-15);
    ASSERT_EQ(scene.repairs.size(), bent ? 1u : 0u);
    for (const Note& note : scene.repairs) EXPECT_EQ(note.message, "1 polygon flattened, by 5e-07 m at most");
  }
}

TEST(Scene, flux_is_that_of_fronts_and_numbers_are_weighed) {
  SceneBuilder builder({"r", "g", "b"});
  Material lamp = grey(0.5);
  lamp.sides = Sides::both;
  const MaterialId m = builder.add_material(lamp);
  builder.add_polygon("p", {{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {}}, m);
  Spectrum flux;
  flux[0] = 8, flux[1] = 4, flux[2] = 2;
  builder.share_flux(m, flux);
  const Scene scene = builder.finish();
  EXPECT_EQ(scene.emitted_flux(), flux);
  EXPECT_DOUBLE_EQ(scene.weigh(flux), 8 * 0.2126 + 4 * 0.7152 + 2 * 0.0722);
  EXPECT_EQ(scene.rgb(flux), (std::array<double, 3>{8, 4, 2}));
}

}  // namespace
}  // namespace interflect::scene
