// What assembling and solving the office costs: time of each stage, memory, and nanoseconds a pair.  The limit that it
// is held against: 5 000 elements (12.5 million pairs) in 60 s on two cores and 1 GB.
//
//   bench_assembly [SCENE [ELEMENTS [THREADS [RAYS]]]]      default: data/scenes/office.json 5000 2 16

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "core/error.h"
#include "core/memory.h"
#include "fem/error_summary.h"
#include "fem/radiosity.h"
#include "mesh/uniform.h"
#include "scene/reader.h"

using namespace interflect;

namespace {

/// The element size that comes closest to the number asked for from above: the mesh's own steps are coarse.
double size_for(const scene::Scene& scene, double elements) {
  double size = 1.5 * mesh::edge_for(scene, elements);
  while (4.0 * static_cast<double>(mesh::uniform(scene, 2.0 * size).size()) < elements) size *= 0.98;
  return size;
}

void print(const scene::Scene& scene, const fem::RadiositySolution& s, double seconds, const fem::Forecast& forecast) {
  const double n = static_cast<double>(s.mesh.size()), pairs = 0.5 * n * (n - 1);
  double assembly = 0;
  for (const fem::StageCost& stage : s.stages) {
    std::printf("  %-16s %8.3f s\n", stage.stage.c_str(), stage.seconds);
    if (stage.stage == "form factors") assembly = stage.seconds;
  }
  const fem::ErrorSummary error = fem::summarise_error(s, scene);
  std::printf("pairs: %.1f million, %.0f ns each; away %.3g, clear %.3g, sampled %.3g by %.3g rays\n", pairs * 1e-6,
              assembly / pairs * 1e9, double(s.pairs.facing_away), double(s.pairs.clear), double(s.pairs.sampled),
              double(s.pairs.rays));
  std::printf("closed: %s; row sums %.6f .. %.6f .. %.6f; solver sweeps %d\n", s.closed ? "yes" : "no", s.rows.lowest,
              s.rows.mean, s.rows.highest, s.solver.iterations());
  std::printf("mean H %.2f; estimated error %.2f %%, noise %.2f %% (L2)\n", error.mean_irradiance,
              100 * error.relative_l2, 100 * error.relative_noise_l2);
  std::printf(
      "total %.2f s (limit 60 at 5000; forecast %.1f), operator %.0f MB (forecast %.0f), peak of the process %.0f MB\n",
      seconds, forecast.seconds, s.bytes * 1e-6, forecast.bytes * 1e-6, core::peak_memory_bytes() * 1e-6);
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string file = argc > 1 ? argv[1] : INTERFLECT_SOURCE_DIR "/data/scenes/office.json";
  const double elements = argc > 2 ? std::atof(argv[2]) : 5000;
  const scene::Scene scene = scene::read_scene(file);
  fem::RadiositySettings settings;
  settings.element_size = size_for(scene, elements);
  if (argc > 4) settings.visibility_rays = std::atoi(argv[4]);
  core::LocalRun run(1, argc > 3 ? static_cast<unsigned>(std::atoi(argv[3])) : 2);
  const fem::Forecast forecast = fem::forecast(scene, settings, run.get());
  const auto start = std::chrono::steady_clock::now();
  const fem::RadiositySolution solution = fem::solve_radiosity(scene, settings, run.get());
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("%s: %td elements of at most %.3f m, %u threads\n", file.c_str(), solution.mesh.size(),
              settings.element_size, run.get().threads.count());
  print(scene, solution, seconds, forecast);
} catch (const core::InputError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
