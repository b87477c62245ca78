#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "validation/judged.h"

namespace interflect::validation {

/// FEM against the reference for one measurement and one reading.
struct Difference {
  double fem = 0, mc = 0;     ///< [W/m² | lx]
  double standard_error = 0;  ///< sqrt(SE_fem² + SE_mc²)
  double bound = 0;           ///< on the bias of both: FEM's error bound, and the reference's if it has one
  double z = 0;               ///< (FEM - MC) / SE: bias and noise together; 0 where both vanish
  double excess_z = 0;        ///< sign(FEM - MC) max(0, |FEM - MC| - bound) / SE: what the bound does not explain
  bool known = false;  ///< all of the above are finite: a measurement without a bound is not judged, and does not agree
  bool agrees = false;  ///< |FEM - MC| <= bound + 3 SE

  double difference() const { return fem - mc; }
};

/// Rounding of 1e-12 of the values is forgiven, so that two exact answers (SE = 0) may differ in their last bits.
Difference difference(const Judged& judged, const Reading& reading);

/// All measurements in one reading.
///
/// Under "every bias is within its bound", z less its bound is a standard normal number, or smaller: no |excess_z|
/// exceeds z_max but with probability alpha.  And the mean of z satisfies
///
///   | sum_j z_j | <= sum_j bound_j / SE_j + z_max sqrt( sum_j (SE_mc,j / SE_j)² + (sum_j SE_fem,j / SE_j)² ) :
///
/// the noise of the reference is independent between measurements; that of FEM (shared form factors) may be fully
/// correlated.  So the mean sees what no single z sees, a common loss beyond the bounds of z_max SE / sqrt(n); it
/// cannot see one that bounds would explain, however many measurements there are: that is told by Norms::bias.
struct Comparison {
  std::vector<Difference> differences;     ///< in the order of the measurements
  std::vector<std::size_t> disagreeing;    ///< not |FEM - MC| <= bound + 3 SE, the worst first
  std::vector<std::size_t> unknown;        ///< among them: without a finite bound or standard error
  std::vector<std::size_t> beyond_chance;  ///< |excess_z| > z_max, the worst first
  double share = 1;                        ///< that agrees, 0 .. 1
  double z_max = 0;
  double mean_z = 0;         ///< signed, over the measurements with SE > 0
  double mean_z_limit = 0;   ///< that |mean_z| may reach: bounds and chance
  double mean_z_square = 0;  ///< about 1 where noise is all there is; well below: standard errors are overestimated
  std::size_t noisy = 0;     ///< measurements with SE > 0

  bool drifts() const { return !(mean_z <= mean_z_limit && mean_z >= -mean_z_limit); }
};

/// @param z_max  see sidak_z_max
Comparison compare(std::span<const Judged> judged, const Reading& reading, double z_max);

}  // namespace interflect::validation
