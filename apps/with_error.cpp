#include "apps/with_error.h"

#include <cmath>

#include "core/format.h"

namespace interflect::apps {

std::string with_error(double value, double error) {
  constexpr int digits = 2;
  const double told = core::rounded_up(error, digits);
  const double place = std::floor(std::log10(told)) - digits + 1;  // not a number, or infinite, as the error is
  if (!std::isfinite(value) || !(std::abs(place) < 7)) return core::format("%.6g +- %.2g", value, told);
  const double unit = std::pow(10.0, place);
  const double shown = std::round(value / unit) * unit + 0.0;  // not -0
  const int decimals = place < 0 ? static_cast<int>(-place) : 0;
  return core::format("%.*f +- %.*f", decimals, shown, decimals,
                      core::rounded_up(error + std::abs(shown - value), digits));
}

}  // namespace interflect::apps
