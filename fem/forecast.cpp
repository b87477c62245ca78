#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/error.h"
#include "core/format.h"
#include "core/random.h"
#include "fem/radiosity.h"
#include "mesh/uniform.h"

namespace interflect::fem {

namespace {

constexpr double default_elements = 2500, most_elements_to_mesh = 200'000;

/// K and its errors (4 n² and at most 2 n²), K of the coarse mesh (a sixteenth of that), and what each element carries.
double predicted_bytes(double elements) { return 6.4 * elements * elements + 4000.0 * elements; }
double elements_in(double bytes) { return std::sqrt(bytes / 6.4 + 312.5 * 312.5) - 312.5; }

class Discard final : public ExchangeSink {
 public:
  void add(Index, Index, double, double) override {}
};

/// Seconds per pair on one thread: blocks of random rows and columns of the very mesh.
double seconds_per_pair(const scene::Scene& scene, const RadiositySettings& settings, const mesh::ElementMesh& mesh,
                        const Run& run) {
  const auto rays = raycast::make_ray_caster(settings.intersector, scene);
  const auto method = make_form_factor_method(
      settings.form_factors,
      {scene, mesh.patches(), *rays, run.seed, settings.quadrature_tolerance, settings.visibility_rays});
  constexpr Index block = 48, blocks = 24;
  const Index count = std::min(block, mesh.size()), room = mesh.size() - count + 1;
  core::RandomNumbers random(core::derived_seed(run.seed, "forecast"), 0, 0);
  Discard sink;
  double pairs = 0;
  const auto start = std::chrono::steady_clock::now();
  for (Index k = 0; k < blocks; ++k) {
    auto row = static_cast<Index>(random.next() * static_cast<double>(room)),
         column = static_cast<Index>(random.next() * static_cast<double>(room));
    if (row > column) std::swap(row, column);
    const PairCounts c = method->exchange({mesh.patches(), row, count}, {mesh.patches(), column, count}, sink, run);
    pairs += static_cast<double>(c.facing_away + c.clear + c.sampled);
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / std::max(pairs, 1.0);
}

}  // namespace

double element_size_of(const scene::Scene& scene, const RadiositySettings& settings) {
  return settings.element_size > 0 ? settings.element_size : mesh::edge_for(scene, default_elements);
}

void require_memory(const scene::Scene& scene, double elements, const RadiositySettings& settings) {
  const double bytes = predicted_bytes(elements);
  if (bytes <= settings.max_memory) return;
  throw core::InputError(core::format(
      "elements of %g m are about %.0f, which need %s, more than the %s allowed: --element-size %g or more would fit",
      element_size_of(scene, settings), elements, core::format_bytes(bytes).c_str(),
      core::format_bytes(settings.max_memory).c_str(), mesh::edge_for(scene, 0.9 * elements_in(settings.max_memory))));
}

Forecast forecast(const scene::Scene& scene, const RadiositySettings& settings, const Run& run) {
  const double size = element_size_of(scene, settings), about = 4.0 * mesh::predicted_elements(scene, 2.0 * size);
  if (about > most_elements_to_mesh) require_memory(scene, about, settings);
  const mesh::ElementMesh mesh =
      mesh::quartered(mesh::uniform(scene, 2.0 * size));  // costs little beside what is forecast
  const auto elements = static_cast<double>(mesh.size());
  require_memory(scene, elements, settings);
  if (elements == 0) return {};
  const double pairs = 0.5 * elements * elements;
  const double assembly = pairs * seconds_per_pair(scene, settings, mesh, run) / run.threads.count();
  const double solve =
      30.0 * pairs * 1e-9 * scene.channel_count();  // about thirty sweeps over the matrix, memory bound
  return {elements, predicted_bytes(elements), assembly + solve};
}

}  // namespace interflect::fem
