#include "fem/goal/adaptive_elements.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>

#include "core/error.h"
#include "core/seconds_since.h"
#include "fem/element_materials.h"
#include "fem/space/polynomials.h"
#include "mesh/uniform.h"

namespace interflect::fem {
namespace {

constexpr double marked_share = 0.7, missed = 2, cancelling_share = 0.1;
/// Elements of a start that is nobody's choice.
constexpr double default_start = 60;
/// Of what a pass changed the value of the goal by: an error that falls by a factor q from pass to pass is q / (1 - q)
/// of it.  The factors, for q of a half and of a third, are fitted: tests/fem/goal/many_goals.cpp.
double changed_share(Index elements) { return static_cast<double>(elements) < default_start ? 1 : 0.5; }
/// Decay (dual_weighted.h) from which on a degree more is worth its unknowns: the product of both kinds of coefficients
/// falls to a half from degree to degree.
constexpr double smooth = 0.7;

Index unknowns(std::span<const int> degree) {
  Index sum = 0;
  for (const int p : degree) sum += plane_functions(p);
  return sum;
}

/// A mesh on the way, with its form factors.
struct Elements {
  mesh::ElementMesh mesh;
  std::vector<int> degree;
  RadiosityOperator from;
};

DualWeighted estimate(const scene::Scene& scene, const Elements& elements, const RadiositySettings& settings,
                      const Goal& goal, const raycast::RayCaster& rays, Run& run) {
  const SymmetricOperator& K = *elements.from.blocks;
  const ElementMaterials of = materials_of(scene, elements.mesh.patches());
  const auto [e, R] = on_functions(of.exitance, of.reflectance, scene.channel_count(), elements.degree,
                                   plane_functions(settings.order));
  solvers::SolverState state{e};
  const solvers::Reflection reflection(R);
  const auto solver = solver_of(settings);
  solver->advance({K, reflection, e}, state, settings.stopping, run);
  run.throw_if_stopped("solve");
  return dual_weighted({scene, elements.mesh, settings.order, elements.degree, K, R, e, settings.quadrature_tolerance},
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

/// What becomes of marked elements.
struct Refinement {
  std::vector<bool> cut, raised;
};
Refinement refinement_of(const std::vector<bool>& marked, const DualWeighted& found, std::span<const int> degree,
                         int highest) {
  Refinement out{marked, std::vector<bool>(marked.size(), false)};
  for (std::size_t i = 0; i < marked.size(); ++i) {
    out.raised[i] = marked[i] && degree[i] < highest && found.decay[i] >= smooth;
    out.cut[i] = marked[i] && !out.raised[i];
  }
  return out;
}

struct Refined {
  mesh::ElementMesh mesh;
  std::vector<int> degree;
  std::vector<Index> same_as;  ///< as refined_operator wants it
};
Refined refined(const Elements& before, const Refinement& how) {
  mesh::PartlyQuartered cut = mesh::quartered(before.mesh, how.cut);
  Refined out{std::move(cut.mesh), {}, {}};
  for (const std::size_t parent : cut.parent) {
    out.degree.push_back(before.degree[parent] + (how.raised[parent] ? 1 : 0));
    out.same_as.push_back(how.cut[parent] || how.raised[parent] ? Index{-1} : static_cast<Index>(parent));
  }
  return out;
}

Spectrum bound_of(const DualWeighted& found) {
  Spectrum sizes;
  for (const Spectrum& eta : found.of_elements) sizes += abs(eta);
  return missed * abs(found.correction) + cancelling_share * sizes + found.quadrature;
}

bool any(const std::vector<bool>& which) { return std::find(which.begin(), which.end(), true) != which.end(); }

/// Whether their errors alone are more than what is asked for.
bool by_form_factors(const scene::Scene& scene, const AdaptivePass& pass, const AdaptiveSettings& adaptive) {
  return scene.weigh(pass.quadrature) > adaptive.target * scene.weigh(pass.value);
}

std::optional<AdaptiveStop> reason_to_stop(const scene::Scene& scene, std::span<const AdaptivePass> passes,
                                           const AdaptiveSettings& adaptive) {
  const double value = scene.weigh(passes.back().value), allowed = adaptive.target * value;
  if (!(value > 0)) return AdaptiveStop::no_light;
  if (!(adaptive.target > 0)) return AdaptiveStop::only_asked;
  // The first pass has nothing to be held against: where no node sees a shadow nothing tells of it.
  const bool held_against = passes.size() > 1 || adaptive.most_passes == 1;
  if (held_against && scene.weigh(passes.back().error) <= allowed) return AdaptiveStop::met;
  if (std::ssize(passes) < adaptive.most_passes) return std::nullopt;
  return by_form_factors(scene, passes.back(), adaptive) ? AdaptiveStop::form_factors : AdaptiveStop::passes;
}

}  // namespace

std::string describe(AdaptiveStop why) {
  switch (why) {
    case AdaptiveStop::met:
      return "the estimate is met";
    case AdaptiveStop::form_factors:
      return "errors of form factors alone are larger: --quadrature-tolerance";
    case AdaptiveStop::memory:
      return "more elements need more memory than --max-memory allows";
    case AdaptiveStop::passes:
      return "as many passes as there may be";
    case AdaptiveStop::only_asked:
      return "no target was set";
    case AdaptiveStop::asked_to_stop:
      return "asked to stop";
    case AdaptiveStop::out_of_time:
      return "out of time";
    case AdaptiveStop::no_light:
      break;
  }
  return "no light reaches the goal";
}

namespace {

/// Pass after pass.
class Passes {
 public:
  Passes(const scene::Scene& scene, const RadiositySettings& settings, const AdaptiveSettings& adaptive,
         const raycast::RayCaster& rays, Run& run)
      : scene_(scene), settings_(settings), adaptive_(adaptive), rays_(rays), run_(run) {}

  AdaptedElements all() {
    Elements elements = first();
    Adaptation adaptation{adaptive_.goal, {}, AdaptiveStop::passes};
    DualWeighted found = pass(elements, adaptation);
    try {
      for (;;) {
        if (const auto stop = reason_to_stop(scene_, adaptation.passes, adaptive_)) {
          adaptation.why = *stop;
          break;
        }
        const std::vector<bool> which = marked(scene_, found);
        if (!any(which) && is_within_target(adaptation.passes.back())) {  // exact as it is
          adaptation.why = AdaptiveStop::met;
          break;
        }
        std::optional<Elements> next = any(which) ? refine(elements, found, which) : std::nullopt;
        if (!next) {
          adaptation.why = by_form_factors(scene_, adaptation.passes.back(), adaptive_)
                               ? AdaptiveStop::form_factors
                               : (any(which) ? AdaptiveStop::memory : AdaptiveStop::passes);
          break;
        }
        found = pass(*next, adaptation);
        elements = std::move(*next);
      }
    } catch (const core::Interrupted&) {
      adaptation.why = run_.out_of_time() ? AdaptiveStop::out_of_time : AdaptiveStop::asked_to_stop;
    }
    return {std::move(elements.mesh), std::move(elements.degree), std::move(elements.from), std::move(adaptation)};
  }

 private:
  bool is_within_target(const AdaptivePass& pass) const {
    return scene_.weigh(pass.error) <= adaptive_.target * scene_.weigh(pass.value);
  }
  Elements first() const {
    mesh::ElementMesh mesh = first_elements(scene_, settings_, adaptive_);
    if (mesh.size() == 0) throw core::InputError("the scene has no surface that light could leave");
    std::vector<int> degree(mesh.patches().size(), adaptive_.target > 0 ? 1 : settings_.order);
    RadiosityOperator from = assemble_operator(scene_, mesh.patches(), rays_, settings_, run_, degree);
    return {std::move(mesh), std::move(degree), std::move(from)};
  }

  DualWeighted pass(const Elements& elements, Adaptation& adaptation) const {
    DualWeighted found = estimate(scene_, elements, settings_, adaptive_.goal, rays_, run_);
    Spectrum bound = bound_of(found);
    if (!adaptation.passes.empty())
      bound = max(bound, changed_share(elements.mesh.size()) * abs(found.value - adaptation.passes.back().value));
    const double value = scene_.weigh(found.value);
    adaptation.passes.push_back({elements.mesh.size(), unknowns(elements.degree), found.value, found.correction, bound,
                                 found.quadrature, value > 0 ? scene_.weigh(bound) / value : 0.0,
                                 core::seconds_since(start_)});
    return found;
  }

  /// Nothing, where there is no memory for it.
  std::optional<Elements> refine(const Elements& before, const DualWeighted& found,
                                 const std::vector<bool>& which) const {
    Refined next = refined(before, refinement_of(which, found, before.degree, settings_.order));
    const double both = std::hypot(static_cast<double>(next.mesh.size()), static_cast<double>(before.mesh.size()));
    if (!fits_memory(both, settings_, FormFactorMethod::Granularity::pair)) return std::nullopt;
    RadiosityOperator from =
        refined_operator(before.from, next.same_as, next.degree, scene_, next.mesh.patches(), rays_, settings_, run_);
    return Elements{std::move(next.mesh), std::move(next.degree), std::move(from)};
  }

  const scene::Scene& scene_;
  const RadiositySettings& settings_;
  const AdaptiveSettings& adaptive_;
  const raycast::RayCaster& rays_;
  Run& run_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

mesh::ElementMesh first_elements(const scene::Scene& scene, const RadiositySettings& settings,
                                 const AdaptiveSettings& adaptive) {
  if (!(adaptive.target > 0)) return elements_of(scene, settings);
  if (settings.element_size > 0) return mesh::uniform(scene, settings.element_size);
  return mesh::coarse(scene, mesh::edge_for(scene, default_start));
}

AdaptedElements adapt_elements(const scene::Scene& scene, const RadiositySettings& settings,
                               const AdaptiveSettings& adaptive, const raycast::RayCaster& rays, Run& run) {
  return Passes(scene, settings, adaptive, rays, run).all();
}

}  // namespace interflect::fem
