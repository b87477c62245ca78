#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace interflect::validation {

/// An element picked to be judged, and the area that it stands for [m²].
struct ChosenElement {
  std::int64_t element;
  double represented_area;
};

/// A choice of elements, stratified by surface: in the order of the elements, every one once.
///
/// Each surface gets at least one where `count` allows, the rest in proportion to its area (largest remainders); inside
/// a surface every k-th element from a random start.  The chosen ones of a surface share its area in proportion to
/// their own, so that represented areas sum to the total.  With fewer elements than surfaces, surfaces are drawn in
/// proportion to their area.
///
/// @param areas       of the elements [m²]
/// @param surface_of  a number for each element's side of a surface: elements of equal numbers follow each other
/// @param count       how many; all elements if there are no more
std::vector<ChosenElement> choose_elements(std::span<const double> areas, std::span<const std::uint32_t> surface_of,
                                           std::size_t count, std::uint64_t seed);

}  // namespace interflect::validation
