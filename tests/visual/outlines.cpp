#include "visual/outlines.h"

#include <gtest/gtest.h>

#include <string>

#include "tiny.h"
#include "visual/faces.h"
#include "visual/film_heaps.h"

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

// The edge of two faces that are by turns a little lighter and a little darker than what takes a light line.
TEST(Outlines, are_not_dashed) {
  constexpr int height = 60, parts = 6;  // of the picture
  Samples before = samples_of(std::vector<std::string>(height, "ab"));
  for (std::size_t k = 0; k < before.colours.size(); ++k) {
    const auto grey = static_cast<std::uint8_t>(k / 2 % 2 == 0 ? 30 : 60);  // the threshold is 51
    before.colours[k] = {grey, grey, grey};
  }
  Samples samples = before;
  draw_outlines(samples, 1, 1);
  const std::vector<std::string> drawn = changes(before, samples);
  for (std::size_t y = 0; y < height; ++y) EXPECT_EQ(drawn[y], drawn[y - y % (height / parts)]) << y;
}

TEST(Outlines, of_clear_bodies_alone_are_drawn_where_faces_have_none) {
  Samples before = samples_of({"aabb"});
  before.clear = {{1, 0, 0, 0}};
  Samples samples = before;
  draw_outlines(samples, 1, 1, false);
  EXPECT_EQ(changes(before, samples), (std::vector<std::string>{"dd  "}));
}

TEST(Outlines, leave_out_faces_that_are_small_in_the_picture) {
  const Samples before = samples_of({"aaacbbb"});
  Samples samples = before;
  draw_outlines(samples, 1, 2);
  EXPECT_EQ(samples.colours, before.colours);
}

// A pane over two walls: their edge is drawn through it, and its own.
TEST(Outlines, of_clear_bodies_and_of_what_is_behind_them_are_drawn) {
  Samples before = samples_of({"aaaabbbb", "aaaabbbb"});
  before.clear = {{0, 0, 1, 1, 1, 1, 1, 1, 0, 0, 1, 1, 1, 1, 1, 1}, {0, 0, 0, 0, 0, 0, 9, 9, 0, 0, 0, 0, 0, 0, 9, 9}};
  Samples samples = before;
  draw_outlines(samples, 1, 1);
  EXPECT_EQ(changes(before, samples), (std::vector<std::string>{" dddddd ", " dddddd "}));
  EXPECT_EQ(before.clear_bodies(1), 0);
  EXPECT_EQ(before.clear_bodies(3), 1);
  EXPECT_EQ(before.clear_bodies(6), 2);
}

TEST(FilmHeaps, hold_bodies_that_lie_apart_in_the_picture) {
  const scene::Camera camera{"", Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3::UnitZ(), 60, 100, 100};
  const auto square = [](double x, double y, double size) {
    Polygons polygons;
    const std::array<Colour, 4> same{bright, bright, bright, bright};
    const Vec3 a(x, y, 0), b(x + size, y, 0), c(x + size, y, size), d(x, y, size);
    polygons.add(std::array{a, b, c, d}, same);
    return polygons;
  };
  const std::vector<Polygons> bodies{square(-1, 3, 0.8),    // left
                                     square(0.2, 3, 0.8),   // right of it
                                     square(-2, 6, 1.5),    // behind the left one
                                     square(0.1, -1, 0.1),  // behind the eye: anywhere
                                     square(-3, 9, 2)};     // behind both on the left
  using Heaps = std::vector<std::vector<std::size_t>>;
  EXPECT_EQ(film_heaps(bodies, camera, 9), (Heaps{{0, 1}, {2}, {3}, {4}}));
  EXPECT_EQ(film_heaps(bodies, camera, 2), (Heaps{{0, 1}, {2, 3, 4}}));
  EXPECT_EQ(film_heaps({}, camera, 2), Heaps{});
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
