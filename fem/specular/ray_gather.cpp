#include "fem/specular/ray_gather.h"

#include "core/hemisphere.h"

namespace interflect::fem {

RayGather::RayGather(const measure::PointIrradiance& at, const SpecularChains& chains, const mesh::ElementMesh& mesh,
                     std::uint64_t seed, std::uint64_t key, int side)
    : rays_(static_cast<std::uint64_t>(side) * static_cast<std::uint64_t>(side)) {
  const double share = 1 / static_cast<double>(rays_);
  const core::Frame frame = core::frame_around(at.normal);
  core::RandomNumbers random(core::derived_seed(seed, "gather by rays"), 0, key);
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const double u = (row + random.next()) / side, v = (column + random.next()) / side;
      const Vec3 way = frame.to_world(core::cosine_hemisphere(u, v)).normalized();
      const SpecularChains::End end = chains.follow({at.position, way, at.on ? at.normal : Vec3(Vec3::Zero())});
      if (const auto element = end.at ? mesh.locate(*end.at) : std::nullopt)
        met_.push_back({element->element.value, share * end.weight});
    }
}

Spectrum RayGather::irradiance(std::span<const Spectrum> radiosity) const {
  Spectrum sum;
  for (const Met& met : met_) sum += met.weight * radiosity[met.element];
  return sum;
}

/// s² / n, s² = n / (n - 1) (mean of squares - square of the mean); of n w_k B_k.
Spectrum RayGather::noise(std::span<const Spectrum> radiosity) const {
  const auto n = static_cast<double>(rays_);
  Spectrum squares;
  for (const Met& met : met_) {
    const Spectrum one = n * (met.weight * radiosity[met.element]);
    squares += one * one;
  }
  const Spectrum mean = irradiance(radiosity);
  return sqrt(max((squares / n - mean * mean) / (n - 1), Spectrum::zero()));
}

}  // namespace interflect::fem
