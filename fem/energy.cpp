#include "fem/energy.h"

#include <algorithm>

#include "core/moments.h"
#include "core/random.h"
#include "fem/element_rays.h"
#include "fem/specular/smooth_surface.h"

namespace interflect::fem {

namespace {

constexpr Index ray_count = 100'000, ray_block = 2'000;

/// Running sums of the probabilities that elements send a ray, 1 at the end.
std::vector<double> cumulative_shares(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches,
                                      std::span<const Spectrum> radiosity) {
  const std::size_t n = patches.size();
  std::vector<double> flux(n), sums(n);
  double all_flux = 0.0, all_area = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    flux[i] = patches[i].area * std::max(0.0, scene.weigh(radiosity[i]));
    all_flux += flux[i];
    all_area += patches[i].area;
  }
  const double by_flux = all_flux > 0.0 ? 0.5 / all_flux : 0.0, by_area = (all_flux > 0.0 ? 0.5 : 1.0) / all_area;
  for (std::size_t i = 0; i < n; ++i) sums[i] = sum += by_flux * flux[i] + by_area * patches[i].area;
  for (double& value : sums) value /= sum;
  return sums;
}

bool is_absorbed_by_mirror(const scene::Scene& scene, const scene::SurfacePoint& hit) {
  const scene::Material& material = scene.material(hit.surface);
  return material.active(hit.side) && is_smooth(material);
}

struct Tally {
  core::Moments escaped, on_backs, in_mirrors;
  std::uint64_t lost = 0;
};

}  // namespace

LostRays cast_lost_rays(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches,
                        std::span<const Spectrum> radiosity, const raycast::RayCaster& rays, Run& run) {
  const std::vector<double> shares = cumulative_shares(scene, patches, radiosity);
  const std::uint64_t seed = core::derived_seed(run.seed, "lost flux");
  std::vector<Tally> tallies(static_cast<std::size_t>(ray_count / ray_block));
  run.threads.for_blocks(ray_count, ray_block, [&](Index begin, Index end) {
    run.throw_if_stopped("energy balance");
    Tally& tally = tallies[static_cast<std::size_t>(begin / ray_block)];
    for (Index k = begin; k < end; ++k) {
      core::RandomNumbers random(seed, 0, static_cast<std::uint64_t>(k));
      const double stratified = (static_cast<double>(k) + random.next()) / static_cast<double>(ray_count);
      const auto found = std::upper_bound(shares.begin(), shares.end() - 1, stratified) - shares.begin();
      const auto i = static_cast<std::size_t>(found);
      const double probability = shares[i] - (i > 0 ? shares[i - 1] : 0.0);
      const double s = random.next(), t = random.next(), u = random.next(), v = random.next();
      const ElementRay from = ElementRays(patches[i])(s, t, u, v);
      const auto hit = rays.closest(from.ray);
      const Spectrum flux = from.weight * patches[i].area / probability * radiosity[i];
      const bool absorbed = hit && is_lost(scene, hit), in_mirror = absorbed && is_absorbed_by_mirror(scene, *hit);
      tally.escaped.add(hit ? Spectrum::zero() : flux);
      tally.on_backs.add(absorbed && !in_mirror ? flux : Spectrum::zero());
      tally.in_mirrors.add(in_mirror ? flux : Spectrum::zero());
      tally.lost += !hit || absorbed;
    }
  });
  Tally total;
  for (const Tally& tally : tallies) {
    total.escaped.merge(tally.escaped);
    total.on_backs.merge(tally.on_backs);
    total.in_mirrors.merge(tally.in_mirrors);
    total.lost += tally.lost;
  }
  return {total.escaped.mean(),
          total.on_backs.mean(),
          total.in_mirrors.mean(),
          total.escaped.standard_error(),
          total.on_backs.standard_error(),
          total.in_mirrors.standard_error(),
          static_cast<std::uint64_t>(ray_count),
          total.lost};
}

EnergyBalance energy_balance(const RadiositySolution& s, const LostRays& lost) {
  EnergyBalance energy;
  Spectrum unaccounted;
  for (std::size_t i = 0; i < s.radiosity.size(); ++i) {
    const double area = s.mesh.patches()[i].area;
    energy.emitted += area * s.exitance[i];
    energy.absorbed += area * (s.irradiance[i] - s.reflectance[i] * s.irradiance[i]);
    if (!s.row_sum.empty()) unaccounted += area * (1.0 - s.row_sum[i]) * s.radiosity[i];
  }
  if (s.row_sum.empty()) unaccounted = lost.all();
  energy.escaped = lost.escaped;
  energy.on_backs = lost.on_backs;
  energy.on_backs_error = lost.on_backs_error;
  energy.in_mirrors = lost.in_mirrors;
  energy.split_error = sqrt(lost.escaped_error * lost.escaped_error + lost.on_backs_error * lost.on_backs_error +
                            lost.in_mirrors_error * lost.in_mirrors_error);
  energy.form_factor_error = unaccounted - lost.all();
  energy.residual = energy.emitted - energy.absorbed - unaccounted;
  return energy;
}

}  // namespace interflect::fem
