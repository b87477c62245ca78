#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cfenv>
#include <limits>
#include <mutex>
#include <new>

#include "core/error.h"
#include "raycast/casters.h"
#include "raycast/scene_frame.h"

namespace interflect::raycast {

namespace {

/// Of the scene's largest dimension: 128 units of a coordinate's last place.
constexpr double relative_offset = 0x1p-18;
constexpr unsigned every_mask = ~0u;
constexpr std::size_t lanes = 8;

/// Building leaves the caller's floating point modes (rounding, flushing of denormals) as they were.
class KeepFloatingPointModes {
 public:
  KeepFloatingPointModes() { std::fegetenv(&modes_); }
  ~KeepFloatingPointModes() { std::fesetenv(&modes_); }
  KeepFloatingPointModes(const KeepFloatingPointModes&) = delete;
  KeepFloatingPointModes& operator=(const KeepFloatingPointModes&) = delete;

 private:
  std::fenv_t modes_{};
};

template <class Handle, void (*release)(Handle*)>
struct Release {
  void operator()(Handle* handle) const { release(handle); }
};
using Device = std::unique_ptr<RTCDeviceTy, Release<RTCDeviceTy, rtcReleaseDevice>>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, Release<RTCSceneTy, rtcReleaseScene>>;

void require_no_error(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  if (error != RTC_ERROR_NONE) throw std::runtime_error("Embree error " + std::to_string(static_cast<int>(error)));
}

/// Coordinates about the scene's centre, its largest dimension being 1: Embree computes in single precision.
class ToUnitBox {
 public:
  explicit ToUnitBox(const SceneFrame& frame)
      : centre_(frame.centre), scale_(1 / frame.size), offset_(frame.offset(relative_offset) / frame.size) {}

  Vec3 operator()(const Vec3& x) const { return (x - centre_) * scale_; }
  Vec3 operator()(const Vec3& x, const Vec3& leaves) const { return (x - centre_) * scale_ + offset_ * leaves; }

