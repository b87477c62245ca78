#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "tests/fem/space/flatland.h"

// What a solution has of its order where the exact one is smooth.  With the best approximation P B on elements,
// Galerkin's equations are
//
//   B_h = P E + rho P T B_h,   P B = P E + rho P T B     so that     B_h - P B = (1 - rho P T)^-1 rho P T (P B - B)
//
// and B_h -> B as fast as P B does, h^(p + 1) where B has p + 1 bounded derivatives on each wall, whatever hides: a
// shadow's edge is in E = B - rho T B, and in P T, but not in B.  Walls that touch do not matter either.
namespace interflect::fem {
namespace {

using test::Segment;

constexpr Index walls = 4;
const std::array<Vec3, walls> corner{Vec3(0, 0, 0), Vec3(1.4, .1, 0), Vec3(1.2, 1, 0), Vec3(.1, .8, 0)};
constexpr std::array<double, walls> reflectance{.4, .8, .5, .7};
/// Black on both sides, within the walls.
const Vec3 blocker[] = {Vec3(.5, .3, 0), Vec3(.8, .55, 0)};

double exact(const Vec3& x) { return 1.5 + .5 * std::sin(3 * x.x() + 1) * std::cos(2 * x.y()); }

double cross(const Vec3& a, const Vec3& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Where the line through p and q meets a segment, if that is in 0 .. 1.
double met(const Segment& s, const Vec3& p, const Vec3& q) {
  return cross(p - s.from, q - p) / cross(s.to - s.from, q - p);
}
Segment wall(Index i) { return {corner[std::size_t(i)], corner[std::size_t((i + 1) % walls)]}; }

/// 0, 1, and between them where the end of a shadow of the blocker, or itself, comes into line with any of some points.
std::vector<double> kinks(const Segment& on, std::span<const Vec3> points) {
  std::vector<double> u{0, met(on, blocker[0], blocker[1]), 1};
  for (const Vec3& end : blocker)
    for (const Vec3& x : points) u.push_back(met(on, end, x));
  std::erase_if(u, [](double at) { return !(at >= 0 && at <= 1); });
  std::sort(u.begin(), u.end());
  return u;
}

/// The part of a segment behind the blocker, seen from a wall: where both of the following are not negative.
std::pair<double, double> hidden(const Vec3& x, const Segment& part) {
  Vec3 p = blocker[0] - x, q = blocker[1] - x;
  if (cross(p, q) < 0) std::swap(p, q);
  double low = 0, high = 1;
  for (const auto& [at_0, at_1] : {std::pair(cross(p, part.from - x), cross(p, part.to - x)),
                                   std::pair(cross(part.from - x, q), cross(part.to - x, q))}) {
    if (at_0 < 0 && at_1 < 0) return {0, 0};
    if (at_0 < 0) low = std::max(low, at_0 / (at_0 - at_1));
    if (at_1 < 0) high = std::min(high, at_0 / (at_0 - at_1));
  }
  return {low, std::max(low, high)};
}

/// As if nothing hid, less what is hidden: that is apart from the ends that segments share, and smooth between kinks.
class SeenPairRule final : public PairRule {
 public:
  explicit SeenPairRule(int points) : all_(points), rule_(gauss_legendre(points)) {}

  void for_nodes(const Panel& a, const Panel& b, const Visit& visit) const override {
    all_.for_nodes(a, b, visit);
    const Segment on{a.corner[0], a.corner[1]}, of{b.corner[0], b.corner[1]};
    const std::vector<double> u = kinks(on, b.ring());
    for (std::size_t k = 0; k + 1 < u.size(); ++k)
      for (const RuleNode& p : rule_) {
        const double at = u[k] + (u[k + 1] - u[k]) * p.u;
        const auto [low, high] = hidden(on.at(at), of);
        for (const RuleNode& q : rule_)
          visit({at, 0, low + (high - low) * q.u, 0, -p.weight * (u[k + 1] - u[k]) * q.weight * (high - low)});
      }
  }

 private:
  SegmentPairRule all_;
  Rule rule_;
};

/// T B at a point of a wall.
double arriving(Index on, const Vec3& x) {
  const Vec3 normal = segment_panel(wall(on).from, wall(on).to).normal;
  double sum = 0;
  for (Index j = 0; j < walls; ++j) {
    if (j == on) continue;
    const Segment whole = wall(j);
    const auto [low, high] = hidden(x, whole);
    for (const auto& [sign, part] : {std::pair(1, whole), std::pair(-1, Segment{whole.at(low), whole.at(high)})})
      if (part.from != part.to) sum += sign * test::sent(x, normal, part, [&](double u) { return exact(part.at(u)); });
  }
  return sum;
}

/// P E: T B has kinks where a corner comes into line with an end of the blocker, and is x ln x from a corner.
Eigen::VectorXd exitance(const Space& space, Index a_wall) {
  Eigen::VectorXd e = Eigen::VectorXd::Zero(space.layout().unknowns());
  const Rule gauss = gauss_legendre(12);
  for (Index i = 0; i < std::ssize(space.panels()); ++i) {
    const Panel& panel = space.panel(i);
    const std::vector<double> u = kinks({panel.corner[0], panel.corner[1]}, corner);
    Rule rule;
    for (std::size_t k = 0; k + 1 < u.size(); ++k)
      for (const RuleNode& node : gauss) {
        const double t = node.u, length = u[k + 1] - u[k];
        rule.push_back({u[k] + length * t * t * (3 - 2 * t), 0, 6 * t * (1 - t) * length * node.weight});
      }
    const PanelNodes at = space.nodes(i, rule);
    for (std::size_t q = 0; q < at.weight.size(); ++q) {
      const Vec3& x = at.position[q];
      e.segment(space.first(i), space.functions(i)) +=
          at.weight[q] / panel.measure * (exact(x) - reflectance[std::size_t(i / a_wall)] * arriving(i / a_wall, x)) *
          at.values.row(Index(q)).transpose();
    }
  }
  return e;
}

struct Distances {
  double of_solution, of_best;  ///< from the exact one, in L2
};
Distances distances(int n, int order, const PairRule& rule) {
  std::vector<Panel> panels;
  for (Index i = 0; i < walls; ++i)
    for (int k = 0; k < n; ++k)
      panels.push_back(segment_panel(wall(i).at(double(k) / n), wall(i).at(double(k + 1) / n)));
  const Space space(std::move(panels), order);
  test::LastEntrySink sink(space.gram().size());
  core::LocalRun run(1, 2);
  galerkin(space, FlatlandKernel(), rule, sink, run.get());
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(sink.K.rows(), sink.K.rows());
  for (Index i = 0; i < std::ssize(space.panels()); ++i)
    A.middleRows(space.first(i), space.functions(i)) -= reflectance[std::size_t(i / n)] / space.panel(i).measure *
                                                        sink.K.middleRows(space.first(i), space.functions(i));
  const auto of = [](Index, const Vec3& x) { return exact(x); };
  return {space.distance(A.partialPivLu().solve(exitance(space, n)), of, 10),
          space.distance(space.project(of, 10), of, 10)};
}

// And the solution is hardly farther from the truth than the best approximation.
TEST(SmoothSolution, has_its_order_past_a_blocker_in_flatland) {
  for (const int order : {0, 1, 2}) {
    const Distances at[] = {distances(4, order, SeenPairRule(16)), distances(8, order, SeenPairRule(16)),
                            distances(16, order, SeenPairRule(16))};
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_NEAR(std::log2(at[k].of_solution / at[k + 1].of_solution), order + 1, .1) << order << ' ' << k;
    for (const Distances& d : at) {
      EXPECT_GE(d.of_solution, d.of_best);
      EXPECT_LT(d.of_solution, 1.01 * d.of_best) << order;  // 1.0073 at most
    }
  }
}

// With K of walls that nothing hides it goes nowhere.
TEST(SmoothSolution, is_missed_where_the_blocker_is_left_out) {
  const double coarse = distances(4, 1, SegmentPairRule(16)).of_solution,
               fine = distances(8, 1, SegmentPairRule(16)).of_solution;
  EXPECT_LT(std::abs(std::log2(coarse / fine)), .1);
}

}  // namespace
}  // namespace interflect::fem
