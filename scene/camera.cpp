#include "scene/camera.h"

#include <array>
#include <limits>

#include "core/error.h"
#include "scene/film_map.h"

namespace interflect::scene {
namespace {

const char* fault_of(const Pinhole& p) {
  return p.fov_y_deg > 0 && p.fov_y_deg < 180 ? nullptr : "an angle of view between 0 and 180 degrees expected";
}

const char* fault_of(const ThinLens& l) {
  if (!(l.radius > 0 && std::isfinite(l.radius))) return "a lens with a radius above 0 expected";
  if (!(l.focus > 0 && std::isfinite(l.focus))) return "a distance of focus above 0 expected";
  return fault_of(Pinhole{l.fov_y_deg});
}

const char* fault_of(const Orthographic& o) {
  return o.height > 0 && std::isfinite(o.height) ? nullptr : "a picture with a height above 0 expected";
}

const char* fault_of(const Panoramic& p) {
  if (!(p.width_deg > 0 && p.width_deg <= 360)) return "a width above 0 and up to 360 degrees expected";
  return p.height_deg > 0 && p.height_deg <= 180 ? nullptr : "a height above 0 and up to 180 degrees expected";
}

const char* fault_of(const Fisheye& f) {
  return f.fov_deg > 0 && f.fov_deg <= 360 ? nullptr : "an angle of view above 0 and up to 360 degrees expected";
}

const char* fault_of(const Camera& camera) {
  if (camera.width < 1 || camera.height < 1) return "a picture with at least one pixel expected";
  const Vec3 along = camera.target - camera.eye;
  if (!(along.cross(camera.up).stableNorm() > 1e-9 * along.stableNorm() * camera.up.stableNorm()))
    return "a direction upwards that is not along the view expected";
  return std::visit([](const auto& projection) { return fault_of(projection); }, camera.projection);
}

}  // namespace

std::string Camera::projection_name() const {
  constexpr std::array names = {"pinhole", "thin-lens", "orthographic", "panoramic", "fisheye"};
  static_assert(names.size() == std::variant_size_v<Projection::variant>);
  return names[projection.index()];
}

std::optional<CameraRay> Camera::ray(double x, double y) const { return FilmMap(*this).ray({x, y}); }

Vec3 Camera::direction(double x, double y) const { return ray(x, y).value().direction; }

void require_valid(const Camera& camera) {
  if (const char* fault = fault_of(camera)) throw core::InputError("camera '" + camera.name + "'", fault);
}

}  // namespace interflect::scene