 private:
  Vec3 centre_;
  double scale_, offset_;
};

/// A facet that a ray meets.
struct Crossing {
  double t;
  std::uint32_t facet;
  float u, v;
};

/// What `all` hands through Embree to its filter: the context must come first.
struct Gathering {
  RTCIntersectContext context;
  std::vector<Crossing>& met;
};

/// Takes every crossing down and refuses it, so that the traversal goes on to the last.
void gather(const RTCFilterFunctionNArguments* at) {
  auto& gathering = *reinterpret_cast<Gathering*>(at->context);  // NOLINT: Embree's way to extend a context
  const unsigned n = at->N;
  for (unsigned k = 0; k < n; ++k) {
    if (at->valid[k] == 0) continue;
    gathering.met.push_back({RTCRayN_tfar(at->ray, n, k), RTCHitN_primID(at->hit, n, k), RTCHitN_u(at->hit, n, k),
                             RTCHitN_v(at->hit, n, k)});
    at->valid[k] = 0;
  }
}

class EmbreeCaster final : public RayCaster {
 public:
  explicit EmbreeCaster(const scene::Scene& scene)
      : facets_(scene.facets), frame_(frame_of(scene)), to_unit_(frame_), device_(rtcNewDevice(nullptr)) {
    if (!device_) require_no_error(nullptr);
    const KeepFloatingPointModes keep;
    bvh_.reset(rtcNewScene(device_.get()));
    rtcSetSceneFlags(bvh_.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(bvh_.get(), RTC_BUILD_QUALITY_MEDIUM);
    if (!facets_.empty()) attach_facets();
    rtcCommitScene(bvh_.get());
    require_no_error(device_.get());
  }

  std::string name() const override { return "embree"; }
  double offset() const override { return frame_.offset(relative_offset); }

  std::optional<scene::SurfacePoint> closest(const Ray& ray) const override {
    RTCRayHit query = query_from(ray);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(bvh_.get(), &context, &query);
    return hit_of(query, ray);
  }

  /// Eight at a time, which Embree is quicker at than one by one even where they go anywhere.
  void closest_each(std::span<const Ray> rays, std::span<std::optional<scene::SurfacePoint>> hits) const override {
    if (hits.size() < rays.size()) throw core::PreconditionError("closest_each: one answer per ray expected");
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit8 query;
    set_alike(query.ray);
    in_packets(
        rays, query, [&](const int* valid) { rtcIntersect8(valid, bvh_.get(), &context, &query); },
        [&](std::size_t k, std::size_t lane) { hits[k] = hit_of(query.hit, lane, rays[k]); });
  }

  void all(const Ray& ray, std::vector<scene::SurfacePoint>& hits) const override {
    std::call_once(filtered_once_, [this] { filtered_ = filtered_scene(); });
    std::vector<Crossing> met;
    Gathering gathering{{}, met};
    rtcInitIntersectContext(&gathering.context);
    gathering.context.filter = gather;
    RTCRayHit query = query_from(ray);
    rtcIntersect1(filtered_.get(), &gathering.context, &query);
    for (Crossing& crossing : met) crossing.t = distance(ray, crossing);
    std::ranges::sort(met, {}, [](const Crossing& crossing) { return std::pair(crossing.t, crossing.facet); });
    hits.clear();
    for (const auto& [t, facet, u, v] : met) hits.push_back(surface_point(facets_[facet], facet, ray.direction, u, v));
  }

  bool occluded(const Segment& segment) const override {
    // The direction is the whole segment, from offset end to offset end: it runs over t in [0, 1].
    const Vec3 from = to_unit_(segment.from, segment.from_normal), to = to_unit_(segment.to, segment.to_normal);
    RTCRay query = ray_from(from, to - from, 1.0F);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(bvh_.get(), &context, &query);
    return query.tfar < 0;
  }

  void occluded(std::span<const Segment> segments, std::span<std::uint8_t> blocked) const override {
    if (blocked.size() < segments.size()) throw core::PreconditionError("occluded: one answer per segment expected");
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay8 query;
    set_alike(query);
    in_packets(
        segments, query, [&](const int* valid) { rtcOccluded8(valid, bvh_.get(), &context, &query); },
        [&](std::size_t k, std::size_t lane) { blocked[k] = query.tfar[lane] < 0; });
  }

 private:
  static RTCRay ray_from(const Vec3& origin, const Vec3& direction, float tfar) {
    const Eigen::Vector3f o = origin.cast<float>(), d = direction.cast<float>();
    return {o.x(), o.y(), o.z(), 0, d.x(), d.y(), d.z(), 0, tfar, every_mask, 0, 0};
  }

  RTCRayHit query_from(const Ray& ray) const {
    RTCRayHit query;
    query.ray = ray_from(to_unit_(ray.origin, ray.leaves), ray.direction, std::numeric_limits<float>::infinity());
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return query;
  }

  std::optional<scene::SurfacePoint> hit_of(const RTCRayHit& answer, const Ray& ray) const {
    const RTCHit& hit = answer.hit;
    if (hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return surface_point(facets_[hit.primID], hit.primID, ray.direction, hit.u, hit.v);
  }

  std::optional<scene::SurfacePoint> hit_of(const RTCHit8& hit, std::size_t lane, const Ray& ray) const {
    if (hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const unsigned facet = hit.primID[lane];
    return surface_point(facets_[facet], facet, ray.direction, hit.u[lane], hit.v[lane]);
  }

  /// Packet by packet: all lanes are set, `trace` gets those that are valid, and `answer` item k and its lane.  Of the
  /// last packet, lanes without an item of their own repeat one and are not valid.
  template <class Item, class Query, class Trace, class Answer>
  void in_packets(std::span<const Item> items, Query& query, const Trace& trace, const Answer& answer) const {
    alignas(32) std::array<int, lanes> valid;
    valid.fill(-1);
    for (std::size_t first = 0; first < items.size(); first += lanes) {
      const std::size_t used = std::min(lanes, items.size() - first);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        if (lane >= used) valid[lane] = 0;
        set_lane(query, lane, items[first + (lane < used ? lane : 0)]);
      }
      trace(valid.data());
      for (std::size_t lane = 0; lane < used; ++lane) answer(first + lane, lane);
    }
  }

  void set_lane(RTCRayHit8& query, std::size_t lane, const Ray& ray) const {
    set_lane(query.ray, lane, to_unit_(ray.origin, ray.leaves), ray.direction, std::numeric_limits<float>::infinity());
    query.hit.geomID[lane] = query.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
  }

  void set_lane(RTCRay8& query, std::size_t lane, const Segment& segment) const {
    const Vec3 from = to_unit_(segment.from, segment.from_normal), to = to_unit_(segment.to, segment.to_normal);
    set_lane(query, lane, from, to - from, 1.0F);
  }

  static void set_lane(RTCRay8& query, std::size_t lane, const Vec3& origin, const Vec3& direction, float tfar) {
    query.org_x[lane] = static_cast<float>(origin.x());
    query.org_y[lane] = static_cast<float>(origin.y());
    query.org_z[lane] = static_cast<float>(origin.z());
    query.dir_x[lane] = static_cast<float>(direction.x());
    query.dir_y[lane] = static_cast<float>(direction.y());
    query.dir_z[lane] = static_cast<float>(direction.z());
    query.tfar[lane] = tfar;
  }

  /// What all packets have, and Embree leaves as it is.
  static void set_alike(RTCRay8& query) {
    std::ranges::fill(query.tnear, 0.0F);
    std::ranges::fill(query.time, 0.0F);
    std::ranges::fill(query.mask, every_mask);
    std::ranges::fill(query.id, 0u);
    std::ranges::fill(query.flags, 0u);
  }

  /// Along the ray to the facet's plane, in double precision but where the ray grazes it: single precision does not
  /// tell the order of close surfaces.
  double distance(const Ray& ray, const Crossing& at) const {
    const scene::Facet& facet = facets_[at.facet];
    const double cosine = facet.normal.dot(ray.direction);
    if (std::abs(cosine) < 1e-6) return at.t * frame_.size;
    return facet.normal.dot(facet.corner[0] - ray.origin) / cosine;
  }

  /// The same facets once more: a hierarchy that asks filters is slower, and only `all` pays for it.
  EmbreeScene filtered_scene() const {
    const KeepFloatingPointModes keep;
    EmbreeScene scene(rtcNewScene(device_.get()));
    rtcSetSceneFlags(scene.get(),
                     static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    if (!facets_.empty()) rtcAttachGeometry(scene.get(), rtcGetGeometry(bvh_.get(), 0));
    rtcCommitScene(scene.get());
    require_no_error(device_.get());
    return scene;
  }

  void attach_facets() {
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    const auto buffer = [&](RTCBufferType type, RTCFormat format, std::size_t items) {
      void* data = rtcSetNewGeometryBuffer(geometry, type, 0, format, 3 * sizeof(float), items);
      require_no_error(device_.get());
      return data;
    };
    // Corners are not shared: equal corners become equal floats, which is all that watertightness asks for.
    auto* x = static_cast<float*>(buffer(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 3 * facets_.size()));
    auto* corner_index = static_cast<unsigned*>(buffer(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, facets_.size()));
    for (const scene::Facet& facet : facets_)
      for (const Vec3& corner : facet.corner)
        for (const double coordinate : to_unit_(corner)) *x++ = static_cast<float>(coordinate);
    for (unsigned i = 0; i < 3 * facets_.size(); ++i) corner_index[i] = i;
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(bvh_.get(), geometry);
    rtcReleaseGeometry(geometry);
  }

  std::span<const scene::Facet> facets_;
  SceneFrame frame_;
  ToUnitBox to_unit_;
  Device device_;
  EmbreeScene bvh_;
  mutable std::once_flag filtered_once_;
  mutable EmbreeScene filtered_;  ///< made by the first `all`
};

}  // namespace

std::unique_ptr<RayCaster> make_embree_caster(const scene::Scene& scene) {
  return std::make_unique<EmbreeCaster>(scene);
}

}  // namespace interflect::raycast
