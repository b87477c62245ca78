#include "fem/sampled_radiosity.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/format.h"
#include "core/log.h"
#include "core/ordered_sum.h"
#include "fem/arriving_by_rays.h"
#include "fem/columns.h"
#include "fem/element_materials.h"
#include "fem/energy.h"
#include "fem/error_estimate.h"
#include "fem/operator/areas_alone.h"
#include "fem/ray_transitions.h"
#include "fem/space/polynomials.h"
#include "fem/specular/light_caster.h"
#include "fem/specular/specular_chains.h"
#include "fem/stage_clock.h"
#include "measure/light_groups.h"

namespace interflect::fem {
namespace {

using solvers::ColumnMatrix;

constexpr double least_reflectance = 1e-9;  ///< so that black elements are scored, and nothing else changes

/// A scene's elements and rays, and what goes by them.
class Sampling {
 public:
  Sampling(const scene::Scene& scene, const RadiositySettings& settings, const mesh::ElementMesh& mesh,
           std::uint64_t seed)
      : scene_(scene),
        settings_(settings),
        mesh_(mesh),
        materials_(materials_of(scene, mesh.patches())),
        rays_(make_light_caster(settings.intersector, scene, seed)),
        walks_(mesh.patches(), *rays_, settings.order),
        functions_(plane_functions(settings.order)),
        K_(areas_of(mesh), functions_),
        rho_(on_functions_of(materials_.exitance).R.cwiseMax(least_reflectance)),
        R_(rho_) {
    const std::string& instead = solvers::solver_named(settings.solver).finds_black_instead;
    if (!instead.empty() && (rho_.array() <= least_reflectance).any())
      throw core::InputError("solver '" + settings.solver + "'",
                             "what reflects nothing is not found where walks go on; '" + instead + "' would do");
  }

  const ElementMaterials& materials() const { return materials_; }
  const raycast::RayCaster& rays() const { return *rays_; }

  /// What an exitance leads to.
  RadiositySolution solved(const std::vector<Spectrum>& exitance, const solvers::StoppingRule& rule, Run& run) const {
    const ColumnMatrix e = on_functions_of(exitance).e;
    RadiositySolution s(mesh_, element_size_of(scene_, settings_));
    s.exitance = exitance;
    s.reflectance = materials_.reflectance;
    solvers::SolverState state{e};
    s.solver = solvers::make_solver(settings_.solver, settings_.solver_settings)
                   ->advance({K_, R_, e, &walks_}, state, rule, run);
    if (s.solver.why != solvers::SolverReport::Stopped::nothing_to_do && s.solver.history.empty())
      throw core::Interrupted("solve");
    ColumnMatrix H = (state.x - e).cwiseQuotient(rho_);
    s.irradiance = PolynomialField::means(H, functions_);
    for (std::size_t i = 0; i < exitance.size(); ++i)
      s.radiosity.push_back(exitance[i] + s.reflectance[i] * s.irradiance[i]);
    ColumnMatrix noise = noise_of(s, state);
    if (settings_.order > 0) {
      set_field(s, e, std::move(H), std::move(noise));
      estimate_errors_of_polynomials_alone(s, added_by_rays(walks_, *s.field, run));
    } else {
      estimate_errors_alone(s, {}, Spectrum::zero(),
                            [&](std::span<const Spectrum> sent) { return arriving_by_rays(walks_, sent, run); });
    }
    s.coarse_radiosity = settings_.order > 0 ? s.radiosity : means_of_fours(mesh_, s.radiosity);
    s.pairs.rays = static_cast<std::uint64_t>(s.solver.rows());
    s.bytes = 8.0 * static_cast<double>(e.size()) * settings_.solver_settings.replications;
    return s;
  }

 private:
  static std::vector<double> areas_of(const mesh::ElementMesh& mesh) {
    std::vector<double> areas;
    for (const scene::SurfacePatch& patch : mesh.patches()) areas.push_back(patch.area);
    return areas;
  }

  MaterialColumns on_functions_of(const std::vector<Spectrum>& exitance) const {
    const std::vector<int> degree(exitance.size(), settings_.order);
    return on_functions(exitance, materials_.reflectance, scene_.channel_count(), degree, functions_);
  }

