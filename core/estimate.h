#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/spectrum.h"

namespace interflect {

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
  Spectrum error_bound{std::numeric_limits<double>::infinity()};  ///< |bias|: discretisation, quadrature, solver; never a silent 0
  Claim claim = Claim::none;  ///< what `error_bound` is worth
  std::uint64_t samples = 0;  ///< independent samples behind `standard_error`
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
  return e;
}

}  // namespace interflect
