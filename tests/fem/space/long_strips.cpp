#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "fem/point_view_factors.h"
#include "fem/quadrature.h"
#include "fem/space/plane_basis.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

/// What of the strips' length is missing is seen as its inverse cube.
constexpr double half_length = 4e3;

/// Two strips about the z axis, the lower at y = 0 emits 1; perhaps with a black one half-way.
struct StripScene {
  double half_width, gap, half_blocker, rho_low, rho_high;
};

/// Radiosity of strips, a function of x alone: in the middle of strips so long that their ends are not seen, by
/// collocation of polynomials at Gauss points, with what the blocker hides taken out exactly.
class LongStrips {
 public:
  explicit LongStrips(const StripScene& strips) : strips_(strips) {
    const double w = strips.half_width, b = strips.half_blocker;
    low_ = room_.wall({-w, 0, half_length}, {2 * w, 0, 0}, {0, 0, -2 * half_length}, 0);
    high_ = room_.wall({-w, strips.gap, -half_length}, {2 * w, 0, 0}, {0, 0, 2 * half_length}, 0);
    if (b > 0) {
      room_.screen({-b, strips.gap / 2, -half_length}, {2 * b, 0, 0}, {0, 0, 2 * half_length});
    }
    scene_ = room_.finish();
    cut();
    solve();
  }

  double low(double x) const { return 1 + strips_.rho_low * row(x, true).dot(B_); }
  double high(double x) const { return strips_.rho_high * row(x, false).dot(B_); }
  double mean_low() const { return weights_.dot(B_.head(nodes)); }
  double mean_high() const { return weights_.dot(B_.tail(nodes)); }
  /// From the lower strip to the upper one.
  double form_factor() const { return weights_.dot(T_.topRows(nodes).rowwise().sum()); }

 private:
  static constexpr int parts = 32, order = 3, each = order + 1, nodes = parts * each;  // of a strip

  double left(int part) const { return strips_.half_width * (2.0 * part / parts - 1); }
  double node(int k) const { return left(k / each) + 2 * strips_.half_width / parts * rule_[std::size_t(k % each)].u; }
  /// Lagrange's polynomials of a part's nodes, at u in [0, 1].
  Eigen::Matrix<double, each, 1> lagrange(double u) const {
    Eigen::Matrix<double, each, 1> values;
    values.setOnes();
    for (int a = 0; a < each; ++a)
      for (int b = 0; b < each; ++b)
        if (b != a) values[a] *= (u - rule_[std::size_t(b)].u) / (rule_[std::size_t(a)].u - rule_[std::size_t(b)].u);
    return values;
  }
  void cut() {
    for (const bool is_low : {true, false})
      for (int part = 0; part < parts; ++part) {
        const double y = is_low ? 0 : strips_.gap, z = is_low ? half_length : -half_length, a = left(part),
                     b = left(part + 1);
        const Vec3 ring[] = {{a, y, z}, {b, y, z}, {b, y, -z}, {a, y, -z}};
        patches_.push_back(scene::make_patch(is_low ? low_ : high_, scene::Side::front, ring));
        to_functions_.push_back(coefficients(patches_.back()));
      }
    factors_ = std::make_unique<PointViewFactors>(scene_, patches_, order);
  }
  /// Lagrange's polynomials in the element's functions: the means of their products.
  Eigen::MatrixXd coefficients(const scene::SurfacePatch& patch) const {
    const PlaneBasis basis(order, patch.ring(), patch.normal());
    Eigen::MatrixXd found = Eigen::MatrixXd::Zero(basis.size(), each);
    for (const RuleNode& p : rule_)
      for (const RuleNode& q : rule_)
        found += p.weight * q.weight * basis.at(point_on(patch.ring(), p.u, q.u)) * lagrange(p.u).transpose();
    return found;
  }
  /// H at x is the product with values at nodes.
  Eigen::VectorXd row(double x, bool is_low) const {
    const Index functions = factors_->functions();
    std::vector<double> F(patches_.size() * static_cast<std::size_t>(functions)), error(patches_.size());
    const Vec3 up = Vec3::UnitY();
    (*factors_)({{x, is_low ? 0 : strips_.gap, 0}, is_low ? up : -up, is_low ? low_ : high_}, F, error);
    const Eigen::Map<const Eigen::VectorXd> all(F.data(), std::ssize(F));
    Eigen::VectorXd found(2 * nodes);
    for (Index j = 0; j < std::ssize(patches_); ++j)
      found.segment(j * each, each) = to_functions_[std::size_t(j)].transpose() * all.segment(j * functions, functions);
    return found;
  }
  void solve() {
    T_.resize(2 * nodes, 2 * nodes);
    weights_.resize(nodes);
    for (int k = 0; k < nodes; ++k) {
      T_.row(k) = row(node(k), true);
      T_.row(nodes + k) = row(node(k), false);
      weights_[k] = rule_[std::size_t(k % each)].weight / parts;
    }
    Eigen::MatrixXd A = Eigen::MatrixXd::Identity(2 * nodes, 2 * nodes) - strips_.rho_low * T_;
    A.bottomRows(nodes) += (strips_.rho_low - strips_.rho_high) * T_.bottomRows(nodes);
    Eigen::VectorXd e = Eigen::VectorXd::Zero(2 * nodes);
    e.head(nodes).setOnes();
    B_ = A.partialPivLu().solve(e);
  }

