#pragma once

#include "fem/operator/dense_symmetric.h"

namespace interflect::fem {

struct ClosureSettings {
  double tolerance = 1e-13;  ///< on max_a |sum_b F_ab - 1| afterwards
  double largest_row_error =
      0.2;  ///< refused where |sum_b F_ab - 1| is larger before: that is an opening, not an error
  double largest_correction = 0.1;  ///< refused where ||K' - K|| / ||K|| would be larger
  int max_iterations = 50;          ///< of Newton's method
};

struct ClosureReport {
  double correction = 0;                             ///< ||K' - K|| / ||K||, Frobenius
  double row_error_before = 0, row_error_after = 0;  ///< max_a |sum_b F_ab - 1|
  int iterations = 0;                                ///< Newton steps
  bool converged = false;
};

/// Makes the row sums of a closed scene's K right and keeps it symmetric: the symmetric matrix nearest to K in relative
/// entropy,
///
///   K'_ab = s_a K_ab s_b   with   sum_b K'_ab = A_a,   which minimises  sum_ab K'_ab log(K'_ab / K_ab) - K'_ab + K_ab.
///
/// To first order in the correction this is also the smallest relative change in least squares, K' = K (1 + u_a + u_b)
/// with s = exp(u), min sum (K' - K)² / K [Larsen, Howell 1986; van Leersum 1989].  Zeros stay zero, positive entries
/// positive. Newton's method on the convex function f(u) = 1/2 sum_ab K_ab exp(u_a + u_b) - sum_a A_a u_a, its steps by
/// conjugate gradients with the operator alone [after Knight, Ruiz 2013].
///
/// Only for closed scenes: whoever calls vouches for that.  K stays as it was where this throws.
/// @throws core::InputError  in a sentence, where the rows or the correction exceed the limits of `settings`, or where
/// no scaling
///                           of K has these row sums
/// Test: tests/fem/closure.cpp
ClosureReport restore_closure(DenseSymmetric& K, Run& run, const ClosureSettings& settings = {});

}  // namespace interflect::fem
