#pragma once

#include "results/colour_map.h"
#include "visual/outlines.h"

/// Diagonal stripes in the grey of what has no value: told from every colour of a map, and from grey walls.
namespace interflect::visual::hatching {

inline constexpr results::Colour ground{228, 228, 228}, stripe{158, 158, 158};

/// Whether this place is on a stripe: a third of the plane is.
/// @param period  from stripe to stripe along a row, at least 3
inline bool on_stripe(int x, int y, int period) { return 3 * ((x + y) % period) < period; }

/// Faces of clear surfaces have even numbers, of opaque ones odd numbers.
inline std::uint32_t face_of(std::uint32_t number, bool clear) { return 2 * number + (clear ? 2 : 1); }
inline bool is_clear(std::uint32_t face) { return face % 2 == 0; }

/// Stripes over all samples of the faces 1 .. `faces`; over clear ones every third, and half as wide, since what is behind
/// is to be read.
/// @return  whether there are any
bool hatch(Samples& samples, std::uint32_t faces, int period);

}  // namespace interflect::visual::hatching
