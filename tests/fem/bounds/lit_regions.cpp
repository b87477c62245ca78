#include "fem/bounds/lit_regions.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "fem/element_rays.h"
#include "scene/reader.h"
#include "tests/fem/bounds/random_room.h"

namespace interflect::fem {
namespace {

using scene::Side;
using scene::Sides;

/// Rooms of polygons in the unit cube, moved where one wants them.
class Walls {
 public:
  explicit Walls(std::function<Vec3(const Vec3&)> place = [](const Vec3& x) { return x; }) : place_(std::move(place)) {}

  void polygon(geometry::Ring ring, std::vector<geometry::Ring> holes = {}, Sides sides = Sides::front) {
    for (Vec3& x : ring) x = place_(x);
    for (geometry::Ring& hole : holes)
      for (Vec3& x : hole) x = place_(x);
    builder_.add_polygon("wall", {std::move(ring), std::move(holes)},
                         builder_.add_material({"", Spectrum(.5), Spectrum(.1), sides}));
  }
  /// Its front is along u x v.
  void rectangle(const Vec3& corner, const Vec3& u, const Vec3& v, Sides sides = Sides::front) {
    polygon({corner, corner + u, corner + u + v, corner + v}, {}, sides);
  }
  /// A side of a box: 0 and 1 across x, low and high, 2 and 3 across y, 4 and 5 across z.
  void side(const Vec3& low, const Vec3& high, int which, bool inwards, Sides sides = Sides::front) {
    const int axis = which / 2;
    Vec3 corner = low, u = Vec3::Zero(), v = Vec3::Zero();
    u[(axis + 1) % 3] = high[(axis + 1) % 3] - low[(axis + 1) % 3];
    v[(axis + 2) % 3] = high[(axis + 2) % 3] - low[(axis + 2) % 3];
    if (which % 2 == 1) corner[axis] = high[axis];
    if ((which % 2 == 1) == inwards) std::swap(u, v);
    rectangle(corner, u, v, sides);
  }
  void box(const Vec3& low, const Vec3& high, bool inwards, const std::vector<int>& without = {},
           Sides sides = Sides::front) {
    for (int which = 0; which < 6; ++which)
      if (std::find(without.begin(), without.end(), which) == without.end()) side(low, high, which, inwards, sides);
  }
  void room(const std::vector<int>& without = {}) { box(Vec3::Zero(), Vec3::Ones(), true, without); }

  scene::Scene finish() { return builder_.finish(); }

 private:
  std::function<Vec3(const Vec3&)> place_;
  scene::SceneBuilder builder_{{"y"}, scene::Quantity::radiometric};
};

/// Turned and moved somewhere.
std::function<Vec3(const Vec3&)> somewhere(double scale = 1, const Vec3& offset = Vec3(3, -5, 7)) {
  const Eigen::Quaterniond turn = Eigen::Quaterniond(.8, .3, -.4, .35).normalized();
  return [=](const Vec3& x) -> Vec3 { return scale * (turn * x + offset); };
}

double area_of(std::span<const scene::SurfacePatch> patches) {
  double sum = 0;
  for (const scene::SurfacePatch& patch : patches) sum += patch.area;
  return sum;
}

constexpr int floor_side = 4, ceiling_side = 5;

TEST(LitRegions, of_a_cube_are_closed_at_any_scale_and_place) {
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(3, -5, 7), Vec3(1e4, 1e4, -1e4)}) {
      Walls walls(somewhere(scale, offset));
      walls.room();
      walls.box({.3, .4, .2}, {.5, .7, .6}, false);
      const LitRegions lit(walls.finish());
      EXPECT_TRUE(lit.closed()) << scale;
      EXPECT_TRUE(lit.black_sides().empty());
      const auto contain = [&](const Vec3& x) {
        return lit.contain(somewhere(scale, offset)(x), Vec3(.1, .2, 1).normalized());
      };
      EXPECT_TRUE(contain({.1, .1, .9}));
      EXPECT_FALSE(contain({.4, .5, .3})) << "within the body";
      EXPECT_FALSE(contain({-.1, .5, .5}));
      EXPECT_FALSE(contain({-9, .5, .5}));
    }
}

TEST(LitRegions, are_open_where_a_wall_is_missing_or_has_a_hole) {
  for (int which = 0; which < 6; ++which) {
    Walls missing(somewhere());
    missing.room({which});
    EXPECT_FALSE(LitRegions(missing.finish()).closed()) << which;
  }
  for (const double size : {1e-3, 1e-5}) {
    Walls pinhole(somewhere());
    pinhole.room({floor_side});
    const double a = .4, b = .4 + size;
    pinhole.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{{a, a, 0}, {b, a, 0}, {b, b, 0}, {a, b, 0}}});
    EXPECT_FALSE(LitRegions(pinhole.finish()).closed()) << size;
  }
}

