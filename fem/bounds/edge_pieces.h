#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fem/bounds/facet_cells.h"

namespace interflect::fem {

/// The edges of cells, cut at all corners that lie on them, so that pieces of two edges are the same or have no more
/// than an end in common, however differently their facets were cut.
struct EdgePieces {
  std::vector<std::vector<std::uint32_t>> of;  ///< by cell, ascending; those that a cell runs along twice are left out
  std::uint32_t count = 0;
};

/// @param tolerance  corners as near to each other are one; as near to an edge, they lie on it
EdgePieces edge_pieces(std::span<const FacetCell> cells, double tolerance);

}  // namespace interflect::fem
