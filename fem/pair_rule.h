#pragma once

#include <functional>
#include <vector>

#include "fem/space/space.h"

namespace interflect::fem {

/// A place on either of two panels, and its weight, Jacobians not included.
struct PairNode {
  double u_a, v_a, u_b, v_b;
  double weight;
};

/// How integrals over pairs of panels are done:
///
///   int_a int_b f = sum_k weight_k J_a J_b f(x_k, y_k)
class PairRule {
 public:
  virtual ~PairRule() = default;
  using Visit = std::function<void(const PairNode&)>;
  /// Node by node, since there may be millions.
  virtual void for_nodes(const Panel& a, const Panel& b, const Visit& visit) const = 0;
};

/// Products of Gauss rules of so many points a side: for panels that are farther apart than they are long.
class ProductPairRule final : public PairRule {
 public:
  explicit ProductPairRule(int points);
  void for_nodes(const Panel& a, const Panel& b, const Visit& visit) const override;

 private:
  std::vector<PairNode> segments_;
};

/// Of segments: where two share an end, the kernel is homogeneous of degree -1 in the distances s and t from it.  Over
/// the halves t <= s and s <= t of the square of both, with t = s e and s = t e, the Jacobian takes the singularity
/// away [Duffy 1982]: what is left is smooth, and Gauss rules converge exponentially.  Others: products.
class SegmentPairRule final : public PairRule {
 public:
  explicit SegmentPairRule(int points);
  void for_nodes(const Panel& a, const Panel& b, const Visit& visit) const override;

 private:
  ProductPairRule apart_;
  std::vector<PairNode> touching_;  ///< where both begin at the common end
};

}  // namespace interflect::fem
