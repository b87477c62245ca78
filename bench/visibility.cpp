// How close the visibility stage of assembly comes to its rays alone: the same segments in the same order, first
// recorded, then cast (a) by the stage itself, which makes points and weights, casts, and estimates; (b) by the caster
// from the record, in the stage's batches; (c) the same, one segment at a time; (d) by a bare Embree loop over packets
// of eight made beforehand, without any of our code.  Interleaved rounds, medians of CPU time, one thread.
//
// And what assembly of constants does beside, all in all: its time less that of as many rays of that stage, by the
// pairs that exchange something; and, less the unoccluded integrals of near pairs, by those that are farther apart than
// they are large.
//
//   bench_visibility [SCENE [ELEMENTS [RAYS]]]      default: data/scenes/office.json 1500 16

#include <embree3/rtcore.h>
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/run.h"
#include "fem/form_factor/blockers.h"
#include "fem/form_factor/method.h"
#include "fem/form_factor/pair_integral.h"
#include "fem/form_factor/visibility.h"
#include "mesh/uniform.h"
#include "scene/reader.h"

using namespace interflect;

namespace {

constexpr int rounds = 9;
constexpr std::size_t most_rays = 1'000'000;

struct Pair {
  Index i, j;
  fem::Effort effort;
};

/// Pairs that orientation and shafts leave to the rays, in the order of assembly, until there are rays enough.
std::vector<Pair> sampled_pairs(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches, int rays) {
  const fem::PairIntegrator integrate(patches, 1e-2);
  const fem::Blockers blockers(scene, integrate.shapes().origin(), integrate.shapes().plane_tolerance());
  std::vector<Pair> pairs;
  std::size_t count = 0;
  const auto n = static_cast<Index>(patches.size());
  for (Index i = 0; i < n && count < most_rays; i += 7)  // every seventh row: all kinds of places
    for (Index j = i + 1; j < n && count < most_rays; ++j) {
      const fem::PairIntegral K = integrate(i, j);
      if (K.facing != fem::Facing::full) continue;
      const fem::ElementShape &a = integrate.shapes()[i], &b = integrate.shapes()[j];
      if (!blockers.any(geometry::Shaft(a.ring(), b.ring()))) continue;
      pairs.push_back({i, j, fem::effort_for(K.value / std::min(a.area, b.area))});
      count += static_cast<std::size_t>(rays) << 2 * static_cast<int>(pairs.back().effort);
    }
  return pairs;
}

/// Pairs that exchange something and are not farther apart than they are large.
std::vector<std::pair<Index, Index>> near_pairs(const fem::PairIntegrator& integrate, Index elements) {
  std::vector<std::pair<Index, Index>> pairs;
  for (Index i = 0; i < elements; ++i)
    for (Index j = i + 1; j < elements; ++j) {
      const fem::ElementShape &a = integrate.shapes()[i], &b = integrate.shapes()[j];
      if ((a.centroid - b.centroid).norm() <= 2 * (a.radius + b.radius) && integrate(i, j).facing != fem::Facing::away)
        pairs.emplace_back(i, j);
    }
  return pairs;
}

/// Nowhere.
struct NoSink final : fem::ExchangeSink {
  void add(Index, Index, const fem::ExchangeEntry&) override {}
};

/// The facets in Embree and the segments as packets, about the scene's centre, in single precision.
class BareEmbree {
 public:
  BareEmbree(const scene::Scene& scene, std::span<const raycast::Segment> segments, double offset)
      : device_(rtcNewDevice(nullptr)) {
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    const std::size_t n = scene.facets.size();
    const Vec3 centre = scene.box().center();
    auto* corner =
        static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3 * n));
    auto* index =
        static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, n));
    for (unsigned k = 0; k < 3 * n; ++k) {
      index[k] = k;
      const Vec3 p = scene.facets[k / 3].corner[k % 3] - centre;
      for (Index axis = 0; axis < 3; ++axis) corner[3 * k + static_cast<unsigned>(axis)] = static_cast<float>(p[axis]);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
    packets_.resize(segments.size() / 8);
    for (std::size_t k = 0; k < 8 * packets_.size(); ++k) {
      const Vec3 from = segments[k].from + offset * segments[k].from_normal - centre,
                 to = segments[k].to + offset * segments[k].to_normal - centre;
      set(packets_[k / 8], k % 8, from, to - from);
    }
  }
  ~BareEmbree() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  BareEmbree(const BareEmbree&) = delete;
  BareEmbree& operator=(const BareEmbree&) = delete;

  std::size_t cast() const {
    alignas(32) const int valid[8] = {-1, -1, -1, -1, -1, -1, -1, -1};
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    std::size_t blocked = 0;
    for (const RTCRay8& packet : packets_) {
      RTCRay8 query = packet;
      rtcOccluded8(valid, scene_, &context, &query);
      for (float t : query.tfar) blocked += t < 0;
    }
    return blocked;
  }
  std::size_t rays() const { return 8 * packets_.size(); }

 private:
  static void set(RTCRay8& r, std::size_t lane, const Vec3& from, const Vec3& along) {
    r.org_x[lane] = static_cast<float>(from.x()), r.org_y[lane] = static_cast<float>(from.y()),
    r.org_z[lane] = static_cast<float>(from.z());
    r.dir_x[lane] = static_cast<float>(along.x()), r.dir_y[lane] = static_cast<float>(along.y()),
    r.dir_z[lane] = static_cast<float>(along.z());
    r.tnear[lane] = r.time[lane] = 0;
    r.tfar[lane] = 1;
    r.mask[lane] = ~0u;
    r.id[lane] = r.flags[lane] = 0;
  }

  RTCDevice device_;
  RTCScene scene_;
  std::vector<RTCRay8> packets_;
};

