#include "fem/form_factor/visibility.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/random.h"
#include "fem/element_point.h"

namespace interflect::fem {

namespace {

/// A random permutation of 0 .. n-1 [Fisher, Yates 1938]; the first of the stream's blocks are its own.
void permute(std::uint64_t seed, std::uint64_t pair, std::vector<std::uint32_t>& order) {
  std::iota(order.begin(), order.end(), 0u);
  core::RandomBlock block{};
  for (std::uint32_t left = static_cast<std::uint32_t>(order.size()), drawn = 0; left > 1; --left, ++drawn) {
    if (drawn % 4 == 0) block = core::random_block(seed, 1, pair, drawn / 4);
    const auto at = static_cast<std::uint32_t>((std::uint64_t{block[drawn % 4]} * left) >> 32);
    std::swap(order[left - 1], order[at]);
  }
}

}  // namespace

VisibilitySampler::VisibilitySampler(std::span<const scene::SurfacePatch> patches, const raycast::RayCaster& rays, std::uint64_t seed)
    : patches_(patches), rays_(rays), seed_(core::derived_seed(seed, "visibility")) {
  for (const auto& patch : patches) normals_.push_back(patch.normal());
}

void VisibilitySampler::generate(Index i, Index j, int side, Workspace& w) const {
  const auto n = static_cast<std::uint32_t>(side * side), m = static_cast<std::uint32_t>(side);
  const std::uint64_t pair = (static_cast<std::uint64_t>(i) << 32) | static_cast<std::uint64_t>(j);
  const auto &patch_i = patches_[static_cast<std::size_t>(i)], &patch_j = patches_[static_cast<std::size_t>(j)];
  const Vec3 &normal_i = normals_[static_cast<std::size_t>(i)], &normal_j = normals_[static_cast<std::size_t>(j)];
  const double cell = 1.0 / side;
  w.partner.resize(n);
  permute(seed_, pair, w.partner);
  w.segments.clear();
  w.weights.clear();
  for (std::uint32_t k = 0; k < n; ++k) {
    const core::RandomBlock u = core::random_block(seed_, 0, pair, k);
    const std::uint32_t l = w.partner[k];
    const auto x = element_point(patch_i, cell * (k / m + core::uniform_32(u[0])), cell * (k % m + core::uniform_32(u[1])));
    const auto y = element_point(patch_j, cell * (l / m + core::uniform_32(u[2])), cell * (l % m + core::uniform_32(u[3])));
    const Vec3 d = y.position - x.position;
    const double leaves = normal_i.dot(d), arrives = -normal_j.dot(d);
    if (leaves <= 0.0 || arrives <= 0.0) continue;
    const double square = d.squaredNorm();
    w.segments.push_back({x.position, y.position, normal_i, normal_j});
    w.weights.push_back(x.weight * y.weight * leaves * arrives / (square * square));
  }
}

SampledVisibility VisibilitySampler::operator()(Index i, Index j, int side, Workspace& w) const {
  generate(i, j, side, w);
  const std::size_t n = w.segments.size();
  if (n == 0) return {0.5, 0.5, 0};  // a sliver that no pair of points found: nothing is known
  w.blocked.resize(n);
  rays_.occluded(w.segments, w.blocked);
  return estimated_visibility(w.weights, w.blocked);
}

SampledVisibility estimated_visibility(std::span<const double> weights, std::span<const std::uint8_t> blocked) {
  double all = 0.0, clear = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    all += weights[k];
    squares += weights[k] * weights[k];
    if (blocked[k] == 0) clear += weights[k];
  }
  const double mean = all / static_cast<double>(weights.size()), cautious = (clear + mean) / (all + 2.0 * mean);
  return {clear / all, std::sqrt(cautious * (1.0 - cautious) * squares) / all, static_cast<int>(weights.size())};
}

int rays_per_side(int rays, double form_factor) {
  const int side = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(std::max(rays, 4)))));
  return form_factor > 0.03 ? 4 * side : form_factor > 0.004 ? 2 * side : side;
}

}  // namespace interflect::fem
