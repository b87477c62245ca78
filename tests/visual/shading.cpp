#include "visual/shading.h"

#include <gtest/gtest.h>

#include "tiny.h"

using namespace interflect;
using namespace interflect::visual;
using results::Colour;

TEST(Shading, a_linear_field_is_smoothed_to_itself) {
  const tiny::Floor floor(6);
  const auto field = [](const Vec3& p) { return 0.3 + 0.1 * p.x() + 0.05 * p.y(); };
  std::vector<Rgb> values;
  for (const scene::SurfacePatch& patch : floor.mesh.patches()) values.push_back({field(patch.centroid()), 0.2, 1.0});
  const Polygons polygons = smooth(floor.mesh, values, 1.0);
  ASSERT_EQ(polygons.sizes.size(), 4u * 36u);
  for (std::size_t i = 0; i < polygons.corners.size(); ++i)
    EXPECT_EQ(polygons.colours[i], display_colour({field(polygons.corners[i]), 0.2, 1.0}, 1.0));
}

TEST(Shading, smoothing_invents_no_light_in_darkness_and_keeps_what_is_alone) {
  const tiny::Floor floor(1);
  const Polygons polygons = smooth(floor.mesh, std::vector<Rgb>{{0.5, 0, 0.25}}, 1.0);
  for (const Colour& c : polygons.colours) EXPECT_EQ(c, display_colour({0.5, 0, 0.25}, 1.0));
}

TEST(Shading, surfaces_that_meet_at_an_angle_are_not_mixed) {
  // One surface of two squares at a right angle: a facet of a mesh file.
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(1, 1, 0), d(0, 1, 0), e(0, 1, 1), f(0, 0, 1);
  const scene::SurfaceId one{0};
  const mesh::ElementMesh mesh({make_patch(one, scene::Side::front, std::array{a, b, c, d}),
                                make_patch(one, scene::Side::front, std::array{a, d, e, f})});
  const Polygons polygons = smooth(mesh, std::vector<Rgb>{{1, 1, 1}, {0, 0, 0}}, 1.0);
  for (std::size_t i = 0; i < polygons.colours.size(); ++i)
    EXPECT_EQ(polygons.colours[i], i < 12 ? (Colour{255, 255, 255}) : (Colour{0, 0, 0}));
}
