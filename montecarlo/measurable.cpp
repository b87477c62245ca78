#include "montecarlo/measurable.h"

#include <cmath>

#include "core/error.h"
#include "core/format.h"
#include "core/overloaded.h"

namespace interflect::montecarlo {
namespace {

void require_area(const scene::SurfacePatch& patch) {
  if (!(patch.area > 0) || patch.corners < 3 || patch.corners > 4)
    throw core::InputError("measured patch", "a triangle or quad with an area expected");
}

void require_pixel(const scene::Scene& scene, const measure::PixelRadiance& pixel) {
  if (pixel.camera.value >= scene.cameras.size())
    throw core::InputError("pixel radiance", "a camera of the scene expected");
  const scene::Camera& camera = scene.camera(pixel.camera);
  scene::require_valid(camera);
  if (pixel.x < 0 || pixel.y < 0 || pixel.x >= camera.width || pixel.y >= camera.height)
    throw core::InputError(core::format("pixel (%d, %d)", pixel.x, pixel.y),
                           "a pixel of camera '" + camera.name + "' expected");
}

}  // namespace

void require_measurable(const scene::Scene& scene, const measure::Measurement& asked) {
  std::visit(core::Overloaded{[](const measure::PatchIrradiance& m) { require_area(m.patch); },
                              [](const measure::Flux& m) {
                                if (m.through.empty())
                                  throw core::InputError("measured flux", "at least one patch expected");
                                for (const scene::SurfacePatch& patch : m.through) require_area(patch);
                              },
                              [](const measure::PointIrradiance& m) {
                                if (!(std::abs(m.normal.norm() - 1) < 1e-9))
                                  throw core::InputError("point irradiance", "a unit normal expected");
                              },
                              [&](const measure::PixelRadiance& m) { require_pixel(scene, m); }},
             asked);
}

double scale_of(const measure::Measurement& asked) {
  if (std::holds_alternative<measure::PixelRadiance>(asked)) return inv_pi;
  const auto* flux = std::get_if<measure::Flux>(&asked);
  if (!flux) return 1;
  double area = 0;
  for (const scene::SurfacePatch& patch : flux->through) area += patch.area;
  return area;
}

}  // namespace interflect::montecarlo
