#pragma once

#include <array>
#include <cmath>

#ifndef INTERFLECT_SPECTRUM_CAPACITY
#define INTERFLECT_SPECTRUM_CAPACITY 4
#endif

namespace interflect {

/// One number per channel (a band of wavelengths, or a colour channel), in the unit of what it describes.
///
/// The capacity is a constant of the build, so that a spectrum is a plain value without a heap; a scene says how many
/// channels it uses (`Scene::channel_count()`), and the rest stay 0.  Arithmetic is channel by channel over the
/// capacity.
class Spectrum {
 public:
  static constexpr int capacity = INTERFLECT_SPECTRUM_CAPACITY;
  static_assert(capacity >= 1 && capacity <= 16);

  constexpr Spectrum() = default;
  constexpr explicit Spectrum(double all) { values_.fill(all); }
  static constexpr Spectrum zero() { return Spectrum(); }

  constexpr double operator[](int channel) const { return values_[static_cast<std::size_t>(channel)]; }
  constexpr double& operator[](int channel) { return values_[static_cast<std::size_t>(channel)]; }
  constexpr const double* data() const { return values_.data(); }
  constexpr double* data() { return values_.data(); }

  constexpr Spectrum& operator+=(const Spectrum& o) {
    return each(o, [](double a, double b) { return a + b; });
  }
  constexpr Spectrum& operator-=(const Spectrum& o) {
    return each(o, [](double a, double b) { return a - b; });
  }
  constexpr Spectrum& operator*=(const Spectrum& o) {
    return each(o, [](double a, double b) { return a * b; });
  }
  constexpr Spectrum& operator*=(double s) { return *this *= Spectrum(s); }
  constexpr Spectrum& operator/=(double s) { return *this *= Spectrum(1.0 / s); }

  friend constexpr Spectrum operator+(Spectrum a, const Spectrum& b) { return a += b; }
  friend constexpr Spectrum operator-(Spectrum a, const Spectrum& b) { return a -= b; }
  friend constexpr Spectrum operator*(Spectrum a, const Spectrum& b) { return a *= b; }
  friend constexpr Spectrum operator*(Spectrum a, double s) { return a *= s; }
  friend constexpr Spectrum operator*(double s, Spectrum a) { return a *= s; }
  friend constexpr Spectrum operator/(Spectrum a, double s) { return a /= s; }
  friend constexpr bool operator==(const Spectrum&, const Spectrum&) = default;

  /// The largest channel; 0 for an all-dark spectrum of non-negative values.
  constexpr double max() const {
    double largest = values_[0];
    for (double v : values_) largest = v > largest ? v : largest;
    return largest;
  }
  constexpr bool is_zero() const { return *this == Spectrum(); }
  bool is_finite() const {
    for (double v : values_)
      if (!std::isfinite(v)) return false;
    return true;
  }
  /// Channel by channel f(value).
  template <class F>
  constexpr Spectrum map(F f) const {
    Spectrum out;
    for (int c = 0; c < capacity; ++c) out[c] = f((*this)[c]);
    return out;
  }

 private:
  template <class F>
  constexpr Spectrum& each(const Spectrum& o, F f) {
    for (int c = 0; c < capacity; ++c) (*this)[c] = f((*this)[c], o[c]);
    return *this;
  }

  std::array<double, capacity> values_{};
};

/// Channel by channel; a NaN stays one, in `max` on either side.
inline Spectrum sqrt(const Spectrum& s) {
  return s.map([](double v) { return std::sqrt(v); });
}
inline Spectrum abs(const Spectrum& s) {
  return s.map([](double v) { return std::abs(v); });
}
inline Spectrum max(Spectrum a, const Spectrum& b) {
  for (int c = 0; c < Spectrum::capacity; ++c) a[c] = a[c] >= b[c] || std::isnan(a[c]) ? a[c] : b[c];
  return a;
}

}  // namespace interflect