// A hole with a lid that fits is none.
TEST(LitRegions, are_closed_where_a_lid_fits) {
  Walls walls(somewhere());
  walls.room({floor_side});
  walls.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{{.4, .4, 0}, {.6, .4, 0}, {.6, .6, 0}, {.4, .6, 0}}});
  walls.box({.4, .4, 0}, {.6, .6, .3}, false, {floor_side});
  const LitRegions lit(walls.finish());
  EXPECT_TRUE(lit.closed());
  EXPECT_TRUE(lit.black_sides().empty());
}

TEST(LitRegions, gaps_count_down_to_rounding) {
  for (const auto& [gap, closed] : {std::pair(1e-6, false), std::pair(1e-8, false), std::pair(1e-12, true)})
    for (const double scale : {1e-6, 1.0, 1e6}) {
      Walls walls(somewhere(scale, Vec3::Zero()));
      walls.room({floor_side});
      walls.rectangle({0, gap, 0}, {1, 0, 0}, {0, 1 - gap, 0});
      EXPECT_EQ(LitRegions(walls.finish()).closed(), closed) << gap;
    }
}

// It hides a part of the floor that is one polygon with the rest: closed, but its inner sides are seen from there.
TEST(LitRegions, hold_a_box_without_a_bottom) {
  const Vec3 low(.3, .4, 0), high(.5, .7, .6);
  for (const Sides sides : {Sides::front, Sides::both}) {
    Walls walls(somewhere());
    walls.room();
    walls.box(low, high, false, {floor_side}, sides);
    const LitRegions lit(walls.finish());
    EXPECT_TRUE(lit.closed());
    const double inner = 2 * .6 * (.2 + .3) + .2 * .3;
    EXPECT_NEAR(area_of(lit.black_sides()), sides == Sides::front ? inner : 0, 1e-9);
    for (const scene::SurfacePatch& patch : lit.black_sides()) EXPECT_EQ(patch.side, Side::back);
  }
}

// With a bottom that lies on the floor, that looks out of the scene.
TEST(LitRegions, are_open_under_a_box_on_the_floor) {
  Walls walls(somewhere());
  walls.room();
  walls.box({.3, .4, 0}, {.5, .7, .6}, false);
  EXPECT_FALSE(LitRegions(walls.finish()).closed());
}

TEST(LitRegions, hold_a_partition) {
  for (const Sides sides : {Sides::front, Sides::both}) {
    Walls walls(somewhere());
    walls.room();
    walls.rectangle({.4, .2, 0}, {0, .5, 0}, {0, 0, .7}, sides);  // stands free in the room
    walls.rectangle({0, 0, .8}, {1, 0, 0}, {0, 1, 0}, sides);     // cuts off a part of it
    const LitRegions lit(walls.finish());
    EXPECT_TRUE(lit.closed());
    EXPECT_NEAR(area_of(lit.black_sides()), sides == Sides::front ? .5 * .7 + 1 : 0, 1e-9);
  }
}

// Three facets and more share the edges of what divides a room, whose walls end there.
TEST(LitRegions, hold_walls_that_end_at_a_partition) {
  Walls walls(somewhere());
  walls.box({0, 0, 0}, {.4, 1, 1}, true, {1});
  walls.box({.4, 0, 0}, {1, 1, 1}, true, {0});
  walls.rectangle({.4, 0, 0}, {0, 1, 0}, {0, 0, 1}, Sides::both);
  const LitRegions lit(walls.finish());
  EXPECT_TRUE(lit.closed());
  EXPECT_TRUE(lit.black_sides().empty());
}

// Back to back, each room's wall is what it sees, and not the other's back in the same place.
TEST(LitRegions, hold_rooms_back_to_back) {
  Walls walls(somewhere());
  walls.box({0, 0, 0}, {.4, 1, 1}, true);
  walls.box({.4, 0, 0}, {1, .7, 1}, true);
  walls.box({0, 0, 1}, {1, 1, 2}, true);
  const LitRegions lit(walls.finish());
  EXPECT_TRUE(lit.closed());
  EXPECT_TRUE(lit.black_sides().empty());
}

