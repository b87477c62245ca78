// How close the visibility stage of assembly comes to its rays alone: the same segments in the same order, first recorded, then cast
// (a) by the stage itself, which makes points and weights, casts, and estimates; (b) by the caster from the record, in the
// stage's batches; (c) the same, one segment at a time.  Interleaved rounds, medians, one thread.
//
//   bench_visibility [SCENE [ELEMENTS [RAYS]]]      default: data/scenes/office.json 1500 16

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/run.h"
#include "fem/form_factor/blockers.h"
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
  int side;
};

/// Pairs that orientation and shafts leave to the rays, in the order of assembly, until there are rays enough.
std::vector<Pair> sampled_pairs(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches, int rays) {
  const fem::PairIntegrator integrate(patches, 1e-2);
  const fem::Blockers blockers(scene, integrate.shapes().origin());
  std::vector<Pair> pairs;
  std::size_t count = 0;
  const auto n = static_cast<Index>(patches.size());
  for (Index i = 0; i < n && count < most_rays; i += 7)  // every seventh row: all kinds of places
    for (Index j = i + 1; j < n && count < most_rays; ++j) {
      const fem::PairIntegral K = integrate(i, j);
      if (K.facing != fem::Facing::full) continue;
      const fem::ElementShape &a = integrate.shapes()[i], &b = integrate.shapes()[j];
      if (!blockers.any(geometry::Shaft(a.ring(), b.ring()))) continue;
      pairs.push_back({i, j, fem::rays_per_side(rays, K.value / std::min(a.area, b.area))});
      count += static_cast<std::size_t>(pairs.back().side * pairs.back().side);
    }
  return pairs;
}

template <class Work>
double seconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
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
  const fem::VisibilitySampler sampler(mesh.patches(), *rays, 1);
  const std::vector<Pair> pairs = sampled_pairs(scene, mesh.patches(), argc > 3 ? std::atoi(argv[3]) : 16);
  fem::VisibilitySampler::Workspace workspace;
  std::vector<raycast::Segment> segments;
  std::vector<std::size_t> first = {0};
  for (const Pair& p : pairs) {
    sampler.generate(p.i, p.j, p.side, workspace);
    segments.insert(segments.end(), workspace.segments.begin(), workspace.segments.end());
    first.push_back(segments.size());
  }
  std::vector<std::uint8_t> blocked(segments.size());
  std::vector<double> stage, batches, single;
  double visible = 0;
  for (int round = 0; round < rounds; ++round) {
    stage.push_back(seconds([&] {
      for (const Pair& p : pairs) visible += sampler(p.i, p.j, p.side, workspace).visible;
    }));
    batches.push_back(seconds([&] {
      for (std::size_t k = 0; k + 1 < first.size(); ++k)
        rays->occluded(std::span(segments).subspan(first[k], first[k + 1] - first[k]), std::span(blocked).subspan(first[k]));
    }));
    single.push_back(seconds([&] {
      for (std::size_t k = 0; k < segments.size(); ++k) blocked[k] = rays->occluded(segments[k]) ? 1 : 0;
    }));
  }
  const double n = static_cast<double>(segments.size()), whole = median(stage), cast = median(batches);
  std::printf("%td elements, %zu pairs, %.0f rays (%.0f %% blocked), mean V %.3f\n", mesh.size(), pairs.size(), n,
              100.0 * static_cast<double>(std::count(blocked.begin(), blocked.end(), 1)) / n, visible / rounds / static_cast<double>(pairs.size()));
  std::printf("stage  %6.0f ns a ray\nbatch  %6.0f ns a ray\nsingle %6.0f ns a ray\n", whole / n * 1e9, cast / n * 1e9, median(single) / n * 1e9);
  std::printf("stage / batch: %.0f %% of the rate of the rays alone (limit 60)\n", 100 * cast / whole);
} catch (const core::InputError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
