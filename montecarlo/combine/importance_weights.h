#pragma once

#include <Eigen/Core>
#include <span>

#include "core/ordered_sum.h"
#include "core/vec.h"

/// Several techniques draw samples of one integral int f [Veach, Guibas 1995]: what each sample counts.
namespace interflect::montecarlo {

enum class Heuristic { balance, power };

/// Of a sample x that a technique drew, where technique k has the pdf p_k and n_k samples:
///
///   balance   w_i = n_i p_i / sum_k n_k p_k
///   power     w_i = (n_i p_i)² / sum_k (n_k p_k)²
///
/// sum_i w_i = 1 where any p is not 0, and w_i = 0 where p_i is.  Neither is always the better one: the power heuristic
/// has 30 times the variance for e^x by 1 and 2x.
/// @return  0 where all p are 0
double importance_weight(Heuristic heuristic, std::span<const double> n, std::span<const double> p, std::size_t i);

/// The weights of least variance [Kondapaneni et al. 2019]: balance, and a control variate of the pdfs themselves,
///
///   <F> = sum_k alpha_k + sum over samples (f - sum_k alpha_k p_k) / q,     q = sum_k n_k p_k
///   A alpha = b,   A_ik = int p_i p_k / q,   b_i = int f p_i / q
///
/// A and b by a pilot whose samples are not used again: with the same ones the estimate would be biased.  Weights may
/// be negative.  Exact where f is a sum of the pdfs.
class OptimalWeights {
 public:
  explicit OptimalWeights(std::span<const double> n);

  /// A sample of the pilot, of any technique: of technique k in proportion to n_k.
  /// @param times  that it counts
  void learn(double f, std::span<const double> p, double times = 1);
  /// Once it has learnt enough.  Where A is singular, of all alpha the smallest.
  void solve();

  const Eigen::VectorXd& alpha() const { return alpha_; }
  double constant() const { return core::ordered_sum(alpha_); }
  /// What a sample adds to `constant`.
  double score(double f, std::span<const double> p) const;

 private:
  double mixture(std::span<const double> p) const;

  Eigen::VectorXd n_, b_, alpha_;
  Eigen::MatrixXd A_;
};

}  // namespace interflect::montecarlo
