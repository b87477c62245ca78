#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/format.h"
#include "fem/dark_solution.h"
#include "fem/goal/adaptive_elements.h"
#include "fem/method_trial.h"
#include "fem/radiosity_operator.h"
#include "fem/sampled_radiosity.h"
#include "fem/space/polynomials.h"
#include "fem/specular/channel_by_channel.h"
#include "fem/specular/light_caster.h"
#include "fem/specular/specular_chains.h"
#include "fem/specular/specular_settings.h"
#include "fem/tolerance_trial.h"
#include "mesh/uniform.h"
#include "scene/diffuse_sides.h"

namespace interflect::fem {

namespace {

constexpr double default_elements = 2500, most_elements_to_mesh = 200'000, bytes_an_element = bytes_of_an_element;

using Granularity = FormFactorMethod::Granularity;

/// What is there beside K while entries come: both views of a pair (two_views.h), or counts of lines (global_lines.h).
double bytes_a_pair_on_the_way(Granularity granularity) {
  switch (granularity) {
    case Granularity::row:
      return 24;
    case Granularity::all:
      return 4;
    case Granularity::pair:
      break;
  }
  return 0;
}

/// Beside K: T between nodes, of corners about one an element, and with `continuous` what it is made from.
double bytes_at_nodes(double elements, const RadiositySettings& settings, double functions) {
  if (settings.projection == Projection::galerkin) return 0;
  const double a_side = at_corners(settings.projection) ? 1 : settings.order + 1, nodes = a_side * a_side * elements;
  const double products = settings.projection == Projection::continuous ? functions * elements + nodes : 0;
  return 8 * nodes * (nodes + products);
}

/// @param settings  of the order that blocks have (order_of_blocks)
///
/// Of polynomials K of constants and of all functions; else K and its errors (8 and at most 4 bytes a pair), with the
/// coarse mesh's K (a sixteenth of its entries); sparse: at most N / drop_below pairs of 20 bytes while they come, 16
/// afterwards, and a coarse K of as many entries or a sixteenth of all.  And what each element carries.
double predicted_bytes(double elements, const RadiositySettings& settings, Granularity granularity) {
  const double pairs = 0.5 * elements * elements, on_the_way = pairs * bytes_a_pair_on_the_way(granularity),
               others = bytes_an_element * elements;
  const int order = settings.order;
  const double an_entry = settings.form_factors == "analytic" ? 8 : 12, functions = plane_functions(order),
               at_nodes = bytes_at_nodes(elements, settings, functions);
  if (order > 0) return an_entry * (1 + functions * functions) * pairs + at_nodes + others;
  if (!(settings.drop_below > 0)) return std::max(12 * pairs + on_the_way, 12.75 * pairs) + at_nodes + others;
  const double kept = std::min(pairs, elements / settings.drop_below);
  return std::max(20 * kept + on_the_way, 16 * kept + 20 * std::min(kept, pairs / 16)) + others;
}

/// By halving, since bytes grow with elements.
double elements_in(double bytes, const RadiositySettings& settings, Granularity granularity) {
  double low = 0, high = bytes / bytes_an_element;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (predicted_bytes(middle, settings, granularity) <= bytes ? low : high) = middle;
  }
  return low;
}

/// The memory that so many elements need, as the option takes it: "300MB", "12GB".
std::string memory_option(double bytes) {
  const double megabytes = std::ceil(1e-6 * bytes);
  return megabytes < 1000 ? core::format("%.0fMB", megabytes) : core::format("%.0fGB", std::ceil(1e-3 * megabytes));
}

/// Elements are made as quarters of elements of twice the size.
double predicted_elements(const scene::Scene& scene, double size) {
  return 4.0 * mesh::predicted_elements(scene, 2.0 * size, scene::is_diffuse_side);
}
double size_for(const scene::Scene& scene, double elements) {
  return 0.5 * mesh::edge_for(scene, elements / 4.0, scene::is_diffuse_side);
}

/// What to do about elements that need more memory than allowed: the smallest size, of two digits, that is predicted to
/// fit with a fifth to spare, which is what predictions are worth.
std::string way_out(const scene::Scene& scene, const RadiositySettings& settings, Granularity granularity) {
  const double room = elements_in(settings.max_memory, settings, granularity) / 1.2, size = size_for(scene, room),
               coarsest = predicted_elements(scene, size);
  if (coarsest > 1.1 * room)
    return core::format(
        "no --element-size fits, since the coarsest elements are %.0f; --max-memory %s or more would do", coarsest,
        memory_option(predicted_bytes(1.2 * coarsest, settings, granularity)).c_str());
  return core::format("--element-size %g or more would fit", size);
}

RadiositySettings with_blocks(RadiositySettings settings, const mesh::ElementMesh& mesh) {
  settings.order = order_of_blocks(settings, mesh.patches());
  return settings;
}

/// What form factors of the very mesh need, by a short trial.
struct Assembly {
  double seconds;  ///< on one thread
  double bytes;    ///< of everything
};
Assembly trial(const scene::Scene& scene, const RadiositySettings& settings, const mesh::ElementMesh& mesh,
               const Run& run) {
  const auto rays = make_light_caster(settings.intersector, scene, run.seed);
  const auto make = [&](double relative) {
    FormFactorContext context = form_factor_context(scene, mesh.patches(), *rays, settings, run.seed);
    context.tolerance = relative;
    return make_form_factor_method(settings.form_factors, context);
  };
  const bool to_rows = settings.row_tolerance > 0;
  const auto method = make(to_rows ? entry_tolerance(settings.row_tolerance) : settings.quadrature_tolerance);
  const auto elements = static_cast<double>(mesh.size());
  const RadiositySettings of_blocks = with_blocks(settings, mesh);
  require_memory(scene, elements, of_blocks, method->granularity());
  double seconds = 0.5 * elements * elements * seconds_per_pair(*method, mesh.patches(), run);
  if (to_rows) seconds += seconds_of_later_passes(make, settings.row_tolerance, mesh.patches(), AgainPart::rows, run);
  return {seconds, predicted_bytes(elements, of_blocks, method->granularity())};
}

}  // namespace