  /// Standard errors of irradiance's coefficients; of the solution those of means, and what of them is one and the same
  /// deviation in all: with x = rho H + e, the sum S of A x over first functions varies by
  /// Var S = sum (A rho)² own² + (sum A rho)² shared².
  ColumnMatrix noise_of(RadiositySolution& s, const solvers::SolverState& state) const {
    ColumnMatrix noise = ColumnMatrix::Zero(rho_.rows(), rho_.cols());
    if (state.standard_error.size() > 0) {
      noise = state.standard_error.cwiseQuotient(rho_);
      for (Index c = 0; c < noise.cols(); ++c) set_noise_of_column(noise, c, s, state);
    }
    s.irradiance_noise = PolynomialField::means(noise, functions_);
    return noise;
  }

  /// Where no ray told, what one brings.
  void set_noise_of_column(ColumnMatrix& noise, Index c, RadiositySolution& s,
                           const solvers::SolverState& state) const {
    const Eigen::Map<const Eigen::ArrayXd> G(K_.gram().data(), rho_.rows());
    const auto first = Eigen::seqN(Index{0}, static_cast<Index>(mesh_.patches().size()), functions_);
    const double of_a_ray =
        core::ordered_sum(Eigen::ArrayXd((G * state.x.col(c).array())(first))) / std::max(1.0, s.solver.rows());
    const auto known = noise.col(c).array() > 0;
    noise.col(c) = known.select(noise.col(c).array(), of_a_ray / G).matrix();
    const Eigen::ArrayXd reflecting = (G * rho_.col(c).array())(first), own = noise.col(c).array()(first);
    const double alone = core::ordered_sum((reflecting * own).square()), all = core::ordered_sum(reflecting),
                 together = state.power_error(c) * state.power_error(c);
    double shared = std::sqrt(std::max(0.0, (together - alone) / (all * all - core::ordered_sum(reflecting.square()))));
    if (!std::isfinite(shared)) shared = 0;
    s.shared_noise[static_cast<int>(c)] = shared;
    for (Index i = 0; i < noise.rows(); i += functions_) noise(i, c) = std::max(noise(i, c), shared);
  }

  /// Polynomials, the order below being the same without the highest degree.
  void set_field(RadiositySolution& s, const ColumnMatrix& e, ColumnMatrix H, ColumnMatrix noise) const {
    ColumnMatrix radiosity = e + on_functions_of(s.exitance).R.cwiseProduct(H);
    ColumnMatrix below = radiosity;
    const Index kept = plane_functions(settings_.order - 1);
    for (Index first = 0; first < below.rows(); first += functions_)
      below.middleRows(first + kept, functions_ - kept).setZero();
    s.field = PolynomialField{settings_.order,
                              functions_,
                              std::vector<int>(mesh_.patches().size(), settings_.order),
                              bases_of(settings_.order, mesh_.patches()),
                              std::move(radiosity),
                              std::move(H),
                              std::move(below),
                              std::move(noise)};
  }

