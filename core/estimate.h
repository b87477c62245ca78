#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/spectrum.h"

namespace interflect {

/// Standard errors in half of a 95 % interval of the normal distribution: Phi^-1(0.975).
inline constexpr double normal_95 = 1.959963984540054;

/// What an error bound is worth.
enum class Claim : std::uint8_t {
  none,       ///< nothing is known: the bound is infinite
  estimated,  ///< a computed estimate of the error, right in almost all cases and proved in none
  guaranteed  ///< a proved bound, up to rounding
};

/// One answer to one question, per channel, in the unit of its measurement.
struct Estimate {
  Spectrum value;
  Spectrum standard_error;  ///< of sampling noise alone; 0 where nothing was sampled
  Spectrum error_bound{
      std::numeric_limits<double>::infinity()};  ///< |bias|: discretisation, quadrature, solver; never a silent 0
  Claim claim = Claim::none;                     ///< what `error_bound` is worth
  std::uint64_t samples = 0;                     ///< independent samples behind `standard_error`
  /// Of the scene's weighted value sum_c weights[c] value[c], which the channels' own do not tell: their noise may be
  /// correlated.  NaN where it was not measured; sum_c weights[c] standard_error[c] is then an upper bound.
  double weighed_standard_error = std::numeric_limits<double>::quiet_NaN();
};

/// The estimate of an unbiased method: no error but its noise.
inline Estimate unbiased_estimate(const Spectrum& value, const Spectrum& standard_error, std::uint64_t samples) {
  return {value, standard_error, Spectrum::zero(), Claim::guaranteed, samples};
}

/// The estimate of `factor` times the quantity.
inline Estimate scaled(Estimate e, double factor) {
  e.value *= factor;
  e.standard_error *= std::abs(factor);
  e.error_bound *= std::abs(factor);
  e.weighed_standard_error *= std::abs(factor);
  return e;
}

}  // namespace interflect
