#include "fem/specular/mirrored_light.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/random.h"
#include "fem/element_rays.h"
#include "fem/form_factor/element_locator.h"
#include "fem/specular/specular_chains.h"

namespace interflect::fem {
namespace {

constexpr Index ray_count = 1 << 20, block_count = 16;

/// What ends on each element, over all rays.
struct Deposits {
  std::vector<Spectrum> sum, squares;

  explicit Deposits(std::size_t elements) : sum(elements), squares(elements) {}
  void add(std::size_t element, const Spectrum& flux) {
    sum[element] += flux;
    squares[element] += flux * flux;
  }
  void add(const Deposits& other) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += other.sum[i], squares[i] += other.squares[i];
  }
};

double sum_of(const Spectrum& s) { return std::accumulate(s.data(), s.data() + Spectrum::capacity, 0.0); }

/// Running sums of the elements' fluxes, all channels together [W | lm].
std::vector<double> running_flux(const RadiositySolution& s) {
  std::vector<double> flux;
  for (std::size_t i = 0; i < s.exitance.size(); ++i) flux.push_back(s.mesh.patches()[i].area * sum_of(s.exitance[i]));
  std::partial_sum(flux.begin(), flux.end(), flux.begin());
  return flux;
}

/// SE² = (mean of squares - square of the mean) / (n - 1), but no less than what a ray of the mean colour brings; where
/// none ended three of them: the 95 % bound of what n rays have not found.
MirroredLight of_deposits(const Deposits& deposits, const RadiositySolution& s) {
  const auto n = static_cast<double>(ray_count);
  Spectrum flux;
  for (std::size_t i = 0; i < s.exitance.size(); ++i) flux += s.mesh.patches()[i].area * s.exitance[i];
  MirroredLight light;
  for (std::size_t i = 0; i < deposits.sum.size(); ++i) {
    const double per_area = 1 / s.mesh.patches()[i].area;
    const Spectrum mean = deposits.sum[i] / n, of_a_ray = (per_area / n) * flux;
    const Spectrum scatter = per_area * sqrt(max((deposits.squares[i] / n - mean * mean) / (n - 1), Spectrum::zero()));
    light.irradiance.push_back(per_area * mean);
    light.standard_error.push_back(max(scatter, (mean.is_zero() ? 3 : 1) * of_a_ray));
  }
  return light;
}

}  // namespace

MirroredLight mirrored_light(const scene::Scene& scene, const RadiositySolution& s, const raycast::RayCaster& rays,
                             Run& run) {
  const std::size_t elements = s.exitance.size();
  const std::vector<double> flux = running_flux(s);
  const std::vector<Spectrum> none(elements);
  if (!any_smooth(scene) || elements == 0 || !(flux.back() > 0)) return {none, none};
  const SpecularChains chains(scene, rays, run.seed);
  const ElementLocator locate(s.mesh.patches());
  const std::uint64_t seed = core::derived_seed(run.seed, "mirrored light");
  std::vector<Deposits> of_blocks(block_count, Deposits(elements));
  core::Progress::Stage stage(run.progress, "light of mirrors", static_cast<std::uint64_t>(ray_count));
  constexpr Index block = ray_count / block_count;
  run.threads.for_blocks(ray_count, block, [&](Index begin, Index end) {
    run.throw_if_stopped("light of mirrors");
    Deposits& deposits = of_blocks[static_cast<std::size_t>(begin / block)];
    for (Index k = begin; k < end; ++k) {
      core::RandomNumbers random(seed, 0, static_cast<std::uint64_t>(k));
      const double at = (static_cast<double>(k) + random.next()) / static_cast<double>(ray_count) * flux.back();
      const auto i = static_cast<std::size_t>(
          std::upper_bound(flux.begin(), flux.end(), std::min(at, std::nextafter(flux.back(), 0.0))) - flux.begin());
      const double a = random.next(), b = random.next(), u = random.next(), v = random.next();
      const ElementRay from = ElementRays(s.mesh.patches()[i])(a, b, u, v);
      const SpecularChains::End found = chains.follow(from.ray);
      if (!found.bent || !found.at || found.weight.is_zero()) continue;
      const Index j = locate(*found.at);
      if (j == ElementLocator::none) continue;
      const Spectrum carried = from.weight * (flux.back() / sum_of(s.exitance[i])) * s.exitance[i];
      deposits.add(static_cast<std::size_t>(j), carried * found.weight);
    }
    stage.advance(static_cast<std::uint64_t>(end - begin));
  });
  Deposits all(elements);
  for (const Deposits& deposits : of_blocks) all.add(deposits);
  return of_deposits(all, s);
}

}  // namespace interflect::fem
