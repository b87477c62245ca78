#include "visual/outlines.h"

#include <gtest/gtest.h>

#include <string>

#include "tiny.h"
#include "visual/faces.h"

using namespace interflect;
using namespace interflect::visual;
using results::Colour;

namespace {

constexpr Colour bright{200, 200, 200}, black{0, 0, 0};

/// A letter a sample, row after row: '#' is a back in black, '.' beside everything, others are faces in `bright`.
Samples samples_of(const std::vector<std::string>& rows) {
  Samples samples{static_cast<int>(rows.front().size()), static_cast<int>(rows.size()), {}, {}};
  for (const std::string& row : rows)
    for (char c : row) {
      samples.colours.push_back(c == '#' ? black : bright);
      samples.faces.push_back(c == '#' ? Samples::back : c == '.' ? Samples::nothing : static_cast<std::uint32_t>(c));
    }
  return samples;
}

std::vector<std::string> rows_of(const Samples& samples) {
  std::vector<std::string> rows(static_cast<std::size_t>(samples.height));
  for (int y = 0; y < samples.height; ++y)
    for (int x = 0; x < samples.width; ++x) {
      const std::uint32_t face = samples.faces[samples.place(x, y)];
      rows[static_cast<std::size_t>(y)] += face == Samples::back      ? '#'
                                           : face == Samples::nothing ? '.'
                                                                      : static_cast<char>(face);
    }
  return rows;
}

/// 'd' where a sample got darker, 'l' where lighter.
std::vector<std::string> changes(const Samples& before, const Samples& after) {
  std::vector<std::string> rows(static_cast<std::size_t>(before.height));
  for (int y = 0; y < before.height; ++y)
    for (int x = 0; x < before.width; ++x) {
      const int by = after.colours[before.place(x, y)][1] - before.colours[before.place(x, y)][1];
      rows[static_cast<std::size_t>(y)] += by < 0 ? 'd' : by > 0 ? 'l' : ' ';
    }
  return rows;
}

}  // namespace

TEST(Outlines, specks_of_backs_become_what_is_beside_them_and_backs_stay) {
  Samples samples = samples_of({"aa#bb", "aa#bb", "aaabb", "##.bb", "##.b#"});
  leave_out_specks(samples);
  EXPECT_EQ(rows_of(samples), (std::vector<std::string>{"aabbb", "aabbb", "aaabb", "##.bb", "##.bb"}));
  EXPECT_EQ(samples.colours[samples.place(2, 0)], bright);
  EXPECT_EQ(samples.colours[samples.place(0, 4)], black);
}

TEST(Outlines, lie_on_both_sides_of_where_faces_end) {
  const Samples before = samples_of({"aaabbb", "aaabbb", "......"});
  Samples samples = before;
  draw_outlines(samples, 1, 1);
  EXPECT_EQ(changes(before, samples), (std::vector<std::string>{"  dd  ", "dddddd", "dddddd"}));
}

TEST(Outlines, are_light_on_what_is_dark) {
  Samples before = samples_of({"aabb"});
  for (Colour& colour : before.colours) colour = {13, 8, 135};
  Samples samples = before;
  draw_outlines(samples, 1, 1);
  EXPECT_EQ(changes(before, samples), (std::vector<std::string>{" ll "}));
}

TEST(Outlines, leave_out_faces_that_are_small_in_the_picture) {
  const Samples before = samples_of({"aaacbbb"});
  Samples samples = before;
  draw_outlines(samples, 1, 2);
  EXPECT_EQ(samples.colours, before.colours);
}

TEST(Faces, are_elements_of_a_material_that_hang_together) {
  const tiny::Floor floor(3);
  EXPECT_EQ(faces_of(floor.scene, floor.mesh), std::vector<std::uint32_t>(9, 0));

  scene::Scene scene = floor.scene;
  scene.materials.push_back(scene.materials.front());
  scene.surfaces = {{"one", {0}, 0, 1, {}}, {"two", {0}, 1, 1, {}}, {"of another material", {1}, 2, 1, {}}};
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(1, 1, 0), d(0, 1, 0), e(0, 1, 1), f(0, 0, 1), up(0, 0, 3), right(1, 0, 0);
  const auto patch = [](std::uint32_t surface, std::array<Vec3, 4> ring) {
    return make_patch(scene::SurfaceId{surface}, scene::Side::front, ring);
  };
  const mesh::ElementMesh mesh({patch(0, {a, b, c, d}),                      // on the floor
                                patch(0, {a, d, e, f}),                      // upright on it
                                patch(0, {a + up, b + up, c + up, d + up}),  // touches nothing
                                patch(1, {b, b + right, c + right, c}),      // the floor goes on
                                patch(2, {a - right, b - right, c - right, d - right})});
  EXPECT_EQ(faces_of(scene, mesh), (std::vector<std::uint32_t>{0, 1, 2, 0, 3}));
}
