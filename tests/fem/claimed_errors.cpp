#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/random.h"
#include "fem/form_factor/hidden_exchange.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

using test::Room;

/// What the analytic method says of one pair.
class OnePair final : public ExchangeSink {
 public:
  void add(Index, Index, const ExchangeEntry& of_pair) override { entry = of_pair; }
  ExchangeEntry entry;
};

/// Stated over true error of each pair whose true error is more than rounding, and how many pairs state too little.
struct Claims {
  std::size_t pairs = 0, too_small = 0;
  std::vector<double> ratios;

  double median() {
    const auto middle = ratios.begin() + static_cast<Index>(ratios.size() / 2);
    std::nth_element(ratios.begin(), middle, ratios.end());
    return *middle;
  }
};

/// Pairs anywhere in the matrix that may see each other, against the same to a ten-thousandth of the tolerance.
Claims claims_of(Room& room, double tolerance, std::size_t pairs, std::uint32_t stream) {
  const auto scene = room.finish();
  const std::span<const scene::SurfacePatch> patches = room.patches;
  const auto caster = raycast::make_ray_caster("brute", scene);
  const auto make = [&](double to) {
    return make_form_factor_method("analytic", {scene, patches, *caster, 1, to, 16});
  };
  const auto method = make(tolerance), fine = make(1e-4 * tolerance);
  core::LocalRun run(1, 1);
  core::RandomNumbers random(21, stream, 0);
  const auto any = [&] { return static_cast<Index>(random.next() * static_cast<double>(patches.size())); };
  Claims claims;
  while (claims.pairs < pairs) {
    const auto [i, j] = std::minmax({any(), any()});
    if (i == j) continue;
    OnePair coarse, exact;
    if (method->exchange({patches, i, 1}, {patches, j, 1}, coarse, run.get()).facing_away > 0) continue;
    fine->exchange({patches, i, 1}, {patches, j, 1}, exact, run.get());
    ++claims.pairs;
    const double error = std::abs(coarse.entry.K - exact.entry.K);
    if (error <= 1e-13 * exact.entry.K + exact.entry.bound) continue;  // rounding, and what the reference does not know
    claims.too_small += error > coarse.entry.bound;
    claims.ratios.push_back(coarse.entry.bound / error);
  }
  return claims;
}

Room with_two_boxes() {
  Room room;
  room.box({0, 0, 0}, {5, 4, 3}, 10);
  room.box({1, 1, .2}, {1, .8, 1.2}, 4, false);
  room.box({3, 2.2, .5}, {1, .8, 1.1}, 4, false);
  return room;
}

/// Legs that touch the top they carry, one in front of the other: several hide parts of a pair each.
Room with_a_table() {
  Room room;
  room.box({0, 0, 0}, {5, 4, 3}, 7);
  room.box({1, 1, .72}, {1.6, .8, .03}, 3, false);
  for (const double x : {1.0, 2.54})
    for (const double y : {1.0, 1.74}) room.box({x, y, 0}, {.06, .06, .72}, 2, false);
  return room;
}

/// More lines of shadows than an element is cut along.
Room with_a_grove() {
  Room room;
  room.box({0, 0, 0}, {5, 4, 3}, 3);
  for (const double x : {1.0, 2.1, 3.3, 4.1})
    for (const double y : {.8, 1.9, 3.2}) room.box({x, y, .1}, {.04, .05, 2.6}, 1, false);
  return room;
}

/// A hundred triangles of very different sizes that cross each other.
Room of_triangles() {
  core::RandomNumbers random(77, 3, 0);
  const auto vector = [&] {
    const double x = random.next(), y = random.next(), z = random.next();
    return Vec3(2 * x - 1, 2 * y - 1, 2 * z - 1);
  };
  Room room;
  for (int k = 0; k < 100; ++k) {
    const Vec3 centre = 2 * vector();
    const double size = std::pow(10, -1.5 * random.next());
    room.triangle(centre + size * vector(), centre + size * vector(), centre + size * vector());
  }
  return room;
}

/// At least 99 % of the pairs of each scene state enough, and in the median of all not more than ten times too much.
void expect_fair_claims(double tolerance, std::size_t pairs) {
  Room boxes = with_two_boxes(), table = with_a_table(), triangles = of_triangles();
  Claims all;
  for (const Claims& claims :
       {claims_of(boxes, tolerance, pairs / 2, 1), claims_of(table, tolerance, 3 * pairs / 10, 2),
        claims_of(triangles, tolerance, pairs / 5, 4)}) {
    EXPECT_LE(static_cast<double>(claims.too_small), 0.01 * static_cast<double>(claims.pairs)) << tolerance;
    all.ratios.insert(all.ratios.end(), claims.ratios.begin(), claims.ratios.end());
  }
  ASSERT_GT(all.ratios.size(), pairs / 2);
  EXPECT_LE(all.median(), 10) << tolerance;
}

TEST(ClaimedErrors, of_ten_thousand_pairs_are_mostly_enough_and_not_far_more) { expect_fair_claims(1e-4, 10'000); }

TEST(ClaimedErrors, are_as_fair_at_other_tolerances) {
  for (const double tolerance : {1e-3, 1e-6}) expect_fair_claims(tolerance, 2000);
}

TEST(ClaimedErrors, hold_where_more_lines_cross_than_are_cut_along) {
  Room grove = with_a_grove();
  const Claims claims = claims_of(grove, 1e-3, 200, 5);
  EXPECT_LE(static_cast<double>(claims.too_small), 0.01 * static_cast<double>(claims.pairs));
  EXPECT_GT(claims.ratios.size(), 100u);
}

// Equal slats at equal distances may be missed by the nodes of all cells at once: the worst that was found is off
// by 1.6 times what it states.  The truth is a grid of points from each of which what is hidden is exact.
TEST(ClaimedErrors, of_a_comb_are_at_most_twice_too_small) {
  const geometry::Plane up{Vec3::UnitZ(), 0}, down{-Vec3::UnitZ(), -1};
  const ElementShape low = shape_of(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, up);
  const ElementShape high = shape_of(std::vector<Vec3>{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}, down);
  for (const int slats : {16, 32})
    for (const double width : {.002, .01}) {
      std::vector<geometry::ConvexBlocker> slat;
      for (int k = 0; k < slats; ++k) {
        const double from = (k + .5) / slats - width / 2, to = from + width, z = .1;
        slat.push_back(
            geometry::ConvexBlocker::polygon(geometry::Ring{{from, .1, z}, {to, .1, z}, {to, .9, z}, {from, .9, z}}));
      }
      std::vector<const geometry::ConvexBlocker*> blockers;
      for (const geometry::ConvexBlocker& blocker : slat) blockers.push_back(&blocker);
      HiddenExchange hidden(1e-15);
      constexpr int across = 400, along = 25;
      double truth = 0;
      for (int i = 0; i < across; ++i)
        for (int j = 0; j < along; ++j)
          truth += hidden.hidden_factor({(i + .5) / across, (j + .5) / along, 0}, Vec3::UnitZ(), high, blockers);
      truth /= across * along;
      for (const double tolerance : {2e-3, 2e-4}) {
        const HiddenIntegral found = hidden(low, high, blockers, tolerance);
        EXPECT_NEAR(found.value, truth, 2 * found.error + 3e-5) << slats << " slats of " << width;
        EXPECT_LE(found.error, tolerance);
      }
    }
}

}  // namespace
}  // namespace interflect::fem
