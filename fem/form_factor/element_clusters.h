#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fem/form_factor/element_shapes.h"
#include "scene/place.h"

namespace interflect::fem {

/// Elements of one side of one surface that lie close together, so that one proof of visibility may serve all their
/// pairs.
struct ElementCluster {
  std::vector<Index> elements;  ///< ascending
  /// That holds them, where they lie in one plane; relative to the shapes' origin.
  std::optional<std::array<Vec3, 4>> rectangle;
};

/// All elements in compact clusters of at most `largest`: by (surface, side), then by plane where eight or more share
/// one, then split at the median of the centroids along the longer side of their box.  A function of the elements
/// alone.
std::vector<ElementCluster> clusters_of(std::span<const scene::SurfacePatch> patches, const ElementShapes& shapes,
                                        std::size_t largest = 32);

}  // namespace interflect::fem
