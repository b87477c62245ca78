#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/spectrum.h"
#include "fem/space/node_set.h"
#include "scene/scene.h"
#include "solvers/transport_operator.h"

namespace interflect::fem {

/// @throws core::InputError  which surface is not diffuse
void require_diffuse(const scene::Scene& scene);

/// Elements are made of diffuse sides; light may also go by way of smooth surfaces (specular/specular_chains.h).
/// @param rough_is_black  surfaces that scatter light otherwise absorb it; else they are refused
/// @throws core::InputError  which surface is none of these
void require_diffuse_or_smooth(const scene::Scene& scene, bool rough_is_black);

/// What elements emit and reflect.  @pre  they are of diffuse materials
struct ElementMaterials {
  std::vector<Spectrum> exitance, reflectance;
};
ElementMaterials materials_of(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches);

/// Exitance of the elements that are not of a light group becomes 0.
void leave_group_alone(std::span<Spectrum> exitance, const std::string& group, const scene::Scene& scene,
                       std::span<const scene::SurfacePatch> patches);

/// The same of unknowns, unknowns x channels: e of a system, and the diagonal of R.
struct MaterialColumns {
  solvers::ColumnMatrix e, R;
};
/// Of polynomials: exitance of elements' first functions, reflectance of those up to a degree, 0 of all others.
/// @param degree     of elements
/// @param functions  that each has
MaterialColumns on_functions(std::span<const Spectrum> exitance, std::span<const Spectrum> reflectance, int channels,
                             std::span<const int> degree, Index functions);
/// Of values at nodes: what the element has that a node lies on.
MaterialColumns at_nodes(std::span<const Spectrum> exitance, std::span<const Spectrum> reflectance, int channels,
                         const NodeSet& nodes);

}  // namespace interflect::fem
