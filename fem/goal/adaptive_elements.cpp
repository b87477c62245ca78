#include "fem/goal/adaptive_elements.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <optional>

#include "core/error.h"
#include "core/seconds_since.h"
#include "fem/columns.h"
#include "fem/space/polynomials.h"
#include "mesh/uniform.h"

namespace interflect::fem {
namespace {

using solvers::ColumnMatrix;

constexpr double marked_share = 0.7, missed = 2, cancelling_share = 0.1;

/// Coarse, but not so coarse that a pass sees nothing of the room.
mesh::ElementMesh first_elements(const scene::Scene& scene, const RadiositySettings& settings,
                                 const AdaptiveSettings& adaptive) {
  constexpr double few = 60;
  if (!(adaptive.target > 0)) return elements_of(scene, settings);
  return mesh::uniform(scene, settings.element_size > 0 ? settings.element_size : mesh::edge_for(scene, few));
}

/// What emits and what reflects, of unknowns: exitance of first functions, reflectance of all.
struct Materials {
  ColumnMatrix e, R;

  Materials(const scene::Scene& scene, const mesh::ElementMesh& mesh, Index functions)
      : e(ColumnMatrix::Zero(mesh.size() * functions, scene.channel_count())), R(e) {
    for (Index i = 0; i < mesh.size(); ++i) {
      const scene::SurfacePatch& patch = mesh.patches()[static_cast<std::size_t>(i)];
      const scene::Material& material = scene.material(patch.surface);
      const Spectrum exitance = material.exitance_of(patch.side), reflectance = material.reflectance_of(patch.side);
      for (int c = 0; c < scene.channel_count(); ++c) {
        e(i * functions, c) = exitance[c];
        R.col(c).segment(i * functions, functions).setConstant(reflectance[c]);
      }
    }
  }
};

DualWeighted estimate(const scene::Scene& scene, const mesh::ElementMesh& mesh, const RadiosityOperator& from,
                      const RadiositySettings& settings, const Goal& goal, const raycast::RayCaster& rays, Run& run) {
  const auto [e, R] = Materials(scene, mesh, plane_functions(settings.order));
  const std::vector<int> degree(mesh.patches().size(), settings.order);
  solvers::SolverState state{e, 0};
  const solvers::Reflection reflection(R);
  const auto solver = solvers::make_solver(settings.solver);
  solver->advance({*from.blocks, reflection, e}, state, settings.stopping, run);
  run.throw_if_stopped("solve");
  return dual_weighted({scene, mesh, settings.order, degree, *from.blocks, R, e, settings.quadrature_tolerance},
                       state.x, goal, rays, *solver, settings.stopping, run);
}

/// Doerfler's marking: the fewest elements that together have a share of all.
std::vector<bool> marked(const scene::Scene& scene, const DualWeighted& found) {
  std::vector<double> size;
  for (const Spectrum& s : found.size) size.push_back(scene.weigh(s));
  std::vector<std::size_t> order(size.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return size[a] > size[b] || (size[a] == size[b] && a < b); });
  double left = marked_share * std::accumulate(size.begin(), size.end(), 0.0);
  std::vector<bool> which(size.size(), false);
  for (std::size_t k = 0; k < order.size() && left > 0; ++k) {
    which[order[k]] = true;
    left -= size[order[k]];
  }
  return which;
}

/// For refined_operator: the element before, of those that stay.
std::vector<Index> same_as(const mesh::PartlyQuartered& refined, const std::vector<bool>& which) {
  std::vector<Index> same;
  for (const std::size_t parent : refined.parent)
    same.push_back(which[parent] ? Index{-1} : static_cast<Index>(parent));
  return same;
}

Spectrum bound_of(const DualWeighted& found) {
  Spectrum sizes;
  for (const Spectrum& eta : found.of_elements) sizes += abs(eta);
  return missed * abs(found.correction) + cancelling_share * sizes + found.quadrature;
}

std::optional<AdaptiveStop> reason_to_stop(double value, double error, int pass, const AdaptiveSettings& adaptive) {
  if (!(value > 0)) return AdaptiveStop::no_light;
  if (!(adaptive.target > 0)) return AdaptiveStop::only_asked;
  if (error <= adaptive.target * value) return AdaptiveStop::met;
  if (pass == adaptive.most_passes) return AdaptiveStop::passes;
  return std::nullopt;
}

}  // namespace

std::string describe(AdaptiveStop why) {
  switch (why) {
    case AdaptiveStop::met:
      return "the estimate is met";
    case AdaptiveStop::memory:
      return "more elements need more memory than --max-memory allows";
    case AdaptiveStop::passes:
      return "as many passes as there may be";
    case AdaptiveStop::only_asked:
      return "no target was set";
    case AdaptiveStop::no_light:
      break;
  }
  return "no light reaches the goal";
}

AdaptedElements adapt_elements(const scene::Scene& scene, const RadiositySettings& settings,
                               const AdaptiveSettings& adaptive, const raycast::RayCaster& rays, Run& run) {
  const auto start = std::chrono::steady_clock::now();
  mesh::ElementMesh first = first_elements(scene, settings, adaptive);
  if (first.size() == 0) throw core::InputError("the scene has no surface that light could leave");
  RadiosityOperator from = assemble_operator(scene, first.patches(), rays, settings, run);
  AdaptedElements out{std::move(first), std::move(from), {adaptive.goal, {}, AdaptiveStop::passes}};
  for (int pass = 1;; ++pass) {
    const DualWeighted found = estimate(scene, out.mesh, out.from, settings, adaptive.goal, rays, run);
    const Spectrum bound = bound_of(found);
    const double value = scene.weigh(found.value), error = scene.weigh(bound);
    out.adaptation.passes.push_back({out.mesh.size(), out.mesh.size() * plane_functions(settings.order), found.value,
                                     found.correction, bound, value > 0 ? error / value : 0.0,
                                     core::seconds_since(start)});
    if (const auto stop = reason_to_stop(value, error, pass, adaptive)) {
      out.adaptation.why = *stop;
      return out;
    }
    const std::vector<bool> which = marked(scene, found);
    mesh::PartlyQuartered refined = mesh::quartered(out.mesh, which);
    const double both = std::hypot(static_cast<double>(refined.mesh.size()), static_cast<double>(out.mesh.size()));
    if (!fits_memory(both, settings, FormFactorMethod::Granularity::pair)) {
      out.adaptation.why = AdaptiveStop::memory;
      return out;
    }
    out.from = refined_operator(out.from, same_as(refined, which), scene, refined.mesh.patches(), rays, settings, run);
    out.mesh = std::move(refined.mesh);
  }
}

}  // namespace interflect::fem
