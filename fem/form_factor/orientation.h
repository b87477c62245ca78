#pragma once

#include "fem/form_factor/element_shapes.h"

namespace interflect::fem {

/// Is the pair dark by orientation: one element lies behind the other's plane, or in it, up to rounding?
bool facing_away(const ElementShapes& shapes, Index i, Index j);

}  // namespace interflect::fem