// Corners of one wall's parts lie on the edges of others'; in vain if one of them faces outwards.
TEST(LitRegions, hold_walls_that_are_cut_differently) {
  for (const bool inwards : {true, false}) {
    Walls walls(somewhere());
    walls.room({floor_side, 0, 3});
    for (const double y : {0., .25, .5, .75}) walls.rectangle({0, y, 0}, {1, 0, 0}, {0, .25, 0});
    for (const double z : {0., 1. / 3, 2. / 3}) walls.rectangle({0, 0, z}, {0, 1, 0}, {0, 0, 1. / 3});
    for (int k = 0; k < 7; ++k) walls.side({k / 7., 0, 0}, {(k + 1) / 7., 1, 1}, 3, inwards || k != 4);
    EXPECT_EQ(LitRegions(walls.finish()).closed(), inwards);
  }
}

// A prism on an L: floor and ceiling are not convex.
TEST(LitRegions, of_an_L_are_closed) {
  const std::vector<Vec3> outline{{0, 0, 0}, {1, 0, 0}, {1, .4, 0}, {.5, .4, 0}, {.5, 1, 0}, {0, 1, 0}};
  for (const bool all : {true, false}) {
    Walls walls(somewhere());
    const Vec3 up(0, 0, .6);
    geometry::Ring ceiling(outline.rbegin(), outline.rend());
    for (Vec3& x : ceiling) x += up;
    walls.polygon(outline);
    walls.polygon(ceiling);
    for (std::size_t k = all ? 0 : 1; k < outline.size(); ++k)
      walls.rectangle(outline[k], up, outline[(k + 1) % outline.size()] - outline[k]);
    EXPECT_EQ(LitRegions(walls.finish()).closed(), all);
  }
}

TEST(LitRegions, are_closed_if_all_are) {
  const auto rooms = [](const std::vector<int>& without) {
    Walls walls(somewhere());
    walls.room();
    walls.box({2, 0, 0}, {3, 1, 1}, true, without);
    return walls.finish();
  };
  EXPECT_TRUE(LitRegions(rooms({})).closed());
  EXPECT_FALSE(LitRegions(rooms({ceiling_side})).closed());
  Walls with_lamp(somewhere());
  with_lamp.room();
  with_lamp.rectangle({2, 0, 0}, {.1, 0, 0}, {0, .1, 0});
  EXPECT_FALSE(LitRegions(with_lamp.finish()).closed());
}

/// A room of 54 squares, turned, with boxes in it that lack sides and may pierce each other and the walls; often one of
/// the squares is missing.
scene::Scene random_scene(std::mt19937& random) {
  std::uniform_real_distribution<double> part(0, 1);
  Walls walls(somewhere());
  const int missing = part(random) < .5 ? static_cast<int>(54 * part(random)) : -1;
  for (int which = 0, square = 0; which < 6; ++which)
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b, ++square) {
        Vec3 low = Vec3::Zero(), high = Vec3::Ones();
        low[(which / 2 + 1) % 3] = a / 3., high[(which / 2 + 1) % 3] = (a + 1) / 3.;
        low[(which / 2 + 2) % 3] = b / 3., high[(which / 2 + 2) % 3] = (b + 1) / 3.;
        if (square != missing) walls.side(low, high, which, true);
      }
  for (int k = 0; k < 4; ++k) {
    const Vec3 low{.6 * part(random), .6 * part(random), .6 * part(random)};
    const Vec3 size{.1 + .2 * part(random), .1 + .2 * part(random), .1 + .2 * part(random)};
    const bool stands = part(random) < .5;
    std::vector<int> without;
    if (stands) without.push_back(floor_side);
    if (part(random) < .3) without.push_back(static_cast<int>(6 * part(random)));
    const Vec3 down(0, 0, stands ? low.z() : 0);
    walls.box(low - down, low - down + size, part(random) < .7, without,
              part(random) < .5 ? Sides::front : Sides::both);
  }
  return walls.finish();
}

/// Cosine-distributed rays from elements: how many escape, and how many end on sides that are neither active nor known.
struct Lost {
  int escaped = 0, on_unknown = 0;
};
Lost lost_rays(const scene::Scene& scene, const LitRegions& lit, std::mt19937& random) {
  std::uniform_real_distribution<double> part(0, 1);
  const auto rays = raycast::make_ray_caster("brute", scene);
  Lost lost;
  for (const scene::Facet& facet : scene.facets)
    for (const Side side : {Side::front, Side::back}) {
      if (!scene.material(facet.surface).active(side)) continue;
      geometry::Ring ring(facet.corner.begin(), facet.corner.end());
      if (side == Side::back) std::swap(ring[1], ring[2]);
      const ElementRays from(scene::make_patch(facet.surface, side, ring));
      for (int k = 0; k < 60; ++k) {
        const auto hit = rays->closest(from(part(random), part(random), part(random), part(random)).ray);
        if (!hit) ++lost.escaped;
        if (!hit || scene.material(hit->surface).active(hit->side)) continue;
        const auto is_there = [&](const scene::SurfacePatch& black) {
          return black.surface == hit->surface && black.side == hit->side;
        };
        lost.on_unknown += std::none_of(lit.black_sides().begin(), lit.black_sides().end(), is_there);
      }
    }
  return lost;
}

