#include <algorithm>

#include "core/error.h"
#include "solvers/automatic.h"
#include "solvers/combined_walks.h"
#include "solvers/conjugate_gradients.h"
#include "solvers/gauss_seidel.h"
#include "solvers/gmres.h"
#include "solvers/jacobi.h"
#include "solvers/progressive.h"
#include "solvers/random_walk.h"
#include "solvers/southwell.h"
#include "solvers/stochastic_jacobi.h"
#include "solvers/stochastic_ray.h"
#include "solvers/target_walk.h"

namespace interflect::solvers {
namespace {

template <class Solver>
std::unique_ptr<RadiositySolver> plain(const SolverSettings&) {
  return std::make_unique<Solver>();
}

std::unique_ptr<RadiositySolver> over_relaxation(const SolverSettings& settings) {
  if (!(settings.relaxation > 0 && settings.relaxation < 2))
    throw core::InputError("solver 'over-relaxation'", "0 < relaxation < 2 expected");
  return std::make_unique<GaussSeidel>(settings.relaxation);
}
std::unique_ptr<RadiositySolver> symmetric_gauss_seidel(const SolverSettings&) {
  return std::make_unique<GaussSeidel>(1, GaussSeidel::Sweep::back_and_forth);
}
std::unique_ptr<RadiositySolver> gmres(const SolverSettings& settings) {
  if (settings.restart < 1) throw core::InputError("solver 'gmres'", "a restart of 1 or more expected");
  return std::make_unique<Gmres>(settings.restart);
}
std::unique_ptr<RadiositySolver> southwell(const SolverSettings& settings) {
  return std::make_unique<Southwell>(settings.steps);
}
std::unique_ptr<RadiositySolver> progressive(const SolverSettings& settings) {
  if (!(settings.overshoot >= 0 && settings.overshoot <= 1))
    throw core::InputError("solver 'progressive'", "0 <= overshoot <= 1 expected");
  return std::make_unique<Progressive>(settings);
}

using Way = RandomWalk::Way;
using Score = RandomWalk::Score;
template <Way way, Score score>
std::unique_ptr<RadiositySolver> walks(const SolverSettings& settings) {
  return std::make_unique<RandomWalk>(way, score, settings);
}

template <StochasticJacobi::Kind kind>
std::unique_ptr<RadiositySolver> stochastic_jacobi(const SolverSettings& settings) {
  return std::make_unique<StochasticJacobi>(kind, settings);
}

std::unique_ptr<RadiositySolver> stochastic_ray(const SolverSettings& settings) {
  return std::make_unique<StochasticRay>(settings);
}
std::unique_ptr<RadiositySolver> combined_walks(const SolverSettings& settings) {
  return std::make_unique<CombinedWalks>(settings);
}

template <TargetWalk::Way way>
std::unique_ptr<RadiositySolver> target_walk(const SolverSettings& settings) {
  return std::make_unique<TargetWalk>(way, settings);
}

}  // namespace

const std::vector<SolverEntry>& known_solvers() {
  using Needs = SolverEntry::Needs;
  static const std::vector<SolverEntry> all{
      {"automatic", "conjugate gradients, or gmres where the operator is not symmetric", Needs::products,
       plain<Automatic>},
      {"conjugate-gradients", "on the symmetrised operator: few iterations at any reflectance", Needs::symmetry,
       plain<ConjugateGradients>},
      {"gmres", "least residuals: for operators that are not symmetric, as collocation's", Needs::products, gmres},
      {"jacobi", "one bounce of light an iteration", Needs::products, plain<Jacobi>},
      {"gauss-seidel", "row after row with the newest values: half as many sweeps", Needs::products,
       plain<GaussSeidel>},
      {"symmetric-gauss-seidel", "over all rows from the last to the first, and there again", Needs::products,
       symmetric_gauss_seidel},
      {"over-relaxation", "Gauss-Seidel's steps times --relaxation", Needs::products, over_relaxation},
      {"southwell", "the largest residual first", Needs::symmetry, southwell},
      {"progressive", "the brightest shoots what it has: a picture after every step", Needs::symmetry, progressive},
      {"stochastic-jacobi", "bounces by rays, in proportion to the power", Needs::walks,
       stochastic_jacobi<StochasticJacobi::Kind::incremental>, "", true},
      {"regular-stochastic-jacobi", "the same, and then bounces of all that there is", Needs::walks,
       stochastic_jacobi<StochasticJacobi::Kind::regular>, "", true},
      {"bidirectional-stochastic-jacobi", "the same, rays carrying light both ways", Needs::walks,
       stochastic_jacobi<StochasticJacobi::Kind::bidirectional>},
      {"control-variate-stochastic-jacobi", "rays bring what differs from a constant: closed rooms", Needs::closed_room,
       stochastic_jacobi<StochasticJacobi::Kind::control_variate>},
      {"global-line-stochastic-jacobi", "bounces by lines through everything", Needs::lines,
       stochastic_jacobi<StochasticJacobi::Kind::global_lines>},
      {"stochastic-ray", "a few rays at a time of all that there is, and a part of the way to what they say",
       Needs::walks, stochastic_ray},
      {"shooting-collision", "random walks from what shines, scored at every hit", Needs::walks,
       walks<Way::shooting, Score::collision>},
      {"shooting-survival", "the same, scored where they go on", Needs::walks, walks<Way::shooting, Score::survival>,
       "shooting-collision"},
      {"shooting-absorption", "the same, scored where they end", Needs::walks, walks<Way::shooting, Score::absorption>},
      {"gathering-collision", "random walks from every element, scored at every hit", Needs::walks,
       walks<Way::gathering, Score::collision>},
      {"gathering-survival", "the same, scored where they go on", Needs::walks, walks<Way::gathering, Score::survival>,
       "gathering-collision"},
      {"gathering-absorption", "the same, scored where they end", Needs::walks,
       walks<Way::gathering, Score::absorption>},
      {"continuous-shooting", "random walks from point to point: light itself, not the equations'", Needs::points,
       walks<Way::continuous, Score::collision>},
      {"shooting-and-gathering", "both, as their exact variances advise", Needs::walks, combined_walks},
      {"importance-driven-stochastic-jacobi", "rays from where the target has its light from", Needs::target,
       stochastic_jacobi<StochasticJacobi::Kind::importance_driven>},
      {"optimal-sources", "random walks born where the target has its light from", Needs::target,
       target_walk<TargetWalk::Way::optimal_sources>},
      {"potential-driven", "the same, and they go on where that is worth it", Needs::target,
       target_walk<TargetWalk::Way::potential_driven>},
      {"adjoint", "random walks from the target, which gather", Needs::target, target_walk<TargetWalk::Way::adjoint>},
  };
  return all;
}

template <class Which>
static std::vector<std::string> names_of(const Which& which) {
  std::vector<std::string> names;
  for (const SolverEntry& each : known_solvers())
    if (which(each)) names.push_back(each.name);
  return names;
}

std::vector<std::string> solver_names() {
  return names_of([](const SolverEntry&) { return true; });
}

std::vector<std::string> solver_names(bool samples) {
  return names_of([&](const SolverEntry& each) { return each.samples() == samples; });
}

std::vector<std::string> solver_names(std::initializer_list<SolverEntry::Needs> needs) {
  return names_of(
      [&](const SolverEntry& each) { return std::find(needs.begin(), needs.end(), each.needs) != needs.end(); });
}

const SolverEntry& solver_named(const std::string& name) {
  std::string known;
  for (const SolverEntry& each : known_solvers()) {
    if (each.name == name) return each;
    known += (known.empty() ? "" : ", ") + each.name;
  }
  throw core::InputError("solver '" + name + "'", "one of " + known + " expected");
}

std::unique_ptr<RadiositySolver> make_solver(const std::string& name, const SolverSettings& settings) {
  return solver_named(name).make(settings);
}

}  // namespace interflect::solvers
