#include "results/factors.h"

#include <bit>

#include "core/format.h"

namespace interflect::results {

namespace {

/// Two lanes of 64 bits, each word stirred into both: MurmurHash3's finaliser over a multiply-and-rotate chain.
class Digest {
 public:
  void add(std::uint64_t word) {
    a_ = stir(a_ ^ word * 0x9E3779B97F4A7C15u);
    b_ = stir(std::rotl(b_, 29) + word * 0xC2B2AE3D27D4EB4Fu + a_);
  }
  void add(const Vec3& x) {
    for (int axis = 0; axis < 3; ++axis) add(std::bit_cast<std::uint64_t>(x[axis] + 0.0));  // -0 is 0
  }
  std::string text() const {
    return core::format("%016llx%016llx", static_cast<unsigned long long>(a_), static_cast<unsigned long long>(b_));
  }

 private:
  static std::uint64_t stir(std::uint64_t h) {
    h = (h ^ (h >> 33)) * 0xFF51AFD7ED558CCDu;
    h = (h ^ (h >> 33)) * 0xC4CEB9FE1A85EC53u;
    return h ^ (h >> 33);
  }

  std::uint64_t a_ = 1, b_ = 2;
};

}  // namespace

FactorElements factor_elements(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches) {
  FactorElements out;
  for (const scene::SurfacePatch& patch : patches) {
    out.area.push_back(patch.area);
    out.normal.push_back(patch.normal());
    out.centroid.push_back(patch.centroid());
    out.name.push_back(scene.side_name(patch.surface, patch.side));
  }
  return out;
}

std::string geometry_digest(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches) {
  Digest digest;
  digest.add(scene.facets.size());
  for (const scene::Facet& facet : scene.facets)
    for (const Vec3& corner : facet.corner) digest.add(corner);
  digest.add(patches.size());
  for (const scene::SurfacePatch& patch : patches) {
    digest.add(patch.corners | std::uint64_t{patch.side == scene::Side::back} << 8);
    for (const Vec3& corner : patch.ring()) digest.add(corner);
  }
  return digest.text();
}

}  // namespace interflect::results
