#pragma once

#include <embree3/rtcore.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <span>
#include <vector>

#include "raycast/ray_caster.h"
#include "scene/scene.h"

/// The rays that something casts, and what Embree alone takes for the same ones.
namespace interflect::bench {

inline double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Of this thread: what else the machine does is not counted.
template <class Work>
double processor_seconds(const Work& work) {
  timespec from{}, to{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &from);
  work();
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &to);
  return double(to.tv_sec - from.tv_sec) + 1e-9 * double(to.tv_nsec - from.tv_nsec);
}

inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Passes every question on, and keeps a copy in the order asked.
class Recorder final : public raycast::RayCaster {
 public:
  explicit Recorder(const raycast::RayCaster& caster) : caster_(caster) {}
  std::string name() const override { return "recorder"; }
  std::optional<scene::SurfacePoint> closest(const raycast::Ray& ray) const override {
    order.push_back(true), rays.push_back(ray);
    return caster_.closest(ray);
  }
  bool occluded(const raycast::Segment& segment) const override {
    order.push_back(false), segments.push_back(segment);
    return caster_.occluded(segment);
  }
  void occluded(std::span<const raycast::Segment> asked, std::span<std::uint8_t> blocked) const override {
    order.insert(order.end(), asked.size(), false);
    segments.insert(segments.end(), asked.begin(), asked.end());
    caster_.occluded(asked, blocked);
  }
  double offset() const override { return caster_.offset(); }

  mutable std::vector<bool> order;  ///< true: a ray; false: a segment
  mutable std::vector<raycast::Ray> rays;
  mutable std::vector<raycast::Segment> segments;

 private:
  const raycast::RayCaster& caster_;
};

/// Embree and nothing else: the scene's facets about their centre, rays already in single precision.
class BareEmbree {
 public:
  BareEmbree(const scene::Scene& scene, const Recorder& recorded, double offset)
      : BareEmbree(scene, recorded.rays, recorded.segments, offset) {
    order_ = recorded.order;
  }
  /// @param offset  of surfaces, from which rays and segments start [m]
  BareEmbree(const scene::Scene& scene, std::span<const raycast::Ray> rays, std::span<const raycast::Segment> segments,
             double offset) {
    const geometry::Box box = scene.box();
    centre_ = box.center(), scale_ = 1 / box.sizes().maxCoeff();
    add_facets(scene);
    for (const auto& ray : rays) rays_.push_back(make(ray.origin + offset * ray.leaves, ray.direction, 1e30F));
    for (const auto& s : segments) {
      const Vec3 from = s.from + offset * s.from_normal, to = s.to + offset * s.to_normal;
      segments_.push_back(make(from, (to - from) * scale_, 1));
    }
    fill_packets();
  }
  ~BareEmbree() { rtcReleaseScene(bvh_), rtcReleaseDevice(device_); }
  BareEmbree(const BareEmbree&) = delete;
  BareEmbree& operator=(const BareEmbree&) = delete;

  std::size_t rays() const { return rays_.size() + segments_.size(); }
  std::size_t in_packets() const { return 8 * packets_.size(); }  ///< segments, but for the few that fill none

  /// Both kinds in the order recorded.
  std::size_t in_order() const {
    std::size_t hits = 0, ray = 0, segment = 0;
    for (const bool is_ray : order_) hits += is_ray ? hit(rays_[ray++]) : blocked(segments_[segment++]);
    return hits;
  }
  std::size_t closest() const {
    std::size_t hits = 0;
    for (const RTCRay& ray : rays_) hits += hit(ray);
    return hits;
  }
  std::size_t occluded() const {
    std::size_t hits = 0;
    for (const RTCRay& segment : segments_) hits += blocked(segment);
    return hits;
  }
  /// @param coherent  as Embree is told: right of segments side by side, twice slower than nothing of those that are not
  std::size_t occluded_by_eight(bool coherent) const {
    std::size_t hits = 0;
    alignas(32) const int valid[8] = {-1, -1, -1, -1, -1, -1, -1, -1};
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (RTCRay8 packet : packets_) {
      rtcOccluded8(valid, bvh_, &context, &packet);
      for (const float tfar : packet.tfar) hits += tfar < 0;
    }
    return hits;
  }

 private:
  void add_facets(const scene::Scene& scene) {
    bvh_ = rtcNewScene(device_);
    rtcSetSceneFlags(bvh_, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    const auto buffer = [&](RTCBufferType type, RTCFormat format, std::size_t items) {
      return rtcSetNewGeometryBuffer(geometry, type, 0, format, 12, items);
    };
    auto* x = static_cast<float*>(buffer(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 3 * scene.facets.size()));
    auto* index = static_cast<unsigned*>(buffer(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, scene.facets.size()));
    for (const scene::Facet& facet : scene.facets)
      for (const Vec3& corner : facet.corner)
        for (int axis = 0; axis < 3; ++axis) *x++ = static_cast<float>((corner[axis] - centre_[axis]) * scale_);
    for (unsigned i = 0; i < 3 * scene.facets.size(); ++i) index[i] = i;
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(bvh_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(bvh_);
  }
  RTCRay make(const Vec3& origin, const Vec3& direction, float tfar) const {
    const Eigen::Vector3f o = ((origin - centre_) * scale_).cast<float>(), d = direction.cast<float>();
    return {o.x(), o.y(), o.z(), 0, d.x(), d.y(), d.z(), 0, tfar, ~0u, 0, 0};
  }
  bool hit(const RTCRay& ray) const {
    RTCRayHit query;
    query.ray = ray;
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(bvh_, &context, &query);
    return query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  }
  bool blocked(RTCRay ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(bvh_, &context, &ray);
    return ray.tfar < 0;
  }
  void fill_packets() {
    packets_.resize(segments_.size() / 8);
    for (std::size_t i = 0; i < 8 * packets_.size(); ++i) {
      const RTCRay& r = segments_[i];
      RTCRay8& p = packets_[i / 8];
      const std::size_t k = i % 8;
      p.org_x[k] = r.org_x, p.org_y[k] = r.org_y, p.org_z[k] = r.org_z, p.tnear[k] = 0;
      p.dir_x[k] = r.dir_x, p.dir_y[k] = r.dir_y, p.dir_z[k] = r.dir_z, p.time[k] = 0;
      p.tfar[k] = 1, p.mask[k] = ~0u, p.id[k] = p.flags[k] = 0;
    }
  }

  std::vector<bool> order_;
  Vec3 centre_;
  double scale_;
  RTCDevice device_ = rtcNewDevice(nullptr);
  RTCScene bvh_;
  std::vector<RTCRay> rays_, segments_;
  std::vector<RTCRay8> packets_;
};

}  // namespace interflect::bench