  const scene::Scene& scene_;
  const RadiositySettings& settings_;
  const mesh::ElementMesh& mesh_;
  ElementMaterials materials_;
  std::unique_ptr<raycast::RayCaster> rays_;
  RayTransitions walks_;
  Index functions_;  ///< of an element
  AreasAlone K_;
  ColumnMatrix rho_;
  solvers::Reflection R_;
};

/// Of an element while it is solved, and of its functions, which are kept of every group.
double bytes_of_each(const scene::Scene& scene, const RadiositySettings& settings) {
  constexpr double while_solved = 8, kept = 4;  // columns beside those of replications; of a field
  const double solutions = settings.light_groups ? 1.0 + static_cast<double>(measure::light_groups(scene).size()) : 1.0;
  const double a_column = 8.0 * scene.channel_count() * plane_functions(settings.order);
  double bytes = bytes_of_an_element + a_column * (settings.solver_settings.replications + while_solved);
  if (settings.order > 0) bytes += solutions * (kept * a_column + sizeof(PlaneBasis));
  return bytes;
}

mesh::ElementMesh mesh_of(const scene::Scene& scene, const RadiositySettings& settings) {
  return elements_alone(scene, settings, bytes_of_each(scene, settings));
}

/// As accurate as the settings ask for, or, where the run is stopped, by one round: what is written has all groups.
RadiositySolution to_some_end(const Sampling& sampling, const std::vector<Spectrum>& exitance,
                              solvers::StoppingRule rule, Run& run) {
  try {
    return sampling.solved(exitance, rule, run);
  } catch (const core::Interrupted&) {
    rule.max_iterations = 1;
    Run to_the_end = run.to_the_end();
    return sampling.solved(exitance, rule, to_the_end);
  }
}

/// How many more rounds, of as many samples as all before them each, until the noise is what is asked for: as fast as it
/// fell in the last ones, or as independent samples would.
double rounds_to_come(const std::vector<solvers::IterationRecord>& history, double noise) {
  constexpr std::size_t looked_at = 4;
  const double last = history.back().residual;
  if (!(last > noise)) return 0;
  double order = 0.5;
  if (history.size() > looked_at)
    order = std::clamp(std::log2(history[history.size() - 1 - looked_at].residual / last) / looked_at, 0.5, 1.0);
  return std::ceil(std::log2(last / noise) / order);
}

/// By a first round, and where that is over soon by those of a second.
double seconds_of_a_solve(const Sampling& sampling, const solvers::StoppingRule& rule, const Run& run) {
  constexpr double enough = 0.25;
  Run trial = run.to_the_end();
  solvers::StoppingRule some = rule;
  const auto rounds = [&] { return sampling.solved(sampling.materials().exitance, some, trial).solver.history; };
  some.max_iterations = 1;
  const auto start = std::chrono::steady_clock::now();
  std::vector<solvers::IterationRecord> history = rounds();
  const double all = core::seconds_since(start);
  if (history.empty()) return all;
  const double beside = all - history.back().seconds;
  if (all < enough && rule.max_iterations > 1) {
    some.max_iterations = rule.max_iterations;
    some.max_seconds = std::min(enough, rule.max_seconds);
    history = rounds();
  }
  return beside + history.back().seconds * std::exp2(rounds_to_come(history, rule.noise));
}

}  // namespace

void require_sampled(const RadiositySettings& settings) {
  const auto refuse = [&](const std::string& what) {
    throw core::InputError("solver '" + settings.solver + "', which needs no matrix", "it does not go with " + what);
  };
  if (settings.order > 0 && !solvers::solver_named(settings.solver).knows_polynomials)
    refuse(core::format("polynomials of order %d: 'stochastic-jacobi' would do", settings.order));
  if (settings.projection != Projection::galerkin) refuse("values at nodes");
  if (settings.adaptive) refuse("elements made for a goal");
  if (settings.closure != "none") refuse("a closure that is restored: there are no form factors");
  if (settings.drop_below > 0) refuse("pairs left out (drop-below)");
  if (settings.row_tolerance > 0) refuse("a tolerance of rows: there are none");
  if (settings.stored_factors) refuse("view factors of a file");
  if (solvers::solver_named(settings.solver).needs == solvers::SolverEntry::Needs::target)
    refuse("a whole solution: it is for one number, as compare-solvers --goal asks for");
}

RadiositySolution sample_radiosity(const scene::Scene& scene, const RadiositySettings& settings, Run& run) {
  std::vector<StageCost> stages;
  StageClock timed(stages);
  const mesh::ElementMesh mesh = timed("mesh", [&] { return mesh_of(scene, settings); });
  require_outside_glass(scene, mesh.patches(), *raycast::make_ray_caster(settings.intersector, scene), run);
  const Sampling sampling = timed("ray tree", [&] { return Sampling(scene, settings, mesh, run.seed); });
  RadiositySolution s =
      timed("solve", [&] { return sampling.solved(sampling.materials().exitance, settings.stopping, run); });
  Run rest = run.to_the_end();  // what there is is written, however soon the solve was stopped
  if (settings.light_groups)
    timed("light groups", [&] {
      for (const std::string& group : measure::light_groups(scene)) {
        std::vector<Spectrum> exitance = sampling.materials().exitance;
        leave_group_alone(exitance, group, scene, mesh.patches());
        s.of_groups.push_back(to_some_end(sampling, exitance, settings.stopping, run));
      }
    });
  timed("energy balance", [&] {
    const LostRays lost = cast_lost_rays(scene, mesh.patches(), s.radiosity, sampling.rays(), rest);
    s.closed = lost.lost == 0;
    s.energy = energy_balance(s, lost);
  });
  s.stages = std::move(stages);
  return s;
}

Forecast forecast_of_sampling(const scene::Scene& scene, const RadiositySettings& settings, const Run& run) {
  const mesh::ElementMesh mesh = mesh_of(scene, settings);
  const Sampling sampling(scene, settings, mesh, run.seed);
  const double solves = settings.light_groups ? 1.0 + static_cast<double>(measure::light_groups(scene).size()) : 1.0;
  const auto elements = static_cast<double>(mesh.size());
  return {elements, elements * bytes_of_each(scene, settings),
          solves * seconds_of_a_solve(sampling, settings.stopping, run)};
}

}  // namespace interflect::fem
