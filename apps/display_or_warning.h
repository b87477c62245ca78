#pragma once

#include <memory>

#include "visual/display.h"

namespace interflect::apps {

/// Null, with a warning, where no display can be had: a machine without one is no reason to lose what was computed.
std::unique_ptr<visual::Display> display_or_warning();

}  // namespace interflect::apps
