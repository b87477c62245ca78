#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mesh/element_mesh.h"
#include "scene/geometry_file.h"

namespace interflect::mesh {

/// The elements of an exchange of radiation.
///
/// First those that see what is in front of them, in the order of the scene; then, for each piece of a mask, the part
/// of its base that it covers and the piece itself: congruent, face to face, without a distance, so that K of the two
/// is their area and both see nothing else.  Bases keep their area and their rows their sums, however masks and bases
/// are cut, and no element is of mixed fate.
struct ExchangeElements {
  std::vector<scene::SurfacePatch> patches;  ///< of a mask's piece, the surface is its base
  std::vector<std::uint32_t> mask;           ///< of patches[open + 2 k] and patches[open + 2 k + 1], by k
  std::size_t open = 0;                      ///< how many see what is in front of them
  std::size_t masks_left_out = 0;            ///< whose bases have no view factors

  std::span<const scene::SurfacePatch> seeing() const { return std::span(patches).first(open); }
  /// The mask that an element is a piece of; none of what masks cover, and of all others.
  const scene::ExchangeMask* mask_at(std::size_t element, const scene::ExchangeScene& geometry) const {
    return element >= open && (element - open) % 2 == 1 ? &geometry.masks[mask[(element - open) / 2]] : nullptr;
  }
};

/// @param cut  a scene into elements: that of the surfaces, and that of the masks
ExchangeElements exchange_elements(const scene::ExchangeScene& geometry,
                                   const std::function<ElementMesh(const scene::Scene&)>& cut);

}  // namespace interflect::mesh
