#include "fem/arriving_by_rays.h"

#include <array>

#include "core/parallel.h"
#include "core/random.h"

namespace interflect::fem {

std::vector<Spectrum> arriving_by_rays(const RayTransitions& rays, std::span<const Spectrum> sent, const Run& run) {
  constexpr std::size_t rays_each = 64;
  const auto draw = static_cast<std::size_t>(rays.dimensions());
  const std::uint64_t seed = core::derived_seed(run.seed, "arriving by rays");
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

}  // namespace interflect::fem