double element_size_of(const scene::Scene& scene, const RadiositySettings& settings) {
  if (settings.element_size > 0) return settings.element_size;
  const double elements = default_elements / plane_functions(settings.order);  // as many unknowns
  const double area = mesh::meshed_area(scene, scene::is_diffuse_side);
  if (!(area > 0)) throw core::InputError("the scene has no surface that light could leave");
  return std::min(size_for(scene, elements), mesh::edge_for_area(area, elements));
}

bool fits_memory(double elements, const RadiositySettings& settings, Granularity granularity) {
  return predicted_bytes(elements, settings, granularity) <= settings.max_memory;
}

void require_memory(const scene::Scene& scene, double elements, const RadiositySettings& settings,
                    Granularity granularity) {
  if (fits_memory(elements, settings, granularity)) return;
  const double bytes = predicted_bytes(elements, settings, granularity);
  throw core::InputError(core::format("elements of %g m are about %.0f, which need %s, more than the %s allowed: %s",
                                      element_size_of(scene, settings), elements, core::format_bytes(bytes).c_str(),
                                      core::format_bytes(settings.max_memory).c_str(),
                                      way_out(scene, settings, granularity).c_str()));
}

mesh::ElementMesh elements_of(const scene::Scene& scene, const RadiositySettings& settings,
                              mesh::HasElements has_elements) {
  const double size = element_size_of(scene, settings), about = predicted_elements(scene, size);
  if (about > most_elements_to_mesh) require_memory(scene, about, settings, Granularity::pair);
  mesh::ElementMesh mesh = mesh::quartered(mesh::uniform(scene, 2.0 * size, has_elements));
  require_memory(scene, static_cast<double>(mesh.size()), with_blocks(settings, mesh), Granularity::pair);
  return mesh;
}

mesh::ElementMesh elements_alone(const scene::Scene& scene, const RadiositySettings& settings, double bytes_of_each) {
  const double size = element_size_of(scene, settings), bytes = bytes_of_each * predicted_elements(scene, size);
  if (bytes > settings.max_memory)
    throw core::InputError(
        core::format("elements of %g m need %s, more than the %s allowed: --element-size %g or more would fit", size,
                     core::format_bytes(bytes).c_str(), core::format_bytes(settings.max_memory).c_str(),
                     size_for(scene, settings.max_memory / bytes_of_each / 1.2)));
  mesh::ElementMesh mesh = mesh::quartered(mesh::uniform(scene, 2.0 * size, scene::is_diffuse_side));
  if (mesh.size() == 0) throw core::InputError("the scene has no surface that light could leave");
  return mesh;
}

/// Whether there is light or not: also of one channel of several.
static Forecast forecast_one_way(const scene::Scene& scene, const RadiositySettings& settings, const Run& run) {
  if (solvers::solver_named(settings.solver).samples()) return forecast_of_sampling(scene, settings, run);
  const mesh::ElementMesh mesh = settings.adaptive ? first_elements(scene, settings, *settings.adaptive)
                                                   : elements_of(scene, settings);  // little beside what is forecast
  const auto elements = static_cast<double>(mesh.size());
  if (elements == 0) return {};
  const double pairs = 0.5 * elements * elements;
  const Assembly assembly = trial(scene, settings, mesh, run);
  const double solve =
      30.0 * pairs * 1e-9 * scene.channel_count();  // about thirty sweeps over the matrix, memory bound
  return {elements, assembly.bytes, assembly.seconds / run.threads.count() + solve};
}

/// Of a scene that is solved channel by channel.
static Forecast of_all_channels(const scene::Scene& scene, const RadiositySettings& settings, const Run& run) {
  Forecast all = forecast_one_way(in_one_channel(scene, 0), settings, run);
  all.seconds *= scene.channel_count();
  return all;
}

Forecast forecast(const scene::Scene& scene, const RadiositySettings& given, const Run& run) {
  const RadiositySettings settings = with_mirrors_seen(scene, given);
  require_solvable(scene, settings);
  require_compatible(settings);
  if (is_dark(scene)) return forecast_of_darkness(scene, settings);
  if (any_smooth(scene) && !are_smooth_ones_grey(scene)) return of_all_channels(scene, settings, run);
  return forecast_one_way(scene, settings, run);
}

}  // namespace interflect::fem
