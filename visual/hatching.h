#pragma once

#include "results/colour_map.h"
#include "visual/outlines.h"

/// Diagonal stripes in the grey of what has no value: told from every colour of a map, and from grey walls.
namespace interflect::visual::hatching {

inline constexpr results::Colour ground{228, 228, 228}, stripe{158, 158, 158};

/// Whether this place is on a stripe: a third of the plane is.
/// @param period  from stripe to stripe along a row, at least 3
inline bool on_stripe(int x, int y, int period) { return 3 * ((x + y) % period) < period; }

/// Stripes over all samples of the faces 1 .. `faces`.  Over clear bodies, whatever is behind them, stripes that fall
/// from the left to the right, a third as many and half as wide, since what is behind is to be read; twice as many
/// where two bodies stand one behind the other, three times as many where there are more.
/// @return  whether there are any
bool hatch(Samples& samples, std::uint32_t faces, int period);

}  // namespace interflect::visual::hatching
