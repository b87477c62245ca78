#include "scene/scene.h"

namespace interflect::scene {

Facet make_facet(SurfaceId surface, const std::array<Vec3, 3>& corner) {
  const Vec3 twice = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  const double length = twice.norm();
  return {surface, corner, length > 0 ? Vec3(twice / length) : Vec3(Vec3::Zero()), 0.5 * length};
}

std::vector<SurfaceId> Scene::surface_ids() const {
  std::vector<SurfaceId> ids;
  ids.reserve(surfaces.size());
  for (std::uint32_t i = 0; i < surfaces.size(); ++i) ids.push_back(SurfaceId{i});
  return ids;
}

std::string Scene::side_name(SurfaceId id, Side side) const {
  return side == Side::front ? surface(id).name : surface(id).name + back_suffix;
}

std::optional<CameraId> Scene::find_camera(const std::string& name) const {
  for (std::uint32_t i = 0; i < cameras.size(); ++i)
    if (cameras[i].name == name) return CameraId{i};
  return std::nullopt;
}

double Scene::area(SurfaceId id) const {
  double sum = 0;
  for (const Facet& facet : facets_of(id)) sum += facet.area;
  return sum;
}

geometry::Box Scene::box() const {
  geometry::Box box;
  for (const Facet& facet : facets)
    for (const Vec3& x : facet.corner) box.extend(x);
  return box;
}

double Scene::weigh(const Spectrum& s) const {
  double sum = 0;
  for (int c = 0; c < channel_count(); ++c)
    if (weights[c] != 0) sum += weights[c] * s[c];  // 0 times an unknown (infinite) error is no part of the sum
  return sum;
}

Spectrum Scene::emitted_flux() const {
  Spectrum sum;
  for (const SurfaceId id : surface_ids()) sum += area(id) * material(id).exitance;
  return sum;
}

std::array<double, 3> Scene::rgb(const Spectrum& s) const {
  if (channels == std::vector<std::string>{"r", "g", "b"}) return {s[0], s[1], s[2]};
  double total = 0;
  for (int c = 0; c < channel_count(); ++c) total += weights[c];
  const double grey = total > 0 ? weigh(s) / total : 0;
  return {grey, grey, grey};
}

}  // namespace interflect::scene
