#include "montecarlo/light/light_set.h"

#include <algorithm>
#include <cmath>

#include "montecarlo/light/environment.h"
#include "montecarlo/light/point.h"
#include "montecarlo/light/rectangle.h"
#include "montecarlo/light/sky.h"
#include "montecarlo/light/sphere.h"
#include "montecarlo/light/spot.h"
#include "montecarlo/light/sun.h"
#include "montecarlo/light/triangle.h"

namespace interflect::montecarlo {

/// Of all that light may meet.
static geometry::Box box_with_balls(const scene::Scene& scene) {
  geometry::Box box = scene.box();
  for (const scene::SphereLight& ball : scene.lights.spheres) {
    const Vec3 reach = Vec3::Constant(ball.radius);
    box.extend(geometry::Box(ball.centre - reach, ball.centre + reach));
  }
  return box;
}

LightSet::LightSet(const scene::Scene& scene, Picking picking) : of_facet_(scene.facets.size(), none) {
  const geometry::Box box = box_with_balls(scene);
  centre_ = box.center(), radius_ = box.diagonal().norm() / 2;
  add_surfaces(scene);
  const scene::Lights& others = scene.lights;
  for (const auto& light : others.points)
    if (!light.intensity.is_zero()) lights_.push_back(std::make_unique<PointSource>(light));
  for (const auto& light : others.spots)
    if (!light.intensity.is_zero()) lights_.push_back(std::make_unique<Spot>(light));
  first_ball_ = size();
  for (const auto& light : others.spheres) {  // dark ones too: they stand in the way
    lights_.push_back(std::make_unique<BallLight>(light));
    balls_.add(light.centre, light.radius);
  }
  nearby_ = size();
  for (const auto& light : others.suns)
    if (!light.irradiance.is_zero()) lights_.push_back(std::make_unique<SunLight>(light, box));
  if (const auto* sky = std::get_if<scene::Sky>(&others.sky))
    if (!sky->radiance.is_zero() || !sky->ground.is_zero()) lights_.push_back(std::make_unique<SkyLight>(*sky, box));
  if (const auto* map = std::get_if<scene::EnvironmentMap>(&others.sky)) {
    auto light = std::make_unique<EnvironmentLight>(*map, box);
    if (!light->flux().is_zero()) lights_.push_back(std::move(light));
  }
  double total = 0;
  for (std::uint32_t l = 0; l < nearby_; ++l) {
    share_.push_back(lights_[l]->flux().max());
    total += share_.back();
  }
  any_nearby_ = total > 0;
  if (any_nearby_) {
    by_power_ = AliasTable(share_);
    for (double& share : share_) share /= total;
    if (picking == Picking::by_tree || (picking == Picking::by_number && nearby_ > few)) {
      std::vector<LightExtent> extents;
      for (std::uint32_t l = 0; l < nearby_; ++l) extents.push_back(lights_[l]->extent());
      tree_ = LightTree(extents);
    }
  }
  const std::uint32_t groups = size() - nearby_ + (any_nearby_ ? 1 : 0);
  if (groups == 0) {
    lights_.clear();  // dark balls alone
    balls_ = {};
    return;
  }
  of_group_ = 1.0 / groups;
  set_largest();
}

void LightSet::add_surfaces(const scene::Scene& scene) {
  for (const scene::SurfaceId id : scene.surface_ids()) {
    const Spectrum exitance = scene.material(id).exitance_of(scene::Side::front);
    if (exitance.is_zero()) continue;
    const scene::Surface& surface = scene.surface(id);
    if (surface.outline && surface.outline->holes.empty() && is_rectangle(surface.outline->outer)) {
      const geometry::Ring& ring = surface.outline->outer;
      for (std::uint32_t f = 0; f < surface.facets; ++f) of_facet_[surface.first_facet + f] = size();
      lights_.push_back(std::make_unique<RectangleLight>(ring[0], ring[1] - ring[0], ring[3] - ring[0],
                                                         scene.facets[surface.first_facet].normal, exitance));
    } else {
      add_facet_lights(scene, id, exitance);
    }
  }
}

void LightSet::add_facet_lights(const scene::Scene& scene, scene::SurfaceId id, const Spectrum& exitance) {
  const scene::Surface& surface = scene.surface(id);
  for (std::uint32_t f = surface.first_facet; f < surface.first_facet + surface.facets; ++f) {
    const scene::Facet& facet = scene.facets[f];
    if (!(facet.area > 0)) continue;
    of_facet_[f] = size();
    lights_.push_back(std::make_unique<TriangleLight>(facet.corner, facet.normal, exitance));
  }
}

LightSet::Picked LightSet::pick(const Place& at, double u) const {
  const std::uint32_t afar = size() - nearby_;
  if (afar > 0) {
    const double scaled = u / of_group_;
    const auto group = std::min(static_cast<std::uint32_t>(scaled), any_nearby_ ? afar : afar - 1);
    if (group < afar) return {nearby_ + group, of_group_};
    u = std::min(scaled - group, 1 - 0x1p-53);
  }
  if (tree_.empty()) {
    const std::uint32_t light = by_power_.pick(u);
    return {light, of_group_ * share_[light]};
  }
  const LightTree::Picked picked = tree_.pick(at, u);
  return {picked.light, of_group_ * picked.probability};
}

double LightSet::probability(std::uint32_t light, const Place& at) const {
  if (light >= nearby_) return of_group_;
  return of_group_ * (tree_.empty() ? share_[light] : tree_.probability(light, at));
}

Spectrum LightSet::flux() const {
  Spectrum sum;
  for (const auto& light : lights_) sum += light->flux();
  return sum;
}

void LightSet::set_largest() {
  Spectrum nearby, afar, rays_afar;
  for (std::uint32_t l = 0; l < size(); ++l) {
    const LargestFind find = lights_[l]->largest_find(0.1 * radius_);
    const double p = l < nearby_ ? of_group_ * share_[l] : of_group_;
    Spectrum least;
    for (int c = 0; c < Spectrum::capacity; ++c)
      least[c] = p > 0 ? std::min(find.pi_radiance[c], find.arriving[c] / p) : 0;
    const Spectrum by_ray = lights_[l]->is_delta() ? Spectrum::zero() : find.pi_radiance;
    if (l < nearby_) {
      nearby = max(nearby, least);
      brightest_ = max(brightest_, by_ray);
    } else {  // a ray that escapes sees them all
      afar += least;
      rays_afar += by_ray;
    }
  }
  largest_ = max(nearby, afar);
  brightest_ = max(brightest_, rays_afar);
}

}  // namespace interflect::montecarlo
