#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace interflect::fem {

/// How b = e + rho T b becomes as many equations as there are unknowns.
enum class Projection : std::uint8_t {
  galerkin,      ///< in the mean, against every polynomial of every element
  continuous,    ///< likewise, of functions that are continuous over each side of a surface, linear between corners
  gauss_points,  ///< at Gauss points of elements (collocation)
  vertices,      ///< at corners, of the same functions as `continuous` (collocation)
  centroids      ///< at the middles of elements' corners, of constants (collocation)
};

/// "galerkin", "continuous", "gauss-points", "vertices", "centroids".
std::vector<std::string> projection_names();
std::string name_of(Projection projection);
/// @throws core::InputError  with the names known
Projection projection_named(const std::string& name);

/// Whether unknowns are values at corners.
bool at_corners(Projection projection);

}  // namespace interflect::fem
