#include "core/moments.h"

#include <cmath>
#include <limits>

namespace interflect::core {

template <class T>
void MomentsOf<T>::add(const T& sample) {
  ++count_;
  const T before = sample - mean_;
  mean_ += before / static_cast<double>(count_);
  squares_ += before * (sample - mean_);
}

template <class T>
void MomentsOf<T>::merge(const MomentsOf& other) {
  if (other.count_ == 0) return;
  const auto a = static_cast<double>(count_), b = static_cast<double>(other.count_);
  const T d = other.mean_ - mean_;
  count_ += other.count_;
  mean_ += d * (b / (a + b));
  squares_ += other.squares_ + d * d * (a * b / (a + b));
}

template <class T>
T MomentsOf<T>::variance() const {
  if (count_ < 2) return T(std::numeric_limits<double>::infinity());
  return squares_ / static_cast<double>(count_ - 1);
}

template <class T>
T MomentsOf<T>::standard_error() const {
  using std::sqrt;
  return sqrt(variance() / static_cast<double>(count_));
}

template class MomentsOf<Spectrum>;
template class MomentsOf<double>;

}  // namespace interflect::core
