#include <algorithm>
#include <limits>

#include "core/error.h"
#include "raycast/casters.h"
#include "raycast/scene_frame.h"

namespace interflect::raycast {

namespace {

constexpr double relative_offset = 1e-10;  ///< of the scene's largest dimension

struct Crossing {
  double t, u, v;
};

/// Where o + t d crosses a triangle whose corners a, b, c are given relative to o.
///
/// With the signed volumes w_a = d . (b x c), w_b = d . (c x a), w_c = d . (a x b), the line passes through the
/// triangle if they have one sign; they are its barycentric coordinates times their sum.  Two triangles that share an
/// edge compute its volume from the same products and differ in sign alone (a x b = -(b x a) bit by bit, without
/// contraction), and 0 counts as inside: no ray passes between them.  Source: Pluecker test, as in [Woop, Benthin, Wald
/// 2013], section 2.
std::optional<Crossing> cross(const Vec3& d, const Vec3& a, const Vec3& b, const Vec3& c) {
  const double w_a = d.dot(b.cross(c)), w_b = d.dot(c.cross(a)), w_c = d.dot(a.cross(b));
  const bool positive = w_a >= 0 && w_b >= 0 && w_c >= 0, negative = w_a <= 0 && w_b <= 0 && w_c <= 0;
  const double sum = w_a + w_b + w_c;
  if ((!positive && !negative) || sum == 0) return std::nullopt;
  const double u = w_b / sum, v = w_c / sum;
  return Crossing{(a + u * (b - a) + v * (c - a)).dot(d) / d.squaredNorm(), u, v};
}

class BruteCaster final : public RayCaster {
 public:
  explicit BruteCaster(const scene::Scene& scene) : facets_(scene.facets), frame_(frame_of(scene)) {
    corners_.reserve(facets_.size());
    for (const scene::Facet& facet : facets_)
      corners_.push_back(
          {facet.corner[0] - frame_.centre, facet.corner[1] - frame_.centre, facet.corner[2] - frame_.centre});
  }

  std::string name() const override { return "brute"; }
  double offset() const override { return frame_.offset(relative_offset); }

  std::optional<scene::SurfacePoint> closest(const Ray& ray) const override {
    const Vec3 origin = local(ray.origin, ray.leaves);
    Crossing nearest{std::numeric_limits<double>::infinity(), 0, 0};
    std::size_t hit = corners_.size();
    for (std::size_t i = 0; i < corners_.size(); ++i)
      if (const auto at = crossing(i, origin, ray.direction); at && at->t > 0 && at->t < nearest.t)
        nearest = *at, hit = i;
    if (hit == corners_.size()) return std::nullopt;
    return surface_point(facets_[hit], static_cast<std::uint32_t>(hit), ray.direction, nearest.u, nearest.v);
  }

  void all(const Ray& ray, std::vector<scene::SurfacePoint>& hits) const override {
    const Vec3 origin = local(ray.origin, ray.leaves);
    std::vector<std::pair<Crossing, std::size_t>> met;
    for (std::size_t i = 0; i < corners_.size(); ++i)
      if (const auto at = crossing(i, origin, ray.direction); at && at->t > 0) met.emplace_back(*at, i);
    std::stable_sort(met.begin(), met.end(), [](const auto& a, const auto& b) { return a.first.t < b.first.t; });
    hits.clear();
    for (const auto& [at, i] : met)
      hits.push_back(surface_point(facets_[i], static_cast<std::uint32_t>(i), ray.direction, at.u, at.v));
  }

  bool occluded(const Segment& segment) const override {
    const Vec3 from = local(segment.from, segment.from_normal), along = local(segment.to, segment.to_normal) - from;
    for (std::size_t i = 0; i < corners_.size(); ++i)
      if (const auto at = crossing(i, from, along); at && at->t > 0 && at->t < 1) return true;
    return false;
  }

  void occluded(std::span<const Segment> segments, std::span<std::uint8_t> blocked) const override {
    if (blocked.size() < segments.size()) throw core::PreconditionError("occluded: one answer per segment expected");
    for (std::size_t i = 0; i < segments.size(); ++i) blocked[i] = occluded(segments[i]);
  }

 private:
  Vec3 local(const Vec3& x, const Vec3& leaves) const { return x - frame_.centre + offset() * leaves; }
  std::optional<Crossing> crossing(std::size_t i, const Vec3& origin, const Vec3& direction) const {
    const auto& [a, b, c] = corners_[i];
    return cross(direction, a - origin, b - origin, c - origin);
  }

  std::span<const scene::Facet> facets_;
  SceneFrame frame_;
  std::vector<std::array<Vec3, 3>> corners_;  ///< about the scene's centre
};

}  // namespace

std::unique_ptr<RayCaster> make_brute_caster(const scene::Scene& scene) { return std::make_unique<BruteCaster>(scene); }

}  // namespace interflect::raycast
