#pragma once

#include <span>
#include <string>
#include <vector>

#include "fem/environment_column.h"
#include "fem/operator/symmetric_operator.h"

namespace interflect::fem {

struct ClosureSettings {
  std::string method = "scaling";  ///< or "least-squares"
  double tolerance = 1e-13;        ///< on max_a |sum_b F_ab + F_a,env - 1| afterwards
  /// Of a closed scene: refused where |sum_b F_ab - 1| is larger before: that is an opening, not an error.
  double largest_row_error = 0.2;
  double largest_correction = 0.1;  ///< refused where ||K' - K|| / ||K|| would be larger, by more than what was dropped
  int max_iterations = 50;          ///< of Newton's method
  std::span<const double> row_bound = {};          ///< sum_b bound_ab / A_a of what was not sampled; empty: not known
  const EnvironmentColumn* environment = nullptr;  ///< of an open scene
};

struct ClosureReport {
  double correction = 0;                             ///< ||K' - K|| / ||K||, Frobenius
  double row_error_before = 0, row_error_after = 0;  ///< max_a |sum_b F_ab + F_a,env - 1|
  int iterations = 0;                                ///< Newton steps
  bool converged = false;
  std::vector<double> environment;  ///< F_a,env afterwards; empty in a closed scene
};

/// "scaling", "least-squares".
std::vector<std::string> closure_names();

/// Makes the row sums of K right and keeps it symmetric, by the smallest change in one of two measures:
///
///   scaling        K'_ab = s_a K_ab s_b, the nearest in relative entropy,
///                  min 1/2 sum_ab K'_ab log(K'_ab / K_ab) - K'_ab + K_ab
///   least-squares  min 1/4 sum_ab (K'_ab - K_ab)² / w_ab,   0 <= K'_ab <= min(A_a, A_b),   K'_ab = 0 where K_ab is
///
/// subject to  sum_b K'_ab + z_a = A_a.  In a closed scene z = 0.  In an open one z_a = A_a F_a,env is what the
/// environment takes, a variable too, which was found independently to be Z_a with the variance v_a: the measure has
/// 1/2 sum_a (z_a - Z_a)² / v_a more (scaling: kappa times that), and 0 <= z_a <= A_a.  w_ab are the variances of
/// entries (closure_law.h): least squares with these weights is the most probable matrix where errors are independent
/// and normal, and it moves what is uncertain.
///
/// Conditions of a minimum [Karush 1939; Kuhn, Tucker 1951], necessary and sufficient since all is convex: rows add up
/// to A, and there are multipliers l, one an element, such that for every pair
///
///   g_ab = (K'_ab - K_ab) / w_ab - l_a - l_b   is  0  where 0 < K'_ab < min(A_a, A_b),
///                                                >= 0  where K'_ab = 0,   <= 0  where K'_ab = min(A_a, A_b)
///
/// and the same for z_a with g_a = (z_a - Z_a) / v_a - l_a.  So K'_ab is K_ab + w_ab (l_a + l_b), clamped: N numbers
/// tell the whole matrix.  Of scaling the condition is log(K'_ab / K_ab) = u_a + u_b.
///
/// Both are found as the minimum of the convex dual function of u (u = kappa l), whose gradient is what rows are off
/// by, with Newton's method; it is semismooth where clamps are (an entry at a bound has the slope 0) [Qi, Sun 1993].
/// Its steps are by conjugate gradients with the operator alone [scaling: after Knight, Ruiz 2013; least squares
/// without the bounds: Larsen, Howell 1986; van Leersum 1989].
///
/// Where an operator dropped entries, the environment is found first with what they are known to bring in their rows;
/// then, fixed, K is repaired to the rows without them: what was dropped is given to other entries, not to the
/// environment.
///
/// Scaling keeps positive entries positive; least squares may set one to 0.  To first order they differ by the weights
/// alone: scaling's are w_ab = K_ab.  Neither removes errors that rows do not show.
///
/// Of a closed scene whoever calls vouches for that; of an open one the environment's column must be there.  K stays as
/// it was where this throws.
/// @throws core::InputError  in a sentence: a row of a closed scene, or the correction, beyond the limits of
///                           `settings`; a row of an open one that is off by more than its errors explain (its bounds
///                           and eight
///                           standard deviations); no matrix with these row sums
/// Test: tests/fem/closure.cpp, closure_least_squares.cpp, environment_column.cpp
ClosureReport restore_closure(SymmetricOperator& K, Run& run, const ClosureSettings& settings = {});

}  // namespace interflect::fem
