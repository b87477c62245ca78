#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "tests/fem/bounds/random_room.h"
#include "tests/fem/space/returned.h"

// Manufactured solutions, as in manufactured.cpp, in many rooms of four kinds: each gives its b_f back to the tolerance
// of form factors, whatever the mesh and the scale.  SeenRadiosity asks for faces that are convex, not for rooms or
// bodies that are: what hides has a face turned away from the point, be it of a body or of a wall that juts in.
namespace interflect::fem {
namespace {

using test::between;
using test::Manufactured;
using test::Random;

/// A polygon, seen from above, of convex quads side by side.
struct Plan {
  std::vector<Vec3> outline;                      ///< counter-clockwise
  std::vector<std::array<std::size_t, 4>> parts;  ///< of its corners
};
/// An L: a rectangle without one corner, its arms of any width.
Plan l_shape(double width, double depth, Random& random) {
  const double x = between(.35, .65, random) * width, y = between(.35, .65, random) * depth;
  // The cut from the corner that juts in to the opposite one leaves two convex quads.
  return {{{0, 0, 0}, {width, 0, 0}, {width, y, 0}, {x, y, 0}, {x, depth, 0}, {0, depth, 0}},
          {{{0, 1, 2, 3}}, {{0, 3, 4, 5}}}};
}

/// The inside of a prism, or its outside.
/// @param place  where corners go
void add_prism(scene::SceneBuilder& builder, const Plan& plan, double height, bool inwards, Random& random,
               const std::function<Vec3(const Vec3&)>& place) {
  const Vec3 up(0, 0, height);
  const auto add = [&](std::vector<Vec3> ring) {
    if (!inwards) std::reverse(ring.begin(), ring.end());
    for (Vec3& x : ring) x = place(x);
    builder.add_polygon("face", {ring, {}}, builder.add_material(test::diffuse(between(.2, .8, random))));
  };
  for (const auto& part : plan.parts) {
    std::vector<Vec3> floor, ceiling;
    for (const std::size_t k : part) floor.push_back(plan.outline[k]), ceiling.push_back(plan.outline[k] + up);
    std::reverse(ceiling.begin(), ceiling.end());
    add(floor);
    add(ceiling);
  }
  for (std::size_t k = 0; k < plan.outline.size(); ++k) {
    const Vec3 &a = plan.outline[k], &b = plan.outline[(k + 1) % plan.outline.size()];
    add({a, a + up, b + up, b});
  }
}

void add_tetrahedron(scene::SceneBuilder& builder, const Vec3& middle, double size, Random& random, double scale) {
  Vec3 axis;
  for (double& along : axis) along = between(-1, 1, random);
  const Eigen::AngleAxisd turn(between(.3, 2.8, random), axis.normalized());
  std::array<Vec3, 4> corner{Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)};
  for (Vec3& x : corner) x = scale * (middle + turn * (size * x));
  const auto material = builder.add_material(test::diffuse(between(.2, .8, random)));
  for (const auto [i, j, k] : {std::array{0u, 1u, 2u}, {0u, 2u, 3u}, {0u, 3u, 1u}, {1u, 3u, 2u}})
    builder.add_polygon("body", {{corner[i], corner[j], corner[k]}, {}}, material);
}

/// A room on an L, in whose arms walls hide each other, with a tetrahedron in one of them.
scene::Scene l_shaped_room(Random& random, double scale) {
  scene::SceneBuilder builder({"y"}, scene::Quantity::radiometric);
  const double w = between(1.6, 2.2, random), d = between(1.4, 1.8, random), h = between(.8, 1.2, random);
  const Plan plan = l_shape(w, d, random);
  add_prism(builder, plan, h, true, random, [&](const Vec3& x) -> Vec3 { return scale * x; });
  const Vec3& juts = plan.outline[3];  // the body is beside it, in the arm along x
  add_tetrahedron(builder, {.5 * (juts.x() + w), .5 * juts.y(), .5 * h}, between(.06, .12, random), random, scale);
  return builder.finish();
}

/// A box with an L in it, turned about the vertical.
scene::Scene room_with_an_l(Random& random, double scale) {
  scene::SceneBuilder builder({"y"}, scene::Quantity::radiometric);
  const Vec3 size{between(1.6, 2.2, random), between(1.5, 2, random), between(1.2, 1.6, random)};
  const Plan box{{{0, 0, 0}, {size.x(), 0, 0}, {size.x(), size.y(), 0}, {0, size.y(), 0}}, {{{0, 1, 2, 3}}}};
  add_prism(builder, box, size.z(), true, random, [&](const Vec3& x) -> Vec3 { return scale * x; });
  const Eigen::AngleAxisd turn(between(.3, 2.8, random), Vec3::UnitZ());
  const double wide = between(.5, .8, random), deep = between(.5, .8, random), high = between(.2, .4, random);
  add_prism(builder, l_shape(wide, deep, random), high, false, random,
            [&](const Vec3& x) -> Vec3 { return scale * (.5 * size + turn * (x - Vec3(.3, .3, .5 * high))); });
  return builder.finish();
}

enum class Kind { box_in_trapezoid, tetrahedra, l_shaped, round_an_l };

scene::Scene room_of(Kind kind, Random& random, double scale) {
  switch (kind) {
    case Kind::box_in_trapezoid:
      return test::random_room(random, scale);
    case Kind::tetrahedra:
      return test::room_of_tetrahedra(random, scale);
    case Kind::l_shaped:
      return l_shaped_room(random, scale);
    default:
      return room_with_an_l(random, scale);
  }
}

std::vector<scene::SurfacePatch> elements_of(const scene::Scene& scene, unsigned seed, Random& random) {
  if (seed % 3 == 0) return test::whole_surfaces(scene);
  return seed % 3 == 1 ? test::unequal_elements(scene, random) : test::elements_with_hanging_corners(scene, random);
}

/// Rooms of a kind, at three scales: on whole faces, on unequal elements, and on some whose corners hang.  (Bodies that
/// are not convex are as many blockers as they have faces, and cost milliseconds a pair: whole faces alone.)
void expect_returned(Kind kind, unsigned rooms) {
  constexpr double tolerance = 1e-3;
  for (unsigned seed = 1; seed <= rooms; ++seed) {
    Random random(100 * unsigned(kind) + seed);
    const double scale = std::array{1., 1e-6, 1e6, 1e-6, 1e6, 1.}[(seed - 1) % 6];
    scene::Scene scene = room_of(kind, random, scale);
    const bool costly = kind == Kind::round_an_l, whole = costly || seed % 3 == 0;
    auto patches = elements_of(scene, costly ? 0 : seed, random);
    const Manufactured m(std::move(scene), std::move(patches), whole ? 8 : 4, random, 2);
    for (int order = 0; order <= (costly ? 0 : whole ? 2 : int(seed % 2)); ++order) {
      const test::Returned r = test::returned(m, order, tolerance);
      EXPECT_LT(r.error, r.of_entries + r.of_loads) << seed << ", order " << order;
      EXPECT_LT(r.error, tolerance / 5) << seed << ", order " << order;  // 9.2e-5 at most
    }
  }
}

TEST(ManufacturedRooms, with_a_box_return_their_radiosity) { expect_returned(Kind::box_in_trapezoid, 8); }
TEST(ManufacturedRooms, with_turned_tetrahedra_return_their_radiosity) { expect_returned(Kind::tetrahedra, 6); }
TEST(ManufacturedRooms, on_an_l_return_their_radiosity) { expect_returned(Kind::l_shaped, 6); }
TEST(ManufacturedRooms, round_an_l_return_their_radiosity) { expect_returned(Kind::round_an_l, 4); }

}  // namespace
}  // namespace interflect::fem
