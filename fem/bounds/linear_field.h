#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "fem/bounds/cell_view.h"
#include "fem/radiosity.h"

namespace interflect::fem {

/// B_h as bounds are made about it, per channel: a solution's constants, or the linear parts of its polynomials.  The
/// black elements of an open scene come after the others, with 0.
class LinearField {
 public:
  LinearField(const Surroundings& around, const RadiositySolution& solution, Index channels);

  Index elements() const { return constant_.rows(); }
  Index channels() const { return constant_.cols(); }
  double largest() const { return largest_; }  ///< of |B_h| at corners

  /// On a part of an element, relative to the origin as cells are.
  struct OnPart {
    double mean, lower, upper;
    double deviation;  ///< root mean square about the mean, which is the mean of |B_h - mean| at least
  };
  OnPart on(Index element, std::span<const Vec3> ring, Index channel) const;
  double at(Index element, const Vec3& x, Index channel) const {
    return constant_(element, channel) +
           gradient_.block<3, 1>(3 * element, channel).dot(x - centre_[static_cast<std::size_t>(element)]);
  }
  Eigen::RowVectorXd at(Index element, const Vec3& x) const {
    return constant_.row(element) +
           (x - centre_[static_cast<std::size_t>(element)]).transpose() * gradient_.middleRows<3>(3 * element);
  }
  /// Along s and t of a part of the element [1/m].
  Eigen::Matrix<double, 2, Eigen::Dynamic> gradient(Index element, const Cell& part) const;

 private:
  std::vector<Vec3> centre_;
  solvers::ColumnMatrix constant_, gradient_;  ///< gradients in space: x, y, z an element
  bool linear_;
  double largest_;
};

}  // namespace interflect::fem
