#include "montecarlo/bsdf/cosine_table.h"

#include <algorithm>
#include <cmath>

namespace interflect::montecarlo {

CosineTable::CosineTable(const std::function<double(double cosine)>& function) {
  for (int k = 0; k <= intervals; ++k) {
    const double x = std::max(1e-3, static_cast<double>(k) / intervals);  // what grazes has no limit by formula
    at_[static_cast<std::size_t>(k)] = function(x * x);
  }
  constexpr int n = 4096;  // Simpson's rule in x = sqrt(c)
  double sum = 0;
  for (int k = 0; k <= n; ++k) {
    const double x = static_cast<double>(k) / n, weight = k == 0 || k == n ? 1 : k % 2 == 1 ? 4 : 2;
    sum += weight * 4 * x * x * x * (*this)(x * x);
  }
  mean_ = sum / (3 * n);
}

/// Slopes at nodes are those between their neighbours [Catmull, Rom 1974].
double CosineTable::operator()(double cosine) const {
  const double place = intervals * std::sqrt(std::clamp(cosine, 0.0, 1.0));
  const int k = std::min(static_cast<int>(place), intervals - 1);
  const auto at = [&](int node) { return at_[static_cast<std::size_t>(std::clamp(node, 0, intervals))]; };
  const double t = place - k, from = at(k), to = at(k + 1), leaving = 0.5 * (to - at(k - 1)),
               arriving = 0.5 * (at(k + 2) - from);
  return from +
         t * (leaving + t * (3 * (to - from) - 2 * leaving - arriving + t * (2 * (from - to) + leaving + arriving)));
}

}  // namespace interflect::montecarlo
