#include "fem/arriving_by_rays.h"

#include <array>

#include "core/moments.h"
#include "core/parallel.h"
#include "core/random.h"

namespace interflect::fem {

namespace {

constexpr std::size_t rays_each = 64;
constexpr const char* purpose = "arriving by rays";

}  // namespace

std::vector<Spectrum> arriving_by_rays(const RayTransitions& rays, std::span<const Spectrum> sent, const Run& run) {
  const auto draw = static_cast<std::size_t>(rays.dimensions());
  const std::uint64_t seed = core::derived_seed(run.seed, purpose);
  std::vector<Spectrum> arriving(sent.size());
  run.threads.for_blocks(static_cast<Index>(sent.size()), 64, [&](Index begin, Index end) {
    std::vector<double> u(rays_each * draw);
    std::array<Index, rays_each> from, met;
    for (Index i = begin; i < end; ++i) {
      core::random_numbers(seed, 0, static_cast<std::uint64_t>(i) * rays_each, draw, u);
      from.fill(i);
      rays.from_elements(from, u, met);
      Spectrum sum;
      for (const Index j : met)
        if (j != RayTransitions::nowhere) sum += sent[static_cast<std::size_t>(j)];
      arriving[static_cast<std::size_t>(i)] = sum / static_cast<double>(rays_each);
    }
  });
  return arriving;
}

std::vector<Spectrum> added_by_rays(const RayTransitions& rays, const PolynomialField& field, const Run& run) {
  const auto draw = static_cast<std::size_t>(rays.dimensions());
  const std::uint64_t seed = core::derived_seed(run.seed, purpose);
  std::vector<Spectrum> added(field.degree.size());
  run.threads.for_blocks(std::ssize(added), 64, [&](Index begin, Index end) {
    std::vector<double> u(rays_each * draw);
    for (Index i = begin; i < end; ++i) {
      core::random_numbers(seed, 0, static_cast<std::uint64_t>(i) * rays_each, draw, u);
      core::Moments moments;
      for (std::size_t k = 0; k < rays_each; ++k) {
        const std::span<const double> of_ray = std::span(u).subspan(k * draw, draw);
        const auto met = rays.from_point(rays.point_on(i, of_ray), of_ray.subspan(2));
        moments.add(met ? field.added_at(static_cast<std::size_t>(met->element), met->position) : Spectrum::zero());
      }
      added[static_cast<std::size_t>(i)] = abs(moments.mean()) + moments.standard_error();
    }
  });
  return added;
}

}  // namespace interflect::fem
