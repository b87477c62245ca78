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

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "bench/bare_embree.h"
#include "core/error.h"
#include "core/run.h"
#include "fem/form_factor/blockers.h"
#include "fem/form_factor/method.h"
#include "fem/form_factor/pair_integral.h"
#include "fem/form_factor/visibility.h"
#include "mesh/uniform.h"
#include "scene/reader.h"

using namespace interflect;
using bench::median;
using bench::processor_seconds;

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

/// What is measured, and on what.
struct Subject {
  const scene::Scene& scene;
  const mesh::ElementMesh& mesh;
  const raycast::RayCaster& rays;
  int rays_per_pair;
};

/// The segments that the stage casts for pairs, in its order.
struct Recorded {
  std::vector<raycast::Segment> segments;
  std::vector<std::size_t> first = {0};  ///< of each pair

  std::span<const raycast::Segment> of_pair(std::size_t k) const {
    return std::span(segments).subspan(first[k], first[k + 1] - first[k]);
  }
};
Recorded record(const fem::VisibilitySampler& sampler, std::span<const Pair> pairs) {
  Recorded all;
  fem::VisibilitySampler::Workspace workspace;
  for (const Pair& p : pairs) {
    sampler.generate(p.i, p.j, p.effort, workspace);
    all.segments.insert(all.segments.end(), workspace.segments.begin(), workspace.segments.end());
    all.first.push_back(all.segments.size());
  }
  return all;
}

/// Of all segments, a round [s].
struct StageTimes {
  std::vector<double> stage, batches, single, bare;
  double visible = 0;  ///< sum over pairs and rounds
  std::size_t blocked = 0, blocked_by_embree = 0;
};
StageTimes times_of(const Subject& of, const fem::VisibilitySampler& sampler, std::span<const Pair> pairs,
                    const Recorded& recorded, const bench::BareEmbree& embree) {
  StageTimes times;
  fem::VisibilitySampler::Workspace workspace;
  std::vector<std::uint8_t> blocked(recorded.segments.size());
  for (int round = 0; round < rounds; ++round) {
    times.stage.push_back(processor_seconds([&] {
      for (const Pair& p : pairs) times.visible += sampler(p.i, p.j, p.effort, workspace).visible;
    }));
    times.batches.push_back(processor_seconds([&] {
      for (std::size_t k = 0; k < pairs.size(); ++k)
        of.rays.occluded(recorded.of_pair(k), std::span(blocked).subspan(recorded.first[k]));
    }));
    times.bare.push_back(processor_seconds([&] { times.blocked_by_embree = embree.occluded_by_eight(true); }));
    times.single.push_back(processor_seconds([&] {
      for (std::size_t k = 0; k < blocked.size(); ++k) blocked[k] = of.rays.occluded(recorded.segments[k]) ? 1 : 0;
    }));
  }
  times.blocked = static_cast<std::size_t>(std::count(blocked.begin(), blocked.end(), 1));
  return times;
}

/// @return  what the stage takes a ray [s]
double compare_with_bare_embree(const Subject& of) {
  const fem::VisibilitySampler sampler(of.mesh.patches(), of.rays, of.rays_per_pair, 1);
  const std::vector<Pair> pairs = sampled_pairs(of.scene, of.mesh.patches(), of.rays_per_pair);
  const Recorded recorded = record(sampler, pairs);
  const bench::BareEmbree embree(of.scene, {}, recorded.segments, of.rays.offset());
  const StageTimes times = times_of(of, sampler, pairs, recorded, embree);
  const double n = static_cast<double>(recorded.segments.size()), of_embree = static_cast<double>(embree.in_packets());
  const double whole = median(times.stage) / n, cast = median(times.batches) / n,
               packets = median(times.bare) / of_embree;
  std::printf("%td elements, %zu pairs, %.0f rays (%.1f %% blocked; bare Embree %.1f %%), mean V %.3f\n",
              of.mesh.size(), pairs.size(), n, 100.0 * static_cast<double>(times.blocked) / n,
              100.0 * static_cast<double>(times.blocked_by_embree) / of_embree,
              times.visible / rounds / static_cast<double>(pairs.size()));
  std::printf("stage %4.0f, caster in batches %4.0f, one by one %4.0f, bare Embree %4.0f ns a ray\n", whole * 1e9,
              cast * 1e9, median(times.single) / n * 1e9, packets * 1e9);
  std::printf("the stage reaches %.0f %% of the caster's rate and %.0f %% of bare Embree's (limit 60)\n",
              100 * cast / whole, 100 * packets / whole);
  return whole;
}

/// @param of_ray  what the stage takes a ray [s]
/// @return  whether near pairs exchange something at all
bool time_assembly(const Subject& of, double of_ray) {
  const auto method =
      fem::make_form_factor_method("gauss-lambert", {of.scene, of.mesh.patches(), of.rays, 1, 1e-3, of.rays_per_pair});
  const fem::ElementBlock all{of.mesh.patches(), 0, of.mesh.size()};
  core::LocalRun run(1, 1);
  NoSink nowhere;
  fem::PairCounts counts;
  const fem::PairIntegrator integrate(of.mesh.patches(), 1e-3);
  const auto near = near_pairs(integrate, of.mesh.size());
  std::vector<double> assembly, of_near;
  double sum = 0;
  for (int round = 0; round < rounds; ++round) {
    assembly.push_back(processor_seconds([&] { counts = method->exchange(all, all, nowhere, run.get()); }));
    of_near.push_back(processor_seconds([&] {
      for (const auto& [i, j] : near) sum += integrate(i, j).value;
    }));
  }
  const double exchanging = static_cast<double>(counts.clear + counts.sampled),
               close = static_cast<double>(near.size()), by_rays = of_ray * static_cast<double>(counts.rays),
               rest = median(assembly) - by_rays;
  std::printf("assembly: %.2g pairs exchange something, %.0f %% of them by rays, which take %.0f %% of the time\n",
              exchanging, 100.0 * static_cast<double>(counts.sampled) / exchanging, 100 * by_rays / median(assembly));
  std::printf("all the rest: %.2f microseconds each, of the %.0f %% that are separated %.2f (limit 0.5)\n",
              1e6 * rest / exchanging, 100 * (1 - close / exchanging),
              1e6 * (rest - median(of_near)) / (exchanging - close));
  return sum > 0;
}

}  // namespace

int main(int argc, char** argv) try {
  const scene::Scene scene = scene::read_scene(argc > 1 ? argv[1] : INTERFLECT_SOURCE_DIR "/data/scenes/office.json");
  const mesh::ElementMesh mesh = mesh::uniform(scene, mesh::edge_for(scene, argc > 2 ? std::atof(argv[2]) : 1500));
  const auto rays = raycast::make_ray_caster("embree", scene);
  const Subject subject{scene, mesh, *rays, argc > 3 ? std::atoi(argv[3]) : 16};
  return time_assembly(subject, compare_with_bare_embree(subject)) ? 0 : 1;
} catch (const core::InputError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
