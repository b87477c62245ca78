#pragma once

namespace interflect::montecarlo {

/// Russian roulette: how likely a path goes on that carries this part of what it set out with.  Never for sure, since
/// what loses nothing, as light in a block of glass, would not end; nor does what is no number go on.
inline double going_on(double part) { return part < 0.999 ? part : part >= 0.999 ? 0.999 : 0; }

}  // namespace interflect::montecarlo
