#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/fem/space/flatland.h"

namespace interflect::fem {
namespace {

/// A square duct, side 0 emits 1, counter-clockwise.  docs/truths.md 2.5.
struct Duct {
  double rho;
  std::array<double, 3> mean;  ///< of sides 0, 1 (and 3), 2
};
constexpr std::array<Duct, 2> ducts{Duct{.5, {1.14863019130, .26959682702, .31217615466}},
                                    Duct{.8, {1.85479486938, 1.02982990540, 1.08554531983}}};

/// A side cut at x_k = 1/2 (2k/n)^grading, and likewise from its other end.
std::vector<double> cuts(int n, double grading) {
  std::vector<double> x;
  for (int k = 0; k <= n; ++k) {
    const double s = 2.0 * std::min(k, n - k) / n, from_end = .5 * std::pow(s, grading);
    x.push_back(2 * k <= n ? from_end : 1 - from_end);
  }
  return x;
}

std::vector<Panel> duct(const std::vector<double>& x) {
  const std::array<Vec3, 5> corner{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0), Vec3(0, 0, 0)};
  std::vector<Panel> panels;
  for (std::size_t side = 0; side < 4; ++side)
    for (std::size_t k = 0; k + 1 < x.size(); ++k) {
      const Vec3 along = corner[side + 1] - corner[side];
      panels.push_back(segment_panel(corner[side] + x[k] * along, corner[side] + x[k + 1] * along));
    }
  return panels;
}

class Solution {
 public:
  Solution(std::vector<double> cuts, int order, double rho)
      : cuts_(std::move(cuts)),
        space_(duct(cuts_), order),
        c_(test::solved_in_flatland(
            space_, rho, [](Index i, const Vec3& x) { return i >= 0 && x.y() < 1e-12 ? 1.0 : 0.0; }, 24)) {}

  double mean(Index side) const {
    double sum = 0;
    for (Index i = side * a_side(); i < (side + 1) * a_side(); ++i)
      sum += space_.panel(i).measure * c_[space_.first(i)];
    return sum;
  }
  /// In L2, from one whose panels are cut where these are, or anywhere.
  double distance(const Solution& other) const {
    return space_.distance(
        c_, [&](Index i, const Vec3& x) { return other.at(i / a_side(), x); }, gauss_points);
  }

 private:
  static constexpr int gauss_points = 40;

  Index a_side() const { return std::ssize(cuts_) - 1; }
  double at(Index side, const Vec3& x) const {
    const Vec3& start = space_.panel(side * a_side()).corner[0];
    const double t = (x - start).norm();
    const auto after = std::upper_bound(cuts_.begin() + 1, cuts_.end() - 1, t);
    const double u = (t - *(after - 1)) / (*after - *(after - 1));
    return space_.value(c_, side * a_side() + (after - cuts_.begin()) - 1, u, 0);
  }

  std::vector<double> cuts_;
  Space space_;
  Eigen::VectorXd c_;
};

/// Towards both ends by a factor of 0.45, 34 times, with polynomials of degree 3.
Solution reference(double rho) {
  constexpr int levels = 34;
  std::vector<double> x{0};
  for (int k = levels - 1; k >= 0; --k) x.push_back(.5 * std::pow(.45, k));
  for (std::size_t k = x.size() - 1; k-- > 0;) x.push_back(1 - x[k]);
  return Solution(x, 3, rho);
}

TEST(FlatlandDuct, has_its_known_means) {
  for (const Duct& known : ducts) {
    const Solution solution = reference(known.rho);
    for (const auto& [side, mean] : {std::pair(0, 0), std::pair(1, 1), std::pair(2, 2), std::pair(3, 1)})
      EXPECT_NEAR(solution.mean(side), known.mean[static_cast<std::size_t>(mean)], 2e-10) << known.rho << " " << side;
  }
}

// The kernel is singular where sides meet, and radiosity has no bounded second derivative there: equal panels have
// order 1.1 whatever the degree.  Panels that shrink towards the corners have their order again.
TEST(FlatlandDuct, loses_its_orders_in_the_corners_and_has_them_back_on_graded_meshes) {
  const Solution exact = reference(.8);
  const auto order = [&](int degree, double grading, int n) {
    const double coarse = Solution(cuts(n / 2, grading), degree, .8).distance(exact),
                 fine = Solution(cuts(n, grading), degree, .8).distance(exact);
    return std::log2(coarse / fine);
  };
  EXPECT_NEAR(order(1, 1, 32), 1.14, .05);
  EXPECT_NEAR(order(2, 1, 32), 1.12, .05);
  EXPECT_NEAR(order(1, 3, 32), 2, .1);
  EXPECT_NEAR(order(2, 5, 16), 3, .25);
}

}  // namespace
}  // namespace interflect::fem
