#include "apps/factor_request.h"

#include <algorithm>
#include <limits>
#include <map>

#include "apps/read_scene.h"
#include "core/error.h"
#include "core/format.h"
#include "core/log.h"
#include "mesh/uniform.h"
#include "scene/inspection.h"

namespace interflect::apps {
namespace {

constexpr double most_elements = 5e6;  // 150 TB of factors; a needle, meshed for its angles, may ask for any number

/// One element a face, where no size is asked for; those of a solve, where it is.
mesh::ElementMesh mesh_of(const scene::Scene& scene, const ViewFactorOptions& options) {
  if (!(options.element_size > 0)) return mesh::whole_faces(scene);
  if (const double count = mesh::predicted_elements(scene, options.element_size); !(count <= most_elements))
    throw core::InputError(
        options.input.string(),
        core::format("--element-size %g makes about %.1e elements, at most %.0e expected: longer ones, or none "
                     "(one a face)",
                     options.element_size, count, most_elements));
  fem::RadiositySettings settings;
  settings.element_size = options.element_size;
  settings.max_memory = std::numeric_limits<double>::infinity();
  return fem::elements_of(scene, settings, mesh::is_active);
}

/// A mask by its own name, where no surface has it.
std::string name_of(const scene::ExchangeMask& mask, const scene::ExchangeScene& geometry) {
  const auto has_it = [&](const scene::Surface& surface) { return surface.name == mask.name; };
  const auto& surfaces = geometry.scene.surfaces;
  return mask.name + (std::any_of(surfaces.begin(), surfaces.end(), has_it) ? "/mask" : "");
}

std::string name_of(const FactorRequest& request, std::size_t element) {
  if (const scene::ExchangeMask* mask = request.elements.mask_at(element, request.geometry))
    return name_of(*mask, request.geometry);
  const scene::SurfacePatch& patch = request.elements.patches[element];
  return request.geometry.scene.side_name(patch.surface, patch.side);
}

std::vector<fem::CoveredPair> covered_pairs(const mesh::ExchangeElements& elements) {
  std::vector<fem::CoveredPair> pairs;
  for (std::size_t a = elements.open; a + 1 < elements.patches.size(); a += 2)
    pairs.push_back({static_cast<Index>(a), static_cast<Index>(a + 1), elements.patches[a].area});
  return pairs;
}

/// Where two surfaces are one place, what others see of them would count twice, or as each method breaks the tie.
/// Within one surface, which cannot be left out in part, that is said and no more.
void require_no_overlap(const FactorRequest& request, const std::string& shown) {
  const scene::Scene& scene = request.geometry.scene;
  std::map<std::string, std::size_t> at;
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k) at[scene.surfaces[k].name] = k;
  const auto radiates = [&](std::size_t k) {
    return request.geometry.surfaces[k].role == scene::ExchangeRole::radiates;
  };
  for (const auto& found : scene::overlaps(scene)) {
    const std::size_t a = at[found.surface], b = found.other.empty() ? a : at[found.other];
    if (!radiates(a) || !radiates(b) || found.twice <= 0) continue;
    if (a != b) throw core::InputError(shown, scene::overlap_text(found) + ": cut them, or --leave-out one");
    core::log::warning(scene::overlap_text(found) + ": that part counts twice");
  }
}

void say_notes(const FactorRequest& request) {
  const scene::Scene& scene = request.geometry.scene;
  for (const scene::Note& note : scene.repairs) core::log::info(note.line());
  for (const scene::Note& note : scene.warnings) core::log::warning(note.line());
  if (const std::size_t count = request.elements.masks_left_out; count > 0)
    core::log::warning(core::format("%zu mask(s) left out, whose bases have no view factors", count));
}

}  // namespace

std::vector<measure::PointIrradiance> FactorRequest::places() const {
  std::vector<measure::PointIrradiance> out;
  for (const measure::SensorPoint& point : points) out.push_back(point.at);
  return out;
}

FactorRequest factor_request(const ViewFactorOptions& options) {
  FactorRequest request;
  request.geometry = scene::read_geometry_as_scene(options.input, options.geometry);
  request.elements =
      mesh::exchange_elements(request.geometry, [&](const scene::Scene& scene) { return mesh_of(scene, options); });
  say_notes(request);
  if (request.elements.open == 0)
    throw core::InputError(options.input.string(), "no surface that view factors could be of");
  require_no_overlap(request, options.input.string());
  request.points = measure::sensor_points(request.geometry.scene);
  request.covered = covered_pairs(request.elements);
  request.about = results::factor_elements(request.geometry.scene, request.elements.patches);
  for (std::size_t i = request.elements.open; i < request.size(); ++i) request.about.name[i] = name_of(request, i);
  return request;
}

std::vector<std::string> groups_of(const FactorRequest& request, const std::string& by) {
  const scene::ExchangeScene& geometry = request.geometry;
  std::vector<std::string> groups;
  for (std::size_t i = 0; i < request.size(); ++i) {
    const scene::SurfaceId id = request.elements.patches[i].surface;
    const scene::ExchangeMask* mask = request.elements.mask_at(i, geometry);
    if (by == "material")
      groups.push_back(mask ? mask->material : geometry.scene.material(id).name);
    else if (by == "group" && !mask && id.value < geometry.surfaces.size())
      groups.push_back(geometry.surfaces[id.value].group);
    else
      groups.push_back(name_of(request, i));
  }
  return groups;
}

}  // namespace interflect::apps
