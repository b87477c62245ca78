// The path tracer against the rays that it traces, its picture's efficiency, and its time for a stated accuracy.
//
//   bench_path_tracer [scene.json]   default: the Cornell box, then the conference room of the folder INTERFLECT_CORPUS
//
// Of each: whole paths a second, and their rays as a fraction of a bare Embree loop over the same rays in the same order,
// converted to single precision beforehand, one thread; the caster's own calls on the recorded rays, as a fraction of the
// same loops, by processor time; what a second thread brings.  Paths start on about 600 elements, in the conference room, whose facets
// alone are far more, at 576 pixels.  Rounds are interleaved, and medians printed.
//
// Of the Cornell box: the efficiency of a picture (picture_efficiency.h), and seconds to 1 % standard error on those
// elements, two threads.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>

#include "bench/bare_embree.h"
#include "bench/conference_room.h"
#include "bench/picture_efficiency.h"
#include "mesh/uniform.h"
#include "montecarlo/measurement_sampler.h"
#include "montecarlo/path_tracer.h"
#include "montecarlo/waves.h"
#include "scene/reader.h"

namespace {

using namespace interflect;
using bench::BareEmbree;
using bench::median;
using bench::processor_seconds;
using bench::Recorder;
using bench::seconds;

std::vector<measure::Measurement> element_irradiances(const scene::Scene& scene, double elements) {
  const mesh::ElementMesh mesh = mesh::uniform(scene, mesh::edge_for(scene, elements));
  std::vector<measure::Measurement> asked;
  for (const scene::SurfacePatch& patch : mesh.patches()) asked.push_back(measure::PatchIrradiance{patch});
  return asked;
}

std::vector<measure::Measurement> pixels(const scene::Scene& scene) {
  std::vector<measure::Measurement> asked;
  for (int y = 0; y < scene.cameras.at(0).height; ++y)
    for (int x = 0; x < scene.cameras[0].width; ++x) asked.push_back(measure::PixelRadiance{scene::CameraId{0}, x, y});
  return asked;
}

void compare_with_bare_embree(const scene::Scene& scene, const std::vector<measure::Measurement>& asked) {
  constexpr int rounds = 7;
  constexpr std::uint64_t samples_each = montecarlo::Waves::samples_per_block;  // as the method traces them
  std::vector<montecarlo::MeasurementSampler> samplers;
  for (const auto& measurement : asked) samplers.emplace_back(scene, measurement);
  const auto caster = raycast::make_ray_caster("embree", scene);
  const Recorder recorder(*caster);
  Spectrum sum;
  std::vector<Spectrum> samples(samples_each);
  const auto trace = [&](const raycast::RayCaster& with) {
    const montecarlo::PathEstimator paths(scene, with);
    for (std::uint32_t m = 0; m < samplers.size(); ++m) {
      samplers[m].sample(paths, {1, m, 0}, samples);
      for (const Spectrum& each : samples) sum += each;
    }
  };
  trace(recorder);
  const BareEmbree bare(scene, recorder, caster->offset());
  std::vector<std::uint8_t> blocked(recorder.segments.size());
  std::size_t hits = 0;
  std::vector<double> paths_s, bare_s, closest_s, bare_closest_s, single_s, bare_single_s, eight_s, bare_eight_s;
  for (int round = 0; round < rounds; ++round) {
    paths_s.push_back(processor_seconds([&] { trace(*caster); }));
    bare_s.push_back(processor_seconds([&] { hits += bare.in_order(); }));
    closest_s.push_back(processor_seconds([&] {
      for (const auto& ray : recorder.rays) hits += caster->closest(ray).has_value();
    }));
    bare_closest_s.push_back(processor_seconds([&] { hits += bare.closest(); }));
    single_s.push_back(processor_seconds([&] {
      for (const auto& segment : recorder.segments) hits += caster->occluded(segment);
    }));
    bare_single_s.push_back(processor_seconds([&] { hits += bare.occluded(); }));
    eight_s.push_back(processor_seconds([&] { caster->occluded(recorder.segments, blocked); }));
    bare_eight_s.push_back(processor_seconds([&] { hits += bare.occluded_by_eight(false); }));
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

/// The same paths by one thread and by two, as the method traces them.  Where other programs take their part of the
/// machine, processor time tells what a second thread costs the first, if not what it waits for.
void compare_threads(const scene::Scene& scene, const std::vector<measure::Measurement>& asked) {
  constexpr int rounds = 7;
  constexpr std::uint64_t samples_each = 1000;
  const auto caster = raycast::make_ray_caster("embree", scene);
  const montecarlo::PathTracer tracer({.samples = samples_each});
  std::vector<double> times, ratio, processor_ratio;
  const auto trace = [&](unsigned threads) {
    core::LocalRun run(1, threads);
    const std::clock_t before = std::clock();
    times.push_back(seconds([&] { tracer.answer(scene, asked, run, *caster); }));
    return static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  };
  for (int round = 0; round < rounds; ++round) {
    const double one = trace(1), two = trace(2);
    processor_ratio.push_back(2 * one / two);
    ratio.push_back(times[times.size() - 2] / times.back());
  }
  std::printf("two threads: %.2f times one (%.2f by processor time), %.2f M paths/s\n", median(ratio),
              median(processor_ratio), 1e-6 * static_cast<double>(asked.size() * samples_each) / times.back());
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

void compare(const scene::Scene& scene, const std::vector<measure::Measurement>& asked) {
  std::printf("%s: %zu facets, %zu measurements\n", scene.file.filename().c_str(), scene.facets.size(), asked.size());
  compare_with_bare_embree(scene, asked);
  compare_threads(scene, asked);
}

}  // namespace

int main(int argc, char** argv) try {
  const scene::Scene box =
      scene::read_scene(argc > 1 ? argv[1] : INTERFLECT_SOURCE_DIR "/data/scenes/cornell_box.json");
  const std::vector<measure::Measurement> asked = element_irradiances(box, 600);
  compare(box, asked);
  if (!box.cameras.empty()) bench::print_picture_efficiency(box);
  time_to_one_percent(box, asked);
  if (argc > 1) return 0;
  if (const std::optional<scene::Scene> room = bench::conference_room())
    compare(*room, pixels(*room));
  else
    std::printf("conference room: not there; INTERFLECT_CORPUS names the folder that holds it\n");
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
