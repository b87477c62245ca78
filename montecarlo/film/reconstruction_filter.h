#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/vec.h"

namespace interflect::montecarlo {

/// How much a point of the film counts for a pixel: h(offset from the pixel's middle), in pixels, int h = 1.
///
///   pixel = int h(u) L(u) du
///
/// Points are drawn for each pixel by itself: unbiased, and pixels stay independent of each other, so that a standard
/// error is what it says [Ernst, Stamminger, Greiner 2006].  Where h has negative lobes, h = h+ - h-, a sample is two
/// points, of which one counts int h+ and the other -int h-: an even radiance is shown without noise by any filter.
/// (One point, of |h|, with the sign of h would be the usual way: an error of 14 % of which a pixel that happens to have
/// no negative point knows nothing.)  Light that finds the film by itself (splats) counts h of all pixels within reach.
/// Test: tests/montecarlo/filters.cpp
class ReconstructionFilter {
 public:
  virtual ~ReconstructionFilter() = default;
  virtual double value(const Vec2& offset) const = 0;  ///< h [1/pixel²]
  virtual double reach() const = 0;                    ///< h is 0 beyond, along each axis [pixels]
  virtual double negative() const { return 0; }        ///< int h-; int h+ is 1 more

  /// With the density h+ / int h+.
  /// @param u, v  in [0, 1)
  virtual Vec2 sample(double u, double v) const = 0;
  /// With the density h- / int h-.  @pre  negative() > 0
  virtual Vec2 sample_negative(double u, double v) const;
  /// (u, v) of an offset that `sample` draws, and of one that `sample_negative` does, for tests.  Round trip: 1e-12.
  virtual Vec2 inverse(const Vec2& offset) const = 0;
  virtual Vec2 inverse_negative(const Vec2& offset) const;
};

/// One that is known by name.
struct FilterEntry {
  std::string name, summary;
  std::unique_ptr<ReconstructionFilter> (*make)();
};
const std::vector<FilterEntry>& known_filters();
std::vector<std::string> filter_names();
/// @throws core::InputError  with the names known
std::unique_ptr<ReconstructionFilter> make_filter(const std::string& name);
/// The one of pixels that are measured: each its own square.
const ReconstructionFilter& box_filter();

}  // namespace interflect::montecarlo
