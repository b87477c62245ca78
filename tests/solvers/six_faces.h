#pragma once

#include <algorithm>
#include <vector>

#include "solvers/transition_sampler.h"
#include "tests/solvers/random_systems.h"

namespace interflect::solvers {

/// Draws from the rows of a full matrix, or, as lines, from all of its entries: one exchange a line.  All points of an
/// element are alike.
class MatrixSampler final : public TransitionSampler, public LineExchanges, public PointTransitions {
 public:
  explicit MatrixSampler(const FullOperator& K) : K_(K) {
    double sum = 0;
    for (Index i = 0; i < K.matrix().rows(); ++i)
      for (Index j = 0; j < K.matrix().cols(); ++j) cumulative_.push_back(sum += K.matrix()(i, j));
  }
  int dimensions() const override { return 1; }
  std::optional<Index> from_element(Index i, std::span<const double> u) const override {
    double left = u[0] * K_.gram()[static_cast<std::size_t>(i)];
    for (Index j = 0; j < K_.matrix().cols(); ++j)
      if ((left -= K_.matrix()(i, j)) < 0) return j;
    return std::nullopt;
  }
  const LineExchanges* lines() const override { return this; }
  const PointTransitions* points() const override { return this; }
  int functions() const override { return 1; }
  double area(Index element) const override { return K_.gram()[static_cast<std::size_t>(element)]; }
  Point point_on(Index element, std::span<const double>) const override { return {element, Vec3::Zero()}; }
  std::optional<Point> from_point(const Point& point, std::span<const double> u) const override {
    const auto to = from_element(point.element, u);
    return to ? std::optional<Point>({*to, Vec3::Zero()}) : std::nullopt;
  }
  void functions_at(const Point&, std::span<double> values) const override { values[0] = 1; }
  double measure() const override { return cumulative_.back(); }
  void along(std::span<const double> u, std::vector<Exchange>& exchanges) const override {
    const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), u[0] * measure());
    const Index k = std::min<Index>(found - cumulative_.begin(), static_cast<Index>(cumulative_.size()) - 1);
    exchanges.assign(1, {k / K_.matrix().cols(), k % K_.matrix().cols()});
  }

 private:
  const FullOperator& K_;
  std::vector<double> cumulative_;
};

/// The unit cube with a face each: docs/truths.md, variances of random walks.
struct SixFaces {
  SixFaces() : K(matrix(), Eigen::VectorXd::Ones(6)), walks(K) {
    rho.resize(6, 1);
    e = ColumnMatrix::Zero(6, 1);
    rho << .2, .4, .5, .6, .7, .8;
    e(4, 0) = 1;
    e(5, 0) = 2;
    R.emplace(rho);
  }
  static Eigen::MatrixXd matrix() {
    Eigen::MatrixXd F = Eigen::MatrixXd::Constant(6, 6, .200043776075);
    for (Index axis = 0; axis < 3; ++axis) {
      F(2 * axis, 2 * axis) = F(2 * axis + 1, 2 * axis + 1) = 0;
      F(2 * axis, 2 * axis + 1) = F(2 * axis + 1, 2 * axis) = .199824895698;
    }
    return F;
  }
  System system() const { return {K, *R, e, &walks}; }
  /// As a solver needs it: with a target, the sum over the faces, for those that do not go without.
  System system(const SolverEntry& of) const {
    return {K, *R, e, &walks, of.needs == SolverEntry::Needs::target ? ones : std::span<const double>()};
  }

  FullOperator K;
  MatrixSampler walks;
  ColumnMatrix rho, e;
  std::optional<Reflection> R;
  std::vector<double> ones = std::vector<double>(6, 1);
};

/// Of its faces.
constexpr double radiosity[6] = {.23341309, .44955035, .55167738, .65020044, 1.62215579, 2.56095830};

}  // namespace interflect::solvers
