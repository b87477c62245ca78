// Error against time of constants and of polynomials: L2 of irradiance over all that does not emit, at points, against
// the iterated solution of quadratic elements; and how long each order takes to 1 %.  Asked for: p = 1 in a fifth of p
// = 0's time.
//
//   bench_error_against_time [SCENE [ERROR [THREADS [RAYS [BYTES]]]]]   default: data/scenes/office.json 0.01 2 16 8e9
//
// RAYS: of a pair that something may hide.  BYTES: memory that solves may take.

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <vector>

#include "core/error.h"
#include "fem/point_view_factors.h"
#include "fem/radiosity.h"
#include "mesh/uniform.h"
#include "scene/reader.h"

using namespace interflect;

namespace {

struct Sample {
  scene::SurfacePoint point;
  double H = 0;  ///< of the reference, weighed over the channels
};

/// About so many points, by area, each in its element.
std::vector<Sample> samples_on(const scene::Scene& scene, const mesh::ElementMesh& mesh, double count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  double area = 0;
  for (const scene::SurfacePatch& patch : mesh.patches()) area += patch.area;
  std::vector<Sample> samples;
  for (const scene::SurfacePatch& patch : mesh.patches()) {
    if (scene.material(patch.surface).exitance_of(patch.side).max() > 0) continue;
    const double expected = count * patch.area / area;
    const int here = static_cast<int>(expected + uniform(random));
    for (int k = 0; k < here; ++k) {
      double u = uniform(random), v = uniform(random);
      if (patch.corners == 3 && u + v > 1) {
        u = 1 - u;
        v = 1 - v;
      }
      const Vec3 x = fem::point_on(patch.ring(), u, v);
      samples.push_back({{patch.surface, patch.side, 0, Vec2::Zero(), x, patch.normal()}, 0});
    }
  }
  return samples;
}

void set_reference(const scene::Scene& scene, const fem::RadiositySolution& reference, std::vector<Sample>& samples,
                   Run& run) {
  const auto patches = reference.mesh.patches();
  const fem::PointViewFactors factors(scene, patches, reference.field->order, 1e-6);
  run.threads.for_blocks(std::ssize(samples), 1, [&](Index k, Index) {
    Sample& sample = samples[static_cast<std::size_t>(k)];
    Eigen::RowVectorXd F(reference.field->radiosity.rows());
    std::vector<double> rounding(patches.size());
    factors({sample.point.position, sample.point.normal, sample.point.surface},
            {F.data(), static_cast<std::size_t>(F.size())}, rounding);
    const Eigen::RowVectorXd H = F * reference.field->radiosity;
    Spectrum spectrum;
    for (Index c = 0; c < H.size(); ++c) spectrum[static_cast<int>(c)] = H[c];
    sample.H = scene.weigh(spectrum);
  });
}

/// Root mean square of H_h - H over that of H.
double error_of(const scene::Scene& scene, const fem::RadiositySolution& s, const std::vector<Sample>& samples) {
  double difference = 0, whole = 0;
  for (const Sample& sample : samples) {
    const auto there = s.mesh.locate(sample.point);
    const std::size_t i = there->element.value;
    const double H = scene.weigh(s.field ? s.field->irradiance_at(i, sample.point.position) : s.irradiance[i]);
    difference += (H - sample.H) * (H - sample.H);
    whole += sample.H * sample.H;
  }
  return std::sqrt(difference / whole);
}

struct Resources {
  int rays;
  double bytes;
};

/// Visibility by rays, as by default, for every order.
fem::RadiositySettings settings_of(const Resources& resources, int order, double element_size) {
  fem::RadiositySettings settings;
  settings.order = order;
  settings.element_size = element_size;
  settings.visibility_rays = resources.rays;
  settings.max_memory = resources.bytes;
  return settings;
}

struct Trial {
  double seconds, error;
};

bool fits(const scene::Scene& scene, const fem::RadiositySettings& settings, const Run& run) {
  try {
    fem::forecast(scene, settings, run);
    return true;
  } catch (const core::InputError&) {
    return false;
  }
}

/// Smaller and smaller elements, until the error asked for is passed or there is no memory for more; the time for it by
/// a power law through the last two: between them, or beyond, which is said.
double time_to(double wanted, int order, const Resources& resources, double first_size, const scene::Scene& scene,
               const std::vector<Sample>& samples, Run& run) {
  constexpr double ratio = 0.7;
  std::vector<Trial> trials;
  for (double size = first_size; trials.size() < 8; size *= ratio) {
    if (!fits(scene, settings_of(resources, order, size), run)) break;
    const auto start = std::chrono::steady_clock::now();
    const fem::RadiositySolution s = fem::solve_radiosity(scene, settings_of(resources, order, size), run);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    trials.push_back({seconds, error_of(scene, s, samples)});
    std::printf("p = %d  %7td elements of %.3f m  %8.2f s  %6.2f %%\n", order, s.mesh.size(), size, seconds,
                100 * trials.back().error);
    std::fflush(stdout);
    if (trials.back().error <= wanted) break;
  }
  if (trials.empty()) return std::numeric_limits<double>::infinity();
  const Trial last = trials.back();
  if (trials.size() == 1) return last.seconds;  // at most
  const Trial before = trials[trials.size() - 2];
  const double slope = std::log(last.seconds / before.seconds) / std::log(before.error / last.error);
  if (last.error > wanted)
    std::printf("p = %d  has no memory for more: the time to %g %% is extrapolated\n", order, 100 * wanted);
  return last.seconds * std::pow(last.error / wanted, slope);
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string file = argc > 1 ? argv[1] : INTERFLECT_SOURCE_DIR "/data/scenes/office.json";
  const double wanted = argc > 2 ? std::atof(argv[2]) : 0.01;
  core::LocalRun run(1, argc > 3 ? static_cast<unsigned>(std::atoi(argv[3])) : 2);
  const Resources resources{argc > 4 ? std::atoi(argv[4]) : 16, argc > 5 ? std::atof(argv[5]) : 8e9};
  const scene::Scene scene = scene::read_scene(file);
  const double coarse = mesh::edge_for(scene, 60);
  fem::RadiositySettings exact = settings_of(resources, 2, coarse / 8);
  exact.form_factors = "analytic";
  const fem::RadiositySolution reference = fem::solve_radiosity(scene, exact, run.get());
  std::vector<Sample> samples = samples_on(scene, reference.mesh, 3000);
  set_reference(scene, reference, samples, run.get());
  std::printf("reference: p = 2, %td elements; %zu points\n", reference.mesh.size(), samples.size());
  const double constants = time_to(wanted, 0, resources, coarse / 8, scene, samples, run.get()),
               linear = time_to(wanted, 1, resources, coarse / 8, scene, samples, run.get()),
               quadratic = time_to(wanted, 2, resources, coarse / 8, scene, samples, run.get());
  std::printf(
      "%g %% L2 of H: p = 0 in %.1f s, p = 1 in %.1f s (%.3f of p = 0; asked for 0.2), p = 2 in %.1f s (%.3f)\n",
      100 * wanted, constants, linear, linear / constants, quadratic, quadratic / constants);
} catch (const core::InputError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
