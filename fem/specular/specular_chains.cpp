#include "fem/specular/specular_chains.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/error.h"
#include "core/fresnel.h"
#include "core/random.h"
#include "fem/element_rays.h"
#include "fem/specular/smooth_surface.h"

namespace interflect::fem {
namespace {

constexpr int most_vertices = 1000;  ///< of a chain: beyond, what goes to and fro between mirrors is lost
constexpr Index rays_of_a_check = 1 << 15;
constexpr double slips = 1e-3;  ///< of chains: as many rays slip through edges of glass by rounding

/// A ray on its way through smooth surfaces.
struct OnItsWay {
  raycast::Ray ray;
  Spectrum weight{1};
  double squeezed = 1;  ///< of radiance, by the square of the index
  bool bent = false;
};

/// One of the parts, or neither.  @return  whether it goes on
bool scatter(const scene::SurfacePoint& at, const SmoothParts& parts, double u, OnItsWay& way) {
  const double reflects = parts.reflected.max(), passes = parts.passed.max(), all = std::max(1.0, reflects + passes);
  const Vec3 back = -way.ray.direction;
  if (u * all < reflects) {
    way.weight *= all * (parts.reflected / reflects);
    way.ray = {at.position, core::reflected(back, at.normal), at.normal};
    way.bent = true;
    return true;
  }
  if (!(u * all < reflects + passes)) return false;
  std::optional<Vec3> onward = way.ray.direction;
  if (parts.eta != 1) onward = core::refracted(back, at.normal, parts.eta);
  if (!onward) return false;  // of a ray that rounding lets pass where all is reflected
  way.weight *= all * (parts.passed / passes);
  way.squeezed /= parts.eta * parts.eta;
  way.bent = way.bent || parts.eta != 1;
  way.ray = {at.position, *onward, -at.normal};
  return true;
}

bool same_in_all(const Spectrum& s, int channels) {
  for (int c = 1; c < channels; ++c)
    if (s[c] != s[0]) return false;
  return true;
}

}  // namespace

std::optional<scene::SurfaceId> any_smooth(const scene::Scene& scene) {
  for (const scene::SurfaceId id : scene.surface_ids())
    if (is_smooth(scene.material(id))) return id;
  return std::nullopt;
}

bool are_smooth_ones_grey(const scene::Scene& scene) {
  const int channels = scene.channel_count();
  for (const scene::SurfaceId id : scene.surface_ids()) {
    const scene::Material& material = scene.material(id);
    if (!is_smooth(material)) continue;
    for (const double cosine : {1.0, 0.75, 0.5, 0.25, 0.05}) {
      const SmoothParts parts = smooth_parts(material, cosine, scene::Side::front);
      if (!same_in_all(parts.reflected, channels) || !same_in_all(parts.passed, channels)) return false;
    }
  }
  return true;
}

SpecularChains::SpecularChains(const scene::Scene& scene, const raycast::RayCaster& rays, std::uint64_t seed)
    : scene_(scene), rays_(rays), seed_(core::derived_seed(seed, "specular chains")) {}

bool SpecularChains::goes_on_at(const std::optional<scene::SurfacePoint>& met) const {
  if (!met) return false;
  const scene::Material& material = scene_.material(met->surface);
  return material.active(met->side) && is_smooth(material);
}

SpecularChains::End SpecularChains::onward(const raycast::Ray& ray,
                                           const std::optional<scene::SurfacePoint>& met) const {
  if (!goes_on_at(met)) return {met};
  const Vec3 &o = ray.origin, &d = ray.direction;
  core::RandomNumbers random(seed_, 0, core::key_of({o.x(), o.y(), o.z(), d.x(), d.y(), d.z()}));
  OnItsWay way{ray};
  std::optional<scene::SurfacePoint> at = met;
  for (int k = 0; k < most_vertices && goes_on_at(at); ++k) {
    const double cosine = std::min(1.0, -at->normal.dot(way.ray.direction));
    const SmoothParts parts = smooth_parts(scene_.material(at->surface), std::max(0.0, cosine), at->side);
    if (!scatter(*at, parts, random.next(), way)) return {at, Spectrum::zero()};
    at = rays_.closest(way.ray);
  }
  return {at, goes_on_at(at) ? Spectrum::zero() : way.squeezed * way.weight, way.bent,
          std::abs(way.squeezed - 1) < 1e-9};
}

void require_outside_glass(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches,
                           const raycast::RayCaster& rays, Run& run) {
  if (!any_smooth(scene) || patches.empty()) return;
  std::vector<double> areas;
  for (const scene::SurfacePatch& patch : patches) areas.push_back(patch.area);
  std::partial_sum(areas.begin(), areas.end(), areas.begin());
  const SpecularChains chains(scene, rays, run.seed);
  const std::uint64_t seed = core::derived_seed(run.seed, "outside glass");
  /// Where a chain began and ended in different media.
  struct Between {
    scene::SurfaceId from, to;
  };
  std::vector<std::optional<Between>> found(rays_of_a_check);
  run.threads.for_blocks(rays_of_a_check, 1024, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      core::RandomNumbers random(seed, 0, static_cast<std::uint64_t>(k));
      const double at = random.next() * areas.back();
      const auto i = static_cast<std::size_t>(std::upper_bound(areas.begin(), areas.end() - 1, at) - areas.begin());
      const double s = random.next(), t = random.next(), u = random.next(), v = random.next();
      const SpecularChains::End ended = chains.follow(ElementRays(patches[i])(s, t, u, v).ray);
      if (ended.at && !ended.same_medium)
        found[static_cast<std::size_t>(k)] = Between{patches[i].surface, ended.at->surface};
    }
  });
  const auto is_there = [](const std::optional<Between>& each) { return each.has_value(); };
  if (static_cast<double>(std::count_if(found.begin(), found.end(), is_there)) <= slips * rays_of_a_check) return;
  const Between between = **std::find_if(found.begin(), found.end(), is_there);
  throw core::InputError(
      "'" + scene.surface(between.from).name + "' and '" + scene.surface(between.to).name + "'",
      "one of them stands inside glass, or glass between them is not closed: radiosity knows what is "
      "outside; interflect trace does this");
}

}  // namespace interflect::fem
