#pragma once

#include <span>
#include <string>
#include <vector>

namespace interflect::visual {

/// What a legend spans.
struct Range {
  double low = 0, high = 1;
  double part(double value) const { return (value - low) / (high - low); }  ///< 0 .. 1 inside
};

/// The smallest of 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10 times a power of ten that is not below x; 1 for x <= 0.
double round_up(double x);

/// 0 to the 99th percentile by area, rounded up; for `diverging` maps the same of |values|, both ways.
Range range_of(std::span<const double> values, std::span<const double> areas, bool diverging);

/// Four to thirteen round numbers inside the range, ascending; its ends among them where that can be.
std::vector<double> ticks_of(const Range& range);

/// "0", "250", "12 000", "0.05", "2e-07": as many digits as the step between ticks needs.
std::string tick_label(double value, double step);

}  // namespace interflect::visual
