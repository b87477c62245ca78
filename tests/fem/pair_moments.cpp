#include "fem/form_factor/pair_moments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "fem/kernel.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

using test::Room;

/// All blocks of a few elements.
struct Blocks {
  Blocks(std::span<const scene::SurfacePatch> patches, int order, double tolerance)
      : constants(patches, tolerance), moments(constants.shapes(), order, tolerance) {}
  PairMoments operator()(Index i, Index j) const { return moments(i, j, constants(i, j)); }

  PairIntegrator constants;
  MomentIntegrator moments;
};

/// A room of 5 x 4 x 3 m with a slanted ceiling: quads that are no rectangles, and triangles; all touch.
Room slanted_room() {
  Room room;
  const Vec3 a(0, 0, 0), b(5, 0, 0), c(5, 4, 0), d(0, 4, 0), A(0, 0, 3), B(5, 0, 2), C(5, 4, 1.5), D(0, 4, 3);
  const auto quad = [&](const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
    const Vec3 ring[] = {p, q, r, s};
    room.patches.push_back(scene::make_patch(scene::SurfaceId{0}, scene::Side::front, ring));
  };
  const auto triangle = [&](const Vec3& p, const Vec3& q, const Vec3& r) {
    const Vec3 ring[] = {p, q, r};
    room.patches.push_back(scene::make_patch(scene::SurfaceId{0}, scene::Side::front, ring));
  };
  quad(a, b, c, d);
  quad(a, A, B, b);
  quad(b, B, C, c);
  quad(c, C, D, d);
  quad(d, D, A, a);
  triangle(A, D, B);
  triangle(C, B, D);
  return room;
}

// What a closed room sends back of constants: int N_a, which is A for the first function and 0 for all others.
TEST(PairMoments, of_a_closed_room_of_touching_elements_add_up_function_by_function) {
  Room box;
  box.box({0, 0, 0}, {5, 4, 3}, 1);
  for (const auto& room : {box.patches, slanted_room().patches})
    for (const int order : {1, 2, 3}) {
      const double tolerance = std::pow(10, order - 7);
      const Blocks blocks(room, order, tolerance);
      const auto n = std::ssize(room);
      for (Index i = 0; i < n; ++i) {
        Moments sum = Moments::Zero(blocks.moments.basis(i).size(), 1);
        double error = 0;
        for (Index j = 0; j < n; ++j) {
          if (blocks.constants(i, j).facing == Facing::away) continue;
          const PairMoments block = blocks(i, j);
          sum += block.value.col(0);
          error += block.error;
        }
        const double area = room[static_cast<std::size_t>(i)].area;
        EXPECT_LT(error, 2 * tolerance * area);
        sum(0, 0) -= area;
        EXPECT_LE(sum.cwiseAbs().maxCoeff(), error + 1e-13 * area) << order << ' ' << i;
      }
    }
}

TEST(PairMoments, of_constants_are_those_of_constants_and_a_pair_has_one_block) {
  const Room room = slanted_room();
  const Blocks blocks(room.patches, 2, 1e-5);
  for (Index i = 0; i < std::ssize(room.patches); ++i)
    for (Index j = 0; j < i; ++j) {
      const PairIntegral constants = blocks.constants(i, j);
      if (constants.facing == Facing::away) continue;
      const PairMoments there = blocks(i, j), back = blocks(j, i);
      EXPECT_NEAR(there.value(0, 0), constants.value, there.error + constants.error);
      EXPECT_LE((there.value - back.value.transpose()).cwiseAbs().maxCoeff(), there.error + back.error);
    }
}

/// By products of Gauss rules with many nodes, for elements that are apart.
Moments by_products(const scene::SurfacePatch& a, const PlaneBasis& of_a, const scene::SurfacePatch& b,
                    const PlaneBasis& of_b, const Vec3& origin) {
  const Rule rule = gauss_legendre(10);
  const auto nodes = [&](const scene::SurfacePatch& patch) {
    std::vector<SurfaceNode> out;
    for (const RuleNode& p : rule)
      for (const RuleNode& q : rule) {
        const double squeezed = patch.corners == 3 ? 1 - q.u : 1, u = p.u * squeezed;
        out.push_back(
            {point_on(patch.ring(), u, q.u), p.weight * q.weight * squeezed * jacobian(patch.ring(), u, q.u)});
      }
    return out;
  };
  Moments sum = Moments::Zero(of_a.size(), of_b.size());
  const SpaceKernel kernel;
  const auto at_a = nodes(a), at_b = nodes(b);
  for (const SurfaceNode& x : at_a)
    for (const SurfaceNode& y : at_b)
      sum += x.weight * y.weight * kernel(x.position, a.normal(), y.position, b.normal()) *
             of_a.at(x.position - origin) * of_b.at(y.position - origin).transpose();
  return sum;
}

scene::SurfacePatch random_element(core::RandomNumbers& random, const Vec3& at, double size) {
  const auto vector = [&] { return Vec3(2 * random.next() - 1, 2 * random.next() - 1, 2 * random.next() - 1); };
  const Vec3 u = size * vector().normalized();
  Vec3 v = vector();
  v = size * (0.3 + random.next()) * (v - 0.9 * v.dot(u) / u.squaredNorm() * u).normalized();
  const Vec3 quad[] = {at, at + u, at + (0.6 + 0.4 * random.next()) * u + v, at + v}, triangle[] = {at, at + u, at + v};
  return random.next() < 0.5 ? scene::make_patch(scene::SurfaceId{0}, scene::Side::front, quad)
                             : scene::make_patch(scene::SurfaceId{0}, scene::Side::front, triangle);
}

// Random pairs two to six sizes apart.  Of 600 blocks each, errors beyond what is stated are at most 1 %.
TEST(PairMoments, of_elements_that_are_apart_err_less_than_stated) {
  core::RandomNumbers random(5, 0, 0);
  for (const int order : {1, 2, 3}) {
    int beyond = 0, count = 0;
    std::vector<double> ratios;
    while (count < 600) {
      const double apart = 2.2 + 4 * random.next();
      const std::array patches{random_element(random, Vec3::Zero(), 1),
                               random_element(random, Vec3(apart, 0.5, 0.3), 0.3 + random.next())};
      const Blocks blocks(patches, order, 1e-4);
      const PairIntegral constants = blocks.constants(0, 1);
      if (constants.facing != Facing::full || constants.value < 1e-4) continue;
      ++count;
      const PairMoments block = blocks(0, 1);
      EXPECT_LE(block.error, 1e-4 * constants.value);
      const Moments truth = by_products(patches[0], blocks.moments.basis(0), patches[1], blocks.moments.basis(1),
                                        blocks.constants.shapes().origin());
      const double error = (block.value - truth).cwiseAbs().maxCoeff();
      beyond += error > block.error;
      ratios.push_back(block.error / std::max(error, 1e-300));
    }
    std::nth_element(ratios.begin(), ratios.begin() + 300, ratios.end());
    EXPECT_LE(beyond, 6) << order;
    EXPECT_LT(ratios[300], 100) << order << ": the median of stated / true";
    RecordProperty("median_" + std::to_string(order), std::to_string(ratios[300]));
  }
}

}  // namespace
}  // namespace interflect::fem