template <class Work>
double seconds(const Work& work) {
  timespec from{}, to{};  // of this thread: what else the machine does is not counted
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &from);
  work();
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &to);
  return double(to.tv_sec - from.tv_sec) + 1e-9 * double(to.tv_nsec - from.tv_nsec);
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

}  // namespace

int main(int argc, char** argv) try {
  const scene::Scene scene = scene::read_scene(argc > 1 ? argv[1] : INTERFLECT_SOURCE_DIR "/data/scenes/office.json");
  const mesh::ElementMesh mesh = mesh::uniform(scene, mesh::edge_for(scene, argc > 2 ? std::atof(argv[2]) : 1500));
  const auto rays = raycast::make_ray_caster("embree", scene);
  const int rays_per_pair = argc > 3 ? std::atoi(argv[3]) : 16;
  const fem::VisibilitySampler sampler(mesh.patches(), *rays, rays_per_pair, 1);
  const std::vector<Pair> pairs = sampled_pairs(scene, mesh.patches(), rays_per_pair);
  fem::VisibilitySampler::Workspace workspace;
  std::vector<raycast::Segment> segments;
  std::vector<std::size_t> first = {0};  // of each pair, in `segments`
  for (const Pair& p : pairs) {
    sampler.generate(p.i, p.j, p.effort, workspace);
    segments.insert(segments.end(), workspace.segments.begin(), workspace.segments.end());
    first.push_back(segments.size());
  }
  std::vector<std::uint8_t> blocked(segments.size());
  const BareEmbree embree(scene, segments, rays->offset());
  std::size_t blocked_by_embree = 0;
  std::vector<double> stage, batches, single, bare;
  double visible = 0;
  for (int round = 0; round < rounds; ++round) {
    stage.push_back(seconds([&] {
      for (const Pair& p : pairs) visible += sampler(p.i, p.j, p.effort, workspace).visible;
    }));
    batches.push_back(seconds([&] {
      for (std::size_t k = 0; k + 1 < first.size(); ++k)
        rays->occluded(std::span(segments).subspan(first[k], first[k + 1] - first[k]),
                       std::span(blocked).subspan(first[k]));
    }));
    bare.push_back(seconds([&] { blocked_by_embree = embree.cast(); }));
    single.push_back(seconds([&] {
      for (std::size_t k = 0; k < segments.size(); ++k) blocked[k] = rays->occluded(segments[k]) ? 1 : 0;
    }));
  }
  const double n = static_cast<double>(segments.size()), whole = median(stage) / n, cast = median(batches) / n;
  const double packets = median(bare) / static_cast<double>(embree.rays());
  std::printf("%td elements, %zu pairs, %.0f rays (%.1f %% blocked; bare Embree %.1f %%), mean V %.3f\n", mesh.size(),
              pairs.size(), n, 100.0 * static_cast<double>(std::count(blocked.begin(), blocked.end(), 1)) / n,
              100.0 * static_cast<double>(blocked_by_embree) / static_cast<double>(embree.rays()),
              visible / rounds / static_cast<double>(pairs.size()));
  std::printf("stage %4.0f, caster in batches %4.0f, one by one %4.0f, bare Embree %4.0f ns a ray\n", whole * 1e9,
              cast * 1e9, median(single) / n * 1e9, packets * 1e9);
  std::printf("the stage reaches %.0f %% of the caster's rate and %.0f %% of bare Embree's (limit 60)\n",
              100 * cast / whole, 100 * packets / whole);

  const auto method =
      fem::make_form_factor_method("gauss-lambert", {scene, mesh.patches(), *rays, 1, 1e-3, rays_per_pair});
  const fem::ElementBlock all{mesh.patches(), 0, mesh.size()};
  core::LocalRun run(1, 1);
  NoSink nowhere;
  fem::PairCounts counts;
  const fem::PairIntegrator integrate(mesh.patches(), 1e-3);
  const auto near = near_pairs(integrate, mesh.size());
  std::vector<double> assembly, of_near;
  double sum = 0;
  for (int round = 0; round < rounds; ++round) {
    assembly.push_back(seconds([&] { counts = method->exchange(all, all, nowhere, run.get()); }));
    of_near.push_back(seconds([&] {
      for (const auto& [i, j] : near) sum += integrate(i, j).value;
    }));
  }
  const double exchanging = static_cast<double>(counts.clear + counts.sampled),
               close = static_cast<double>(near.size()), by_rays = whole * static_cast<double>(counts.rays),
               rest = median(assembly) - by_rays;
  std::printf("assembly: %.2g pairs exchange something, %.0f %% of them by rays, which take %.0f %% of the time\n",
              exchanging, 100.0 * static_cast<double>(counts.sampled) / exchanging, 100 * by_rays / median(assembly));
  std::printf("all the rest: %.2f microseconds each, of the %.0f %% that are separated %.2f (limit 0.5)\n",
              1e6 * rest / exchanging, 100 * (1 - close / exchanging),
              1e6 * (rest - median(of_near)) / (exchanging - close));
  if (!(sum > 0)) return 1;
} catch (const core::InputError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
