#pragma once

#include <functional>
#include <span>
#include <string>

#include "validation/judged.h"

namespace interflect::validation {

/// A number and where it lies with 95 % confidence.
struct Interval {
  double value = 0, low = 0, high = 0;
};

/// Area-weighted relative norms of FEM's error in irradiance, corrected for the noise of the reference.
///
/// FEM's numbers are taken as delivered: what their own noise (sampled visibility) has done to them is part of their
/// error, and is not taken out.  With d_j = FEM_j - MC_j, se_j the standard error of MC_j alone, a_j the area that j
/// stands for, H_j the truth:
///
///   L2²  = sum_j a_j (d_j² - se_j²) / sum_j a_j (MC_j² - se_j²)
///   L1   = sum_j a_j |d_j| / sum_j a_j |MC_j|  sqrt( sum a (d² - se²) / sum a d² )
///   max  = max_j |d_j| / (sum_j a_j |MC_j| / sum_j a_j)
///   bias = sum_j a_j d_j / sum_j a_j |MC_j|
///
/// L2² is unbiased above and below, since E[d²] = (FEM - H)² + se² over the reference's noise.  The maximum is of the
/// judged measurements alone, noise included.  The bias is signed and no error bound enters it: it sees a loss that is
/// small everywhere and that bounds would explain.
///
/// Intervals: L2 by the delta method, Var(d²) = 4 (FEM - H)² se² + 2 se⁴, estimated without bias by 4 d² se² - 2 se⁴.
/// No estimator of L1 is unbiased (|x| has a kink): its factor is right where errors are normally distributed, and its
/// interval is safe, from sum a (|d| - se sqrt(2/pi)) to sum a |d|, each 1.96 standard errors further out.  max: the
/// largest of simultaneous intervals (Sidak).  bias: 1.96 sqrt(sum a² se²) to either side.  Where elements were chosen,
/// the variance of the choice inside each group is added, (1 - f) n / (n - 1) sum a² (y - mean y)² less its part of
/// noise; groups with one chosen element are taken together.  The noise of the denominators is neglected: it changes an
/// interval by a part (relative error of the norm) of itself.
///
/// Where only an upper bound of se is known (Noise::exact), it widens intervals and lowers their lower ends, but
/// nothing is subtracted from values: they are then too large by the reference's noise at most.
struct Norms {
  std::size_t measurements = 0;
  double area = 0;             ///< represented [m²]
  double mean_irradiance = 0;  ///< of the reference [W/m² | lx]
  Interval l1, l2, max;        ///< relative: 0.01 is 1 %
  Interval bias;               ///< signed: negative where FEM is too dark
  std::string worst;           ///< where the maximum is
  double reference_error = 0;  ///< the reference's own error in the norm L2: not more with probability 95 %
  double claimed_error = 0;    ///< FEM's error bounds in the norm L2
};

/// Over the measurements that `counts` and whose numbers are finite.  Without any light the relative norms are 0 where
/// both methods agree on it, else infinite.
Norms error_norms(std::span<const Judged> judged, const Reading& reading,
                  const std::function<bool(const Judged&)>& counts);

}  // namespace interflect::validation
