#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

/// What a ray sees: the scene's facets as they were given, never an element mesh.
namespace interflect::raycast {

/// From `origin` along the unit vector `direction`.  A ray that leaves a surface says so by the surface's unit normal
/// on the side it leaves from; zero where it starts in free space.
struct Ray {
  Vec3 origin, direction;
  Vec3 leaves = Vec3::Zero();
};

/// Between two points.  An end that lies on a surface gives the unit normal of the side it is seen from; else zero.
struct Segment {
  Vec3 from, to;
  Vec3 from_normal = Vec3::Zero(), to_normal = Vec3::Zero();
};

/// Offset rule, for every implementation: an origin that lies on a surface is moved by `offset()` along the normal of
/// the side it leaves from, and there is no other epsilon (tnear = 0).  The price: of light that grazes a perpendicular
/// wall from a strip of width h beside it, a part of about 0.21 offset/h is lost; and two surfaces closer than
/// `offset()` see through each other.
class RayCaster {
 public:
  virtual ~RayCaster() = default;
  virtual std::string name() const = 0;

  /// What the ray meets first; its position recomputed in double precision on the facet's plane.
  virtual std::optional<scene::SurfacePoint> closest(const Ray& ray) const = 0;
  /// The same of many rays: hits[k] of rays[k].  By default one after the other.
  /// @param hits  overwritten; no fewer than rays
  virtual void closest_each(std::span<const Ray> rays, std::span<std::optional<scene::SurfacePoint>> hits) const;
  /// All that the ray meets, in the order of their distance, facets at the same place in the order of the scene;
  /// positions as in `closest`. A line through an edge that two facets share may meet both.  By default one `closest`
  /// after the other, each hit being left through its other side: of surfaces closer to each other than `offset()` some
  /// are missed; the scene's own casters miss none.
  /// @param hits  overwritten
  virtual void all(const Ray& ray, std::vector<scene::SurfacePoint>& hits) const;
  /// Is there anything strictly between the ends?
  virtual bool occluded(const Segment& segment) const = 0;
  /// The same for many segments, eight at a time: blocked[k] is 1 or 0.
  virtual void occluded(std::span<const Segment> segments, std::span<std::uint8_t> blocked) const = 0;

  virtual double offset() const = 0;  ///< [m]
};

/// By name: "embree" (single precision, fast) or "brute" (double precision, every facet; for checking).
/// The scene must outlive the caster, which reads the facets' corners in double precision.
/// @throws core::InputError  with the names known
std::unique_ptr<RayCaster> make_ray_caster(const std::string& name, const scene::Scene& scene);
std::vector<std::string> ray_caster_names();

}  // namespace interflect::raycast
