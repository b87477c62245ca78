#pragma once

#include <cstdint>
#include <vector>

#include "fem/bounds/edge_pieces.h"

namespace interflect::fem {

/// A basis of the cells' cycles modulo 2: sets Z of cells without a boundary,
///
///   sum_{c in Z} dc = 0 mod 2,      every piece of an edge is in an even number of cells of Z.
///
/// A point whose rays cross Z an odd number of times cannot be reached from far away but through Z.  By Alexander
/// duality the parities about all cycles of a basis tell apart whatever the cells separate.
///
/// A cell with a piece of its own is in no cycle, nor is what depends on it; cells that share a piece with each other
/// alone are in the same ones, and become one sheet.  Between sheets there are equations at pieces that more than two
/// share, which are solved by elimination among sheets that they join: up to 4096, beyond which none of them is taken
/// to be in a cycle.
/// @return  by cell, the numbers of the cycles that it is in, ascending
std::vector<std::vector<std::uint32_t>> surface_cycles(const EdgePieces& pieces);

}  // namespace interflect::fem
