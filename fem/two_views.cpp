#include "fem/two_views.h"

#include <algorithm>
#include <cmath>

namespace interflect::fem {

TwoViews::TwoViews(Index elements)
    : elements_(elements),
      views_(static_cast<std::size_t>(elements * elements)),
      weights_(static_cast<std::size_t>(elements), 0.0) {}

void TwoViews::add(Index a, Index b, const ExchangeEntry& entry) {
  views_[static_cast<std::size_t>(a * elements_ + b)] = {
      static_cast<float>(entry.K), static_cast<float>(entry.standard_error), static_cast<float>(entry.bound)};
}

ExchangeEntry TwoViews::joined(Index a, Index b) const {
  if (a > b) std::swap(a, b);
  const View &x = view(a, b), &y = view(b, a);
  if (a == b) return {x.K, x.standard_error, x.bound};
  const auto square = [](const View& v) {
    return double{v.standard_error} * v.standard_error + double{v.bound} * v.bound;
  };
  const double of_x = square(x), of_y = square(y), sum = of_x + of_y;
  const double weight_x = weights_[static_cast<std::size_t>(a)], weight_y = weights_[static_cast<std::size_t>(b)];
  const double by_errors = sum > 0 ? of_y / sum : 0.5;
  const double w = weight_x > 0 && weight_y > 0 ? weight_x / (weight_x + weight_y) : by_errors, u = 1 - w;
  ExchangeEntry entry{w * x.K + u * y.K, std::hypot(w * x.standard_error, u * y.standard_error),
                      w * x.bound + u * y.bound};
  if (entry.standard_error == 0) entry.bound = std::max(entry.bound, 0.5 * std::abs(double{x.K} - y.K));
  return entry;
}

}  // namespace interflect::fem