  StripScene strips_;
  test::Room room_;
  scene::Scene scene_;
  scene::SurfaceId low_, high_;
  Rule rule_ = gauss_legendre(each);
  std::vector<scene::SurfacePatch> patches_;
  std::vector<Eigen::MatrixXd> to_functions_;
  std::unique_ptr<PointViewFactors> factors_;
  Eigen::MatrixXd T_;
  Eigen::VectorXd weights_, B_;
};

// docs/truths.md 2.8.  Radiosity has kinks where the blocker's edges and the other strip's are in line, at x = +-1/2.
TEST(LongStrips, past_a_blocker_have_their_known_radiosities) {
  const LongStrips strips({1, 1, .25, .5, .7});
  const std::array low{1.044683677347, 1.054822801548, 1.067421001709, 1.070747337560, 1.063080001299};
  const std::array high{.194511893729, .251466310156, .332605918213, .352938607029, .309483757659};
  for (std::size_t k = 0; k < low.size(); ++k)
    for (const double x : {.25 * double(k), -.25 * double(k)}) {
      EXPECT_NEAR(strips.low(x), low[k], 1e-10) << x;
      EXPECT_NEAR(strips.high(x), high[k], 1e-10) << x;
    }
  EXPECT_NEAR(strips.mean_low(), 1.062023277866, 1e-10);
  EXPECT_NEAR(strips.mean_high(), .298860229559, 1e-10);
  EXPECT_NEAR(strips.form_factor(), std::sqrt(13) / 4 - .5, 1e-10);  // by crossed strings
}

// docs/truths.md 2.3.
TEST(LongStrips, face_to_face_have_their_known_radiosities) {
  struct Known {
    double gap;
    std::array<double, 3> low, high;  ///< at an end, a quarter, and the middle
    double mean_low, mean_high;
  };
  for (const Known& known : {Known{1,
                                   {1.038307288006, 1.045825798975, 1.048734329871},
                                   {.184748155886, .220170814564, .233749435383},
                                   1.045047163443,
                                   .216481590757},
                             Known{.25,
                                   {1.102135637839, 1.197640213917, 1.227377118753},
                                   {.282251325669, .493323684631, .540555988849},
                                   1.186076963405,
                                   .465253524630}}) {
    const LongStrips strips({.5, known.gap, 0, .5, .5});
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(strips.low(.25 * double(k) - .5), known.low[k], 1e-10) << known.gap << ' ' << k;
      EXPECT_NEAR(strips.high(.25 * double(k) - .5), known.high[k], 1e-10) << known.gap << ' ' << k;
    }
    EXPECT_NEAR(strips.mean_low(), known.mean_low, 1e-10) << known.gap;
    EXPECT_NEAR(strips.mean_high(), known.mean_high, 1e-10) << known.gap;
    EXPECT_NEAR(strips.form_factor(), std::sqrt(1 + known.gap * known.gap) - known.gap, 1e-10);  // by crossed strings
  }
}

}  // namespace
}  // namespace interflect::fem
