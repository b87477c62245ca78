#include "montecarlo/scene_paths.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/format.h"

namespace interflect::montecarlo {
namespace {

/// `(A|P)`; empty if none is there.
std::string any_of(const std::string& letters, const std::array<bool, measure::path_letters>& there) {
  std::string any;
  for (std::size_t k = 0; k < letters.size(); ++k)
    if (there[k]) any += (any.empty() ? "" : "|") + letters.substr(k, 1);
  return any.empty() ? any : "(" + any + ")";
}

bool shines(const scene::Scene& scene) {
  for (const scene::SurfaceId id : scene.surface_ids())
    for (const scene::Side side : {scene::Side::front, scene::Side::back})
      if (!scene.material(id).exitance_of(side).is_zero()) return true;
  return false;
}

bool has_angle(const scene::Sun& sun) { return sun.one_minus_cosine() > 0; }

/// In words: what stands for a letter.
std::string in_words(char letter) {
  switch (letter) {
    case 'A':
      return "a light with an area";
    case 'P':
      return "a point or spot";
    case 'F':
      return "the sun or sky";
    case 'B':
      return "a sun without an angle";
    case 'D':
      return "a diffuse surface";
    case 'G':
      return "a glossy one";
    case 'S':
      return "a mirror, pane or smooth glass";
    default:
      return "";
  }
}

/// Without what is measured.
std::string in_words(const std::string& path) {
  std::string words;
  for (std::size_t k = 0; k + 1 < path.size(); ++k) words += (k == 0 ? "from " : ", by ") + in_words(path[k]);
  return words;
}

}  // namespace

measure::PathClasses paths_in(const scene::Scene& scene) {
  const scene::Lights& lights = scene.lights;
  const bool area = shines(scene) || !lights.spheres.empty(), points = !lights.points.empty() || !lights.spots.empty(),
             disks = std::ranges::any_of(lights.suns, has_angle), beams = !std::ranges::all_of(lights.suns, has_angle),
             far = disks || lights.has_sky();
  const std::string from = any_of("APFB", {area, points, far, beams});
  const Scatters surfaces = scatters_in(scene);
  const std::string by = any_of("DGS", {surfaces.diffuse, surfaces.glossy, surfaces.specular});
  if (from.empty()) return measure::PathClasses::of("");
  return measure::PathClasses::of(from + (by.empty() ? "" : by + "*") + "E");
}

Scatters scatters_in(const scene::Scene& scene) {
  Scatters any;
  for (const scene::SurfaceId id : scene.surface_ids()) {
    const Scatters by_this = scatters_of(scene.material(id));
    any.diffuse |= by_this.diffuse, any.glossy |= by_this.glossy, any.specular |= by_this.specular;
  }
  return any;
}

measure::PathClasses that_reach(const measure::Measurement& asked, const measure::PathClasses& paths) {
  return std::holds_alternative<measure::PixelRadiance>(asked) ? paths - measure::PathClasses::of("(P|B)S*E") : paths;
}

void require_found(const measure::Method& method, const scene::Scene& scene,
                   std::span<const measure::Measurement> asked, const measure::PathClasses& wanted) {
  const measure::PathClasses there = paths_in(scene) & wanted;
  const measure::Capabilities finds = method.capabilities();
  std::array<bool, 3> seen{};  // patches, points, pixels
  for (const measure::Measurement& each : asked) {
    const bool pixel = std::holds_alternative<measure::PixelRadiance>(each),
               point = std::holds_alternative<measure::PointIrradiance>(each);
    bool& done = seen[pixel ? 2 : point ? 1 : 0];
    if (done) continue;
    done = true;
    const measure::PathClasses missed = that_reach(each, there) - finds.paths_to(each);
    if (missed.empty()) continue;
    const std::string path = missed.shortest();
    throw core::InputError(
        method.name(), core::format("paths %s (%s) are not found at %s: another integrator expected, or --paths '%s', "
                                    "which leaves them out",
                                    path.c_str(), in_words(path).c_str(),
                                    pixel   ? "pixels"
                                    : point ? "points"
                                            : "patches",
                                    finds.paths_to(each).expression().c_str()));
  }
}

}  // namespace interflect::montecarlo
