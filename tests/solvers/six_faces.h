#pragma once

#include "solvers/transition_sampler.h"
#include "tests/solvers/random_systems.h"

namespace interflect::solvers {

/// Draws from the rows of a full matrix.
class MatrixSampler final : public TransitionSampler {
 public:
  explicit MatrixSampler(const FullOperator& K) : K_(K) {}
  int dimensions() const override { return 1; }
  std::optional<Index> from_element(Index i, std::span<const double> u) const override {
    double left = u[0] * K_.gram()[static_cast<std::size_t>(i)];
    for (Index j = 0; j < K_.matrix().cols(); ++j)
      if ((left -= K_.matrix()(i, j)) < 0) return j;
    return std::nullopt;
  }

 private:
  const FullOperator& K_;
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

  FullOperator K;
  MatrixSampler walks;
  ColumnMatrix rho, e;
  std::optional<Reflection> R;
};

/// Of its faces.
constexpr double radiosity[6] = {.23341309, .44955035, .55167738, .65020044, 1.62215579, 2.56095830};

}  // namespace interflect::solvers
