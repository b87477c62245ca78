#include "fem/element_materials.h"

#include "core/error.h"
#include "fem/columns.h"
#include "fem/space/polynomials.h"

namespace interflect::fem {

using solvers::ColumnMatrix;

void require_diffuse(const scene::Scene& scene) {
  if (!scene.lights.empty())
    throw core::InputError(scene.lights.first_name(),
                           "radiosity knows lights that are surfaces; interflect trace does this");
  for (const scene::SurfaceId id : scene.surface_ids())
    if (const scene::Material& material = scene.material(id); !material.is_diffuse())
      throw core::InputError("'" + scene.surface(id).name + "'",
                             "its material '" + material.name + "' is " + material.kind() +
                                 ": radiosity knows what is diffuse and opaque; interflect trace does this");
}

ElementMaterials materials_of(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches) {
  require_diffuse(scene);
  ElementMaterials out;
  for (const scene::SurfacePatch& patch : patches) {
    const scene::Material& material = scene.material(patch.surface);
    out.exitance.push_back(material.exitance_of(patch.side));
    out.reflectance.push_back(material.reflectance_of(patch.side));
  }
  return out;
}

void leave_group_alone(std::span<Spectrum> exitance, const std::string& group, const scene::Scene& scene,
                       std::span<const scene::SurfacePatch> patches) {
  for (std::size_t i = 0; i < exitance.size(); ++i)
    if (scene.material(patches[i].surface).light_group() != group) exitance[i] = Spectrum::zero();
}

MaterialColumns on_functions(std::span<const Spectrum> exitance, std::span<const Spectrum> reflectance, int channels,
                             std::span<const int> degree, Index functions) {
  const Index elements = std::ssize(degree);
  MaterialColumns out{ColumnMatrix::Zero(elements * functions, channels), {}};
  out.R = out.e;
  const ColumnMatrix e = to_columns(exitance, channels), R = to_columns(reflectance, channels);
  for (Index i = 0; i < elements; ++i) {
    const Index active = plane_functions(degree[static_cast<std::size_t>(i)]);
    out.e.row(i * functions) = e.row(i);
    out.R.middleRows(i * functions, active).rowwise() = R.row(i);
  }
  return out;
}

MaterialColumns at_nodes(std::span<const Spectrum> exitance, std::span<const Spectrum> reflectance, int channels,
                         const NodeSet& nodes) {
  const ColumnMatrix e = to_columns(exitance, channels), R = to_columns(reflectance, channels);
  MaterialColumns out{ColumnMatrix(nodes.size(), channels), ColumnMatrix(nodes.size(), channels)};
  for (Index k = 0; k < nodes.size(); ++k) {
    out.e.row(k) = e.row(nodes.panel[static_cast<std::size_t>(k)]);
    out.R.row(k) = R.row(nodes.panel[static_cast<std::size_t>(k)]);
  }
  return out;
}

}  // namespace interflect::fem
