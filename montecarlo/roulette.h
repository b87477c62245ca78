#pragma once

#include <algorithm>

namespace interflect::montecarlo {

/// Russian roulette: how likely a path goes on that carries this part of what it set out with.  Never for sure, since
/// what loses nothing, as light in a block of glass, would not end.
inline double going_on(double part) { return std::min(0.999, part); }

}  // namespace interflect::montecarlo
