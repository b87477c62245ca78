#include "core/moments.h"

#include <limits>

namespace interflect::core {

void Moments::add(const Spectrum& sample) {
  ++count_;
  const Spectrum before = sample - mean_;
  mean_ += before / static_cast<double>(count_);
  squares_ += before * (sample - mean_);
}

void Moments::merge(const Moments& other) {
  if (other.count_ == 0) return;
  const auto a = static_cast<double>(count_), b = static_cast<double>(other.count_);
  const Spectrum d = other.mean_ - mean_;
  count_ += other.count_;
  mean_ += d * (b / (a + b));
  squares_ += other.squares_ + d * d * (a * b / (a + b));
}

Spectrum Moments::variance() const {
  if (count_ < 2) return Spectrum(std::numeric_limits<double>::infinity());
  return squares_ / static_cast<double>(count_ - 1);
}

Spectrum Moments::standard_error() const {
  return variance().map([n = static_cast<double>(count_)](double v) { return std::sqrt(v / n); });
}

}  // namespace interflect::core
