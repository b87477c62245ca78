#pragma once

#include <span>
#include <string>
#include <vector>

namespace interflect::visual {

/// What a legend spans.
struct Range {
  double low = 0, high = 1;
  bool logarithmic = false;         ///< then low > 0, and values below it count as low
  double part(double value) const;  ///< 0 .. 1 inside
};

/// The smallest of 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10 times a power of ten that is not below x; 1 for x <= 0.
double round_up(double x);

/// 0 to the 99th percentile by area, rounded up; for `diverging` maps the same of |values|, both ways.
Range range_of(std::span<const double> values, std::span<const double> areas, bool diverging);

/// The logarithmic range from low to high, both above 0, rounded outwards to 1, 2 or 5 times a power of ten.
Range rounded_outwards(double low, double high);

/// For what differs by orders of magnitude: from the 1st to the 99th percentile by weight of what is above 0, rounded
/// outwards; four decades at most.
Range logarithmic_range(std::span<const double> values, std::span<const double> weights);

/// Of a logarithmic range: all 1, 2 and 5 times powers of ten in it, or the powers alone where that would be too many.
/// Else four to thirteen round numbers inside the range, ascending; its ends among them where that can be.
std::vector<double> ticks_of(const Range& range);

/// "0", "250", "12 000", "0.05", "2e-07": as many digits as the step between ticks needs.
std::string tick_label(double value, double step);

}  // namespace interflect::visual
