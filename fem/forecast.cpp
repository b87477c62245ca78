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
/// The memory that so many elements need, as the option takes it: "300MB", "12GB".
std::string memory_option(double elements) {
  const double megabytes = std::ceil(1e-6 * predicted_bytes(elements));
  return megabytes < 1000 ? core::format("%.0fMB", megabytes) : core::format("%.0fGB", std::ceil(1e-3 * megabytes));
}

/// Elements are made as quarters of elements of twice the size.
double predicted_elements(const scene::Scene& scene, double size) {
  return 4.0 * mesh::predicted_elements(scene, 2.0 * size);
}
double size_for(const scene::Scene& scene, double elements) { return 0.5 * mesh::edge_for(scene, elements / 4.0); }

/// What to do about elements that need more memory than allowed: the smallest size, of two digits, that is predicted to fit
/// with a fifth to spare, which is what predictions are worth.
std::string way_out(const scene::Scene& scene, const RadiositySettings& settings) {
  const double room = elements_in(settings.max_memory) / 1.2, size = size_for(scene, room);
  if (predicted_elements(scene, size) > 1.1 * room)
    return core::format("no --element-size fits, since the coarsest elements are %.0f; --max-memory %s or more would do",
                        predicted_elements(scene, size), memory_option(1.2 * predicted_elements(scene, size)).c_str());
  return core::format("--element-size %g or more would fit", size);
}

void require_memory(const scene::Scene& scene, double elements, const RadiositySettings& settings) {
  const double bytes = predicted_bytes(elements);
  if (bytes <= settings.max_memory) return;
  throw core::InputError(core::format("elements of %g m are about %.0f, which need %s, more than the %s allowed: %s",
                                      element_size_of(scene, settings), elements, core::format_bytes(bytes).c_str(),
                                      core::format_bytes(settings.max_memory).c_str(), way_out(scene, settings).c_str()));
}

class Discard final : public ExchangeSink {
 public:
  void add(Index, Index, const ExchangeEntry&) override {}
};

double since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Random blocks of rows and columns.
double seconds_per_pair_by_blocks(const FormFactorMethod& method, std::span<const scene::SurfacePatch> patches, const Run& run) {
  constexpr Index block = 48, blocks = 24;
  const auto n = static_cast<Index>(patches.size());
  const Index count = std::min(block, n), room = n - count + 1;
  core::RandomNumbers random(core::derived_seed(run.seed, "forecast"), 0, 0);
  Discard sink;
  double pairs = 0;
  const auto start = std::chrono::steady_clock::now();
  for (Index k = 0; k < blocks; ++k) {
    auto row = static_cast<Index>(random.next() * static_cast<double>(room)),
         column = static_cast<Index>(random.next() * static_cast<double>(room));
    if (row > column) std::swap(row, column);
    const PairCounts c = method.exchange({patches, row, count}, {patches, column, count}, sink, run);
    pairs += static_cast<double>(c.facing_away + c.clear + c.sampled + c.subtracted);
  }
  return since(start) / std::max(pairs, 1.0);
}

/// A few random rows: each is worth half as many pairs as it has entries.
double seconds_per_pair_by_rows(const FormFactorMethod& method, std::span<const scene::SurfacePatch> patches, const Run& run) {
  constexpr int rows = 8;
  const auto n = static_cast<Index>(patches.size());
  core::RandomNumbers random(core::derived_seed(run.seed, "forecast"), 0, 0);
  Discard sink;
  const auto start = std::chrono::steady_clock::now();
  for (int k = 0; k < rows; ++k) {
    const auto row = static_cast<Index>(random.next() * static_cast<double>(n));
    method.exchange({patches, row, 1}, {patches, 0, n}, sink, run);
  }
  return since(start) / (0.5 * rows * static_cast<double>(n));
}

/// Seconds per pair on one thread, by parts of the very mesh.
double seconds_per_pair(const scene::Scene& scene, const RadiositySettings& settings, const mesh::ElementMesh& mesh,
                        const Run& run) {
  const auto rays = raycast::make_ray_caster(settings.intersector, scene);
  const auto method = make_form_factor_method(
      settings.form_factors,
      {scene, mesh.patches(), *rays, run.seed, settings.quadrature_tolerance, settings.visibility_rays});
  using Granularity = FormFactorMethod::Granularity;
  if (method->granularity() == Granularity::pair) return seconds_per_pair_by_blocks(*method, mesh.patches(), run);
  if (method->granularity() == Granularity::row) return seconds_per_pair_by_rows(*method, mesh.patches(), run);
  return method->trial(run) / (0.5 * static_cast<double>(mesh.size()) * static_cast<double>(mesh.size()));
}

}  // namespace

double element_size_of(const scene::Scene& scene, const RadiositySettings& settings) {
  if (settings.element_size > 0) return settings.element_size;
  return std::min(size_for(scene, default_elements),
                  mesh::edge_for_area(mesh::active_area(scene), default_elements));
}

mesh::ElementMesh elements_of(const scene::Scene& scene, const RadiositySettings& settings) {
  const double size = element_size_of(scene, settings), about = predicted_elements(scene, size);
  if (about > most_elements_to_mesh) require_memory(scene, about, settings);
  mesh::ElementMesh mesh = mesh::quartered(mesh::uniform(scene, 2.0 * size));
  require_memory(scene, static_cast<double>(mesh.size()), settings);
  return mesh;
}

Forecast forecast(const scene::Scene& scene, const RadiositySettings& settings, const Run& run) {
  const mesh::ElementMesh mesh = elements_of(scene, settings);  // costs little beside what is forecast
  const auto elements = static_cast<double>(mesh.size());
  if (elements == 0) return {};
  const double pairs = 0.5 * elements * elements;
  const double assembly = pairs * seconds_per_pair(scene, settings, mesh, run) / run.threads.count();
  const double solve =
      30.0 * pairs * 1e-9 * scene.channel_count();  // about thirty sweeps over the matrix, memory bound
  return {elements, predicted_bytes(elements), assembly + solve};
}

}  // namespace interflect::fem
