#include "fem/form_factor/plane_outlines.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/hemisphere.h"
#include "mesh/uniform.h"
#include "tests/support/shapes.h"

namespace interflect::fem {
namespace {

/// The floor of a star-shaped room, in triangles and quads.
std::vector<scene::SurfacePatch> floor_of_a_star(const test::Placing& place) {
  scene::SceneBuilder builder({"grey"});
  core::RandomNumbers numbers(5, 0, 0);
  const auto grey = builder.add_material(test::diffuse("grey", 0.5, 0));
  test::add_prism_room(builder, test::random_star(9, numbers), 0.8, grey, place);
  const mesh::ElementMesh mesh = mesh::uniform(builder.finish(), 0.1 * place.scale);
  std::vector<scene::SurfacePatch> floor;
  for (const scene::SurfacePatch& patch : mesh.patches())
    if (patch.surface.value == 0) floor.push_back(patch);
  return floor;
}

// Of points drawn from each element that one alone holds them, or none where they are too close to an edge: of uniform
// ones less than one in a thousand.
TEST(PlaneOutlines, hold_the_points_of_their_element_and_no_others) {
  for (const auto& placing : test::placings) {
    const auto patches = floor_of_a_star(placing);
    ASSERT_GT(patches.size(), 20u);
    const PlaneOutlines outlines(patches);
    ASSERT_TRUE(outlines.flat());
    int untold = 0;
    core::RandomNumbers numbers(3, 0, 0);
    for (std::size_t of = 0; of < patches.size(); ++of)
      for (int k = 0; k < 100; ++k) {
        const Vec3 x = core::triangle_point(patches[of].corner[0], patches[of].corner[1], patches[of].corner[2],
                                            numbers.next(), numbers.next());
        bool held = false;
        for (std::uint32_t item = 0; item < patches.size(); ++item)
          if (outlines.surely_holds(item, outlines.at(x))) {
            ASSERT_EQ(item, of);
            held = true;
          }
        untold += !held;
      }
    EXPECT_LT(untold, .001 * 100 * static_cast<double>(patches.size()));
  }
}

// What likely holds a point does in most cases, and is an element in any: inside, and far outside.
TEST(PlaneOutlines, guess_the_element_of_nearly_all_points) {
  for (const auto& placing : test::placings) {
    const auto patches = floor_of_a_star(placing);
    const PlaneOutlines outlines(patches);
    core::RandomNumbers numbers(4, 0, 0);
    int guessed = 0;
    constexpr int points = 20;
    for (std::uint32_t of = 0; of < patches.size(); ++of)
      for (int k = 0; k < points; ++k) {
        const auto& corner = patches[of].corner;
        const Vec3 x = core::triangle_point(corner[0], corner[1], corner[2], numbers.next(), numbers.next());
        const auto& [first, second] = outlines.likely(outlines.at(x));
        guessed += first == of || second == of;
        for (const std::uint32_t item : outlines.likely(outlines.at(x + 50 * (x - corner[0]))))
          EXPECT_TRUE(item == PlaneOutlines::none || item < patches.size());
      }
    EXPECT_GT(guessed, .95 * points * static_cast<double>(patches.size()));
  }
}

scene::SurfacePatch rectangle(double x, double y, double width, double height) {
  return scene::make_patch({0}, scene::Side::front,
                           std::array<Vec3, 4>{Vec3(x, y, 0), Vec3(x + width, y, 0), Vec3(x + width, y + height, 0),
                                               Vec3(x, y + height, 0)});
}

// One element; a large one beside a thousand times smaller ones; slivers far apart that single precision sees no width
// of; and points that are no numbers.
TEST(PlaneOutlines, guess_whatever_shapes_elements_have) {
  std::vector<scene::SurfacePatch> unequal{rectangle(0, 0, 1, 1)};
  for (int k = 0; k < 200; ++k) unequal.push_back(rectangle(1 + .001 * k, 0, .001, .001));
  const std::vector<scene::SurfacePatch> one{rectangle(3, 4, 2, .5)},
      slivers{rectangle(0, 0, 1e-9, 1), rectangle(1e3, 0, 1e-9, 1)};
  for (const auto& patches : {one, unequal, slivers}) {
    const PlaneOutlines outlines(patches);
    ASSERT_TRUE(outlines.flat());
    for (const scene::SurfacePatch& patch : patches)
      for (const std::uint32_t item : outlines.likely(outlines.at(patch.centroid())))
        EXPECT_TRUE(item == PlaneOutlines::none || item < patches.size());
    outlines.likely(Eigen::Vector2f::Constant(std::numeric_limits<float>::quiet_NaN()));
    outlines.likely(Eigen::Vector2f::Constant(std::numeric_limits<float>::infinity()));
  }
  EXPECT_EQ(PlaneOutlines(one).likely(PlaneOutlines(one).at(one[0].centroid()))[0], 0u);
}

TEST(PlaneOutlines, are_not_told_of_corners_and_edges) {
  const auto patches = floor_of_a_star({});
  const PlaneOutlines outlines(patches);
  for (const scene::SurfacePatch& patch : patches)
    for (std::size_t k = 0; k < patch.corners; ++k)
      for (const double at : {0.0, .3, .5}) {
        const Vec3 x = patch.corner[k] + at * (patch.corner[(k + 1) % patch.corners] - patch.corner[k]);
        for (std::uint32_t item = 0; item < patches.size(); ++item)
          EXPECT_FALSE(outlines.surely_holds(item, outlines.at(x)));
      }
}

TEST(PlaneOutlines, of_what_is_not_flat_or_seen_from_both_sides_say_so) {
  auto patches = floor_of_a_star({});
  patches[3].corner[1].z() += 1e-6;
  EXPECT_FALSE(PlaneOutlines(patches).flat());
  patches = floor_of_a_star({});
  std::swap(patches[3].corner[0], patches[3].corner[1]);
  EXPECT_FALSE(PlaneOutlines(patches).flat());
  EXPECT_FALSE(PlaneOutlines({}).flat());
}

}  // namespace
}  // namespace interflect::fem
