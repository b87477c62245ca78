// What paths that a radiosity solution controls are worth: variance x processor time of a path of `path` over those of
// `controlled`, by what is measured.  Variances are relative to the squared value; means over the measurements.
//
//   bench_controlled [scene.json ...]      default: the Cornell box, the office, and the two rooms
//
// The time of the pilots is in it, that of the solution not.
#include <ctime>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "core/seconds_since.h"
#include "fem/radiosity.h"
#include "fem/surface_solution.h"
#include "measure/sensor_points.h"
#include "measure/surface_measurements.h"
#include "montecarlo/controlled/controlled.h"
#include "montecarlo/path_tracer.h"
#include "scene/reader.h"

namespace {

using namespace interflect;

constexpr std::uint64_t paths_each = 8192;
constexpr std::size_t most_of_a_kind = 60;
constexpr std::uint32_t pixels_a_side = 8;

struct Kind {
  std::string name;
  std::vector<measure::Measurement> asked;
};

/// At most so many of them, spread evenly.
std::vector<measure::Measurement> some_of(const std::vector<measure::Measurement>& all) {
  const std::size_t step = (all.size() + most_of_a_kind - 1) / most_of_a_kind;
  std::vector<measure::Measurement> some;
  for (std::size_t k = 0; k < all.size(); k += std::max(step, std::size_t{1})) some.push_back(all[k]);
  return some;
}

std::vector<Kind> kinds(const scene::Scene& scene, const mesh::ElementMesh& mesh) {
  Kind sides{"sides", {}}, points{"sensor points", {}}, pixels{"pixels", {}}, elements{"elements", {}};
  for (const scene::SurfaceId id : scene.surface_ids())
    for (const scene::Side side : {scene::Side::front, scene::Side::back})
      if (scene.material(id).active(side))
        sides.asked.emplace_back(measure::Flux{measure::patches_of(scene, id, side)});
  for (const measure::SensorPoint& point : measure::sensor_points(scene)) points.asked.emplace_back(point.at);
  for (std::uint32_t y = 0; y < pixels_a_side; ++y)
    for (std::uint32_t x = 0; x < pixels_a_side; ++x)
      pixels.asked.emplace_back(measure::PixelRadiance{{0}, static_cast<int>(x), static_cast<int>(y)});
  for (const scene::SurfacePatch& patch : mesh.patches()) elements.asked.emplace_back(measure::PatchIrradiance{patch});
  return {sides, points, pixels, elements};
}

/// Relative variance of one path, its mean over those measurements that it finds light for, times its processor time.
double cost(const measure::Method& method, const scene::Scene& scene, const std::vector<measure::Measurement>& asked) {
  core::LocalRun run(11, 1);
  const std::clock_t begin = std::clock();
  const std::vector<Estimate> found = method.answer(scene, asked, run.get());
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  double sum = 0;
  std::size_t count = 0;
  for (const Estimate& each : found)
    if (const double value = scene.weigh(each.value); value > 0) {
      sum += std::pow(each.weighed_standard_error / value, 2);
      ++count;
    }
  return count == 0 ? 0 : sum / static_cast<double>(count) * seconds;
}

void compare(const std::string& file) {
  scene::Scene scene = scene::read_scene(file);
  for (scene::Camera& camera : scene.cameras) camera.width = camera.height = pixels_a_side;
  core::LocalRun run(1, 1);
  const auto start = std::chrono::steady_clock::now();
  const fem::RadiositySolution solution = fem::solve_radiosity(scene, {}, run.get());
  const auto rays = raycast::make_ray_caster("embree", scene);
  const fem::MirroredLight mirrored = fem::mirrored_light(scene, solution, *rays, run.get());
  std::printf("%s, solved in %.1f s\n", file.c_str(), core::seconds_since(start));

  montecarlo::ControlledSettings settings;
  settings.samples = paths_each;
  settings.solution = fem::as_surface_solution(solution, mirrored);
  const montecarlo::Controlled controlled(settings);
  const montecarlo::PathTracer paths({.samples = paths_each});
  for (const Kind& kind : kinds(scene, solution.mesh)) {
    const auto asked = some_of(kind.asked);
    if (asked.empty()) continue;
    std::vector<double> ratios;  // the times of one after the other, so that noise of the machine cancels
    for (int round = 0; round < 3; ++round)
      ratios.push_back(cost(paths, scene, asked) / cost(controlled, scene, asked));
    std::ranges::nth_element(ratios, ratios.begin() + 1);
    std::printf("  %-14s %5.2f  (%zu)\n", kind.name.c_str(), ratios[1], asked.size());
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) try {
  std::vector<std::string> files(argv + 1, argv + argc);
  if (files.empty())
    for (const char* name : {"cornell_box", "office", "two_rooms"})
      files.push_back(std::string(INTERFLECT_SOURCE_DIR "/data/scenes/") + name + ".json");
  for (const std::string& file : files) compare(file);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