TEST(LitRegions, of_shipped_rooms_are_closed) {
  for (const auto& [name, closed] :
       {std::pair("concentric_cubes", true), std::pair("cube", true), std::pair("furnace", true),
        std::pair("office", true), std::pair("sphere", true), std::pair("two_rooms", true),
        std::pair("cornell_box", false), std::pair("oven", false), std::pair("parallel_plates", false)}) {
    const LitRegions lit(scene::read_scene(std::string(INTERFLECT_SOURCE_DIR "/data/scenes/") + name + ".json"));
    EXPECT_EQ(lit.closed(), closed) << name;
    EXPECT_TRUE(lit.black_sides().empty()) << name;
  }
}

TEST(LitRegions, of_random_rooms_are_closed) {
  for (unsigned seed = 1; seed <= 50; ++seed)
    for (const double scale : {1e-6, 1.0, 1e6}) {
      std::mt19937 random(seed);
      const LitRegions lit(test::random_room(random, scale));
      EXPECT_TRUE(lit.closed()) << seed;
      EXPECT_TRUE(lit.black_sides().empty()) << seed;
    }
}

// Rays agree: from what is proved to be closed none escapes, and where the room has all of its walls it is proved.
TEST(LitRegions, agree_with_rays_in_random_scenes) {
  std::mt19937 random(11);
  int closed = 0, open = 0, with_black_sides = 0;
  for (int k = 0; k < 60; ++k) {
    const scene::Scene scene = random_scene(random);
    const LitRegions lit(scene);
    const Lost lost = lost_rays(scene, lit, random);
    if (lit.closed()) {
      EXPECT_EQ(lost.escaped, 0) << k;
      EXPECT_EQ(lost.on_unknown, 0) << k;
      ++closed;
      with_black_sides += !lit.black_sides().empty();
    } else {
      EXPECT_GT(lost.escaped, 0) << k;
      ++open;
    }
  }
  EXPECT_GT(closed, 10);
  EXPECT_GT(open, 10);
  EXPECT_GT(with_black_sides, 5);
}

// Bounds hold where black sides are seen, though nothing is said of the rest of space; within the box there is no
// light.
TEST(LitRegions, are_what_bounds_need) {
  test::Room room;
  room.box({0, 0, 0}, {1.5, 1, 1}, 1, true, .6, .2);
  const Vec3 u(.4, 0, 0), v(0, .3, 0), w(0, 0, .5), corner(.7, .3, 0);
  room.wall(corner, w, v, 1, .4, 1);
  room.wall(corner + u, v, w, 1, .5);
  room.wall(corner, u, w, 1, .7);
  room.wall(corner + v, w, u, 1, .3);
  room.wall(corner + w, u, v, 1, .5);
  const scene::Scene scene = room.finish();
  const LitRegions lit(scene);
  ASSERT_TRUE(lit.closed());
  ASSERT_FALSE(lit.black_sides().empty());
  core::LocalRun run(1, 2);
  const test::NearlyTrue truth(scene, .8, run.get());
  const RadiositySolution s = test::solved(scene, .8, 0, run.get());
  EXPECT_FALSE(s.closed);
  constexpr double doubt_of_truth = 1e-3;
  const Enclosure enclosure(scene, s, 8e9, run.get());
  const test::Held held = test::held_against(enclosure, s, truth, doubt_of_truth, 1);
  EXPECT_EQ(held.outside, 0) << held.points;
  EXPECT_LT(held.width, 4 * held.largest_error);  // with a box around it all and every black side: 6.5
  for (const Vec3& x : {Vec3(.9, .45, .2), Vec3(.3, .3, .5), Vec3(2, 3, 4)}) {
    const measure::PointIrradiance at{x, Vec3(.1, -.2, 1).normalized(), {}};
    const Interval H = enclosure.irradiance_at(at);
    EXPECT_LT(H.lower[0], truth.irradiance(at) + doubt_of_truth);
    EXPECT_GT(H.upper[0], truth.irradiance(at) - doubt_of_truth);
  }
}

}  // namespace
}  // namespace interflect::fem
