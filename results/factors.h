#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/vec.h"
#include "scene/scene.h"

/// View factors as files know them: what is written of the elements, rows of the matrix, and which geometry they belong
/// to.
namespace interflect::results {

/// The elements between which view factors are; all lists have the same length, the last three unless empty.
struct FactorElements {
  std::vector<double> area;            ///< [m²]
  std::vector<Vec3> normal, centroid;  ///< unit; [m]
  std::vector<std::string> name;       ///< of the side of the surface: "NAME", "NAME/back"
  /// F_i,env, what reaches no element, and its errors [1]; empty: not known.
  std::vector<double> environment, environment_error;
  /// sum_j |F'_ij - F_ij|, what a repair of row sums changed, which errors have grown by [1]; empty: none was made.
  std::vector<double> closure_change;

  Index size() const { return static_cast<Index>(area.size()); }
};

/// @param patches  whose surfaces are the scene's
FactorElements factor_elements(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches);

/// Row i of F_ij = K_ij / A_i and of the errors of its entries [1].  Cheap where rows are asked for in ascending order.
using FactorRows = std::function<void(Index i, std::span<double> F, std::span<double> error)>;

/// 32 hexadecimal digits that stand for the shape of the scene's facets and of the elements: the same for the same
/// coordinates, sides and order, bit by bit, and for practical purposes for no others.  Materials, names and lights do
/// not count.  It guards against mistakes, not against malice.
std::string geometry_digest(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches);

}  // namespace interflect::results
