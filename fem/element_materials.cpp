#include "fem/element_materials.h"

#include "core/error.h"
#include "fem/columns.h"
#include "fem/space/polynomials.h"
#include "fem/specular/smooth_surface.h"

namespace interflect::fem {

using solvers::ColumnMatrix;

namespace {

void require_lights_are_surfaces(const scene::Scene& scene) {
  if (!scene.lights.empty())
    throw core::InputError(scene.lights.first_name(),
                           "radiosity knows lights that are surfaces; interflect trace does this");
}

[[noreturn]] void refuse(const scene::Scene& scene, scene::SurfaceId id, const std::string& why) {
  const scene::Material& material = scene.material(id);
  throw core::InputError("'" + scene.surface(id).name + "'",
                         "its material '" + material.name + "' is " + material.kind() + ": " + why);
}

/// A rough metal or rough glass: what has another lobe, whole, in place of a diffuse one.
bool is_rough(const scene::Material& material) {
  return material.opacity == 1 && !is_smooth(material) && !material.is_diffuse() &&
         !std::holds_alternative<scene::Plastic>(material.finish);
}

}  // namespace

void require_diffuse(const scene::Scene& scene) {
  require_lights_are_surfaces(scene);
  for (const scene::SurfaceId id : scene.surface_ids())
    if (!scene.material(id).is_diffuse())
      refuse(scene, id, "what is diffuse and opaque is expected here; interflect solve knows mirrors and smooth glass");
}

void require_diffuse_or_smooth(const scene::Scene& scene, bool rough_is_black) {
  require_lights_are_surfaces(scene);
  for (const scene::SurfaceId id : scene.surface_ids()) {
    const scene::Material& material = scene.material(id);
    if (material.is_diffuse()) continue;
    if (!is_smooth(material) && !(rough_is_black && is_rough(material)))
      refuse(scene, id,
             std::string("radiosity knows what is diffuse, mirrors and smooth glass; interflect trace does this") +
                 (is_rough(material) ? ", by --integrator two-pass with radiosity for the rest" : ""));
    if (!material.exitance.is_zero())
      refuse(scene, id, "one that emits is not known to radiosity; interflect trace does this");
  }
}

ElementMaterials materials_of(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches) {
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
