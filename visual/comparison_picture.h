#pragma once

#include <array>
#include <string>

#include "core/image.h"
#include "results/comparison_panels.h"

namespace interflect::visual {

/// Three panels beside each other with words over them, and a legend of the differences.  It needs no display.
/// @param titles      of the panels' fem, traced and difference
/// @param full_scale  as the panels were made with
core::Image comparison_picture(const results::ComparisonPanels& panels, const std::array<std::string, 3>& titles,
                               double full_scale);

}  // namespace interflect::visual
