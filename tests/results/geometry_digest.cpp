#include <gtest/gtest.h>

#include "results/factors.h"
#include "scene/builder.h"

using namespace interflect;
using namespace interflect::results;

TEST(GeometryDigest, tells_shapes_apart_and_nothing_else) {
  const auto digest = [](double height, const char* name, scene::Side side) {
    scene::SceneBuilder builder({"y"});
    scene::Material material;
    const auto id = builder.add_material(material);
    const geometry::Ring ring{{0, 0, height}, {1, 0, height}, {1, 1, height}};
    builder.add_polygon(name, {ring, {}}, id);
    const scene::Scene scene = builder.finish();
    const std::vector<scene::SurfacePatch> patches{scene::make_patch(scene::SurfaceId{0}, side, ring)};
    return geometry_digest(scene, patches);
  };
  using scene::Side;
  const std::string one = digest(0, "a", Side::front);
  EXPECT_EQ(one.size(), 32u);
  EXPECT_EQ(digest(-0.0, "b", Side::front), one);
  EXPECT_NE(digest(5e-324, "a", Side::front), one);
  EXPECT_NE(digest(0, "a", Side::back), one);
}
