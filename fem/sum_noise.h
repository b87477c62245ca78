#pragma once

#include <algorithm>
#include <cmath>

#include "fem/radiosity.h"

namespace interflect::fem {

/// Standard error of sum_i w_i H_i, weights not negative, of elements' irradiance with noise that is partly each one's
/// own and partly one deviation of all (RadiositySolution::shared_noise):
///
///   own² = sum_i w_i² own_i²,   shared = sum_i w_i shared_i
class SumNoise {
 public:
  explicit SumNoise(const RadiositySolution& of) : of_(of) {}

  void add(std::size_t element, const Spectrum& weight) {
    own_ += weight * weight * of_.own_variance(element);
    shared_ += weight * of_.shared_noise;
  }

  /// @param beside  standard error of what goes with the element's own, however it does
  void add(std::size_t element, const Spectrum& weight, const Spectrum& beside) {
    const Spectrum own = weight * root(of_.own_variance(element)) + beside;
    own_ += own * own;
    shared_ += weight * of_.shared_noise;
  }

  /// Of elements that do not see each other: what is their own is independent.
  Spectrum apart() const { return root(own_ + shared_ * shared_); }

  /// Of elements that may: K_ij = K_ji is one random number that two have, which doubles the variance at most, since
  /// (a + b)² <= 2 a² + 2 b²; and later bounces see the same numbers once more, so that what is shared goes with them.
  Spectrum together() const { return shared_ + root(2 * own_); }

 private:
  static Spectrum root(const Spectrum& variance) {
    return variance.map([](double v) { return std::sqrt(std::max(0.0, v)); });
  }

  const RadiositySolution& of_;
  Spectrum own_, shared_;
};

}  // namespace interflect::fem
