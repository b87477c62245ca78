// The path tracer against the rays it traces, and its time for a stated accuracy.
//
//   bench_path_tracer [scene.json]      (default: the Cornell box)
//
// Three tables, one thread each unless said otherwise; rounds are interleaved, and medians printed:
//   1. whole paths a second, and their rays as a fraction of a bare Embree loop over the same rays in the same order,
//      converted to single precision beforehand;
//   2. the caster's own calls on the recorded rays, as a fraction of the same bare loops;
//   3. seconds to 1 % standard error on about 600 elements, two threads.
#include <embree3/rtcore.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>

#include "mesh/uniform.h"
#include "montecarlo/measurement_sampler.h"
#include "montecarlo/path_tracer.h"
#include "scene/reader.h"

namespace {

using namespace interflect;

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
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
  BareEmbree(const scene::Scene& scene, const Recorder& recorded, double offset) : order_(recorded.order) {
    const geometry::Box box = scene.box();
    centre_ = box.center(), scale_ = 1 / box.sizes().maxCoeff();
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
    for (const auto& ray : recorded.rays) rays_.push_back(make(ray.origin + offset * ray.leaves, ray.direction, 1e30F));
    for (const auto& s : recorded.segments) {
      const Vec3 from = s.from + offset * s.from_normal, to = s.to + offset * s.to_normal;
      segments_.push_back(make(from, (to - from) * scale_, 1));
    }
    fill_packets();
  }
  ~BareEmbree() { rtcReleaseScene(bvh_), rtcReleaseDevice(device_); }
  BareEmbree(const BareEmbree&) = delete;
  BareEmbree& operator=(const BareEmbree&) = delete;

  std::size_t rays() const { return order_.size(); }

  /// Both kinds in the order in which the path tracer asked.
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
  std::size_t occluded_by_eight() const {
    std::size_t hits = 0;
    alignas(32) const int valid[8] = {-1, -1, -1, -1, -1, -1, -1, -1};
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (RTCRay8 packet : packets_) {
      rtcOccluded8(valid, bvh_, &context, &packet);
      for (const float tfar : packet.tfar) hits += tfar < 0;
    }
    return hits;
  }

 private:
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

std::vector<measure::Measurement> element_irradiances(const scene::Scene& scene, double elements) {
  const mesh::ElementMesh mesh = mesh::uniform(scene, mesh::edge_for(scene, elements));
  std::vector<measure::Measurement> asked;
  for (const scene::SurfacePatch& patch : mesh.patches()) asked.push_back(measure::PatchIrradiance{patch});
  return asked;
}

void compare_with_bare_embree(const scene::Scene& scene, const std::vector<measure::Measurement>& asked) {
  constexpr int rounds = 7;
  constexpr std::uint64_t samples_each = 200;
  std::vector<montecarlo::MeasurementSampler> samplers;
  for (const auto& measurement : asked) samplers.emplace_back(scene, measurement);
  const auto caster = raycast::make_ray_caster("embree", scene);
  const Recorder recorder(*caster);
  Spectrum sum;
  const auto trace = [&](const raycast::RayCaster& with) {
    const montecarlo::PathEstimator paths(scene, with);
    for (std::uint32_t m = 0; m < samplers.size(); ++m)
      for (std::uint64_t k = 0; k < samples_each; ++k) {
        core::RandomNumbers numbers(1, m, k);
        sum += samplers[m].sample(paths, numbers);
      }
  };
  trace(recorder);
  const BareEmbree bare(scene, recorder, caster->offset());
  std::vector<std::uint8_t> blocked(recorder.segments.size());
  std::size_t hits = 0;
  std::vector<double> paths_s, bare_s, closest_s, bare_closest_s, single_s, bare_single_s, eight_s, bare_eight_s;
  for (int round = 0; round < rounds; ++round) {
    paths_s.push_back(seconds([&] { trace(*caster); }));
    bare_s.push_back(seconds([&] { hits += bare.in_order(); }));
    closest_s.push_back(seconds([&] {
      for (const auto& ray : recorder.rays) hits += caster->closest(ray).has_value();
    }));
    bare_closest_s.push_back(seconds([&] { hits += bare.closest(); }));
    single_s.push_back(seconds([&] {
      for (const auto& segment : recorder.segments) hits += caster->occluded(segment);
    }));
    bare_single_s.push_back(seconds([&] { hits += bare.occluded(); }));
    eight_s.push_back(seconds([&] { caster->occluded(recorder.segments, blocked); }));
    bare_eight_s.push_back(seconds([&] { hits += bare.occluded_by_eight(); }));
  }
  const auto paths = static_cast<double>(samplers.size() * samples_each), rays = static_cast<double>(bare.rays());
  std::printf("one thread: %.2f M paths/s, %.1f rays a path, %.2f M rays/s = %.0f %% of bare Embree's %.2f M rays/s\n",
              1e-6 * paths / median(paths_s), rays / paths, 1e-6 * rays / median(paths_s),
              100 * median(bare_s) / median(paths_s), 1e-6 * rays / median(bare_s));
  const auto line = [](const char* what, std::size_t n, const std::vector<double>& ours,
                       const std::vector<double>& theirs) {
    std::printf("  caster, %-22s %6.2f M/s = %3.0f %% of bare Embree's %6.2f M/s\n", what,
                1e-6 * static_cast<double>(n) / median(ours), 100 * median(theirs) / median(ours),
                1e-6 * static_cast<double>(n) / median(theirs));
  };
  line("closest", recorder.rays.size(), closest_s, bare_closest_s);
  line("occluded", recorder.segments.size(), single_s, bare_single_s);
  line("occluded, eight by eight", recorder.segments.size(), eight_s, bare_eight_s);
  if (hits == 0 || !sum.is_finite()) std::printf("(nothing was hit)\n");
}

void time_to_one_percent(const scene::Scene& scene, const std::vector<measure::Measurement>& asked) {
  core::LocalRun run(1, 2);
  const montecarlo::PathTracer tracer({.target = 0.01, .target_floor = 0});
  const double forecast = tracer.forecast(scene, asked, run);
  std::vector<Estimate> found;
  const std::clock_t before = std::clock();
  const double took = seconds([&] { found = tracer.answer(scene, asked, run); });
  const double processor = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  std::vector<double> relative;
  double samples = 0;
  for (const Estimate& e : found) {
    double variance = 0;  // of the weighted value, channels taken as fully correlated: an upper bound
    for (int c = 0; c < scene.channel_count(); ++c) variance += scene.weights[c] * e.standard_error[c];
    if (scene.weigh(e.value) > 0) relative.push_back(variance / scene.weigh(e.value));
    samples += static_cast<double>(e.samples);
  }
  std::sort(relative.begin(), relative.end());
  std::printf("two threads: 1 %% on %zu elements in %.1f s (forecast %.1f s; processor time %.1f s), %.1f M paths\n",
              asked.size(), took, forecast, processor, 1e-6 * samples);
  std::printf("  relative standard error: median %.2f %%, 95 %% of elements below %.2f %%, largest %.2f %%\n",
              100 * relative[relative.size() / 2], 100 * relative[relative.size() * 95 / 100], 100 * relative.back());
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string file = argc > 1 ? argv[1] : INTERFLECT_SOURCE_DIR "/data/scenes/cornell_box.json";
  const scene::Scene scene = scene::read_scene(file);
  const std::vector<measure::Measurement> asked = element_irradiances(scene, 600);
  std::printf("%s: %zu facets, %zu elements\n", scene.file.filename().c_str(), scene.facets.size(), asked.size());
  compare_with_bare_embree(scene, asked);
  time_to_one_percent(scene, asked);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
