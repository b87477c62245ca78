#pragma once

#include <cstdint>

#include "core/image.h"
#include "results/comparison_panels.h"

namespace interflect::visual {

/// Three panels beside each other with words over them, and a legend of the differences.  It needs no display.
/// @param samples     per pixel of the traced panel
/// @param full_scale  as the panels were made with
core::Image comparison_picture(const results::ComparisonPanels& panels, std::uint64_t samples, double full_scale);

}  // namespace interflect::visual
