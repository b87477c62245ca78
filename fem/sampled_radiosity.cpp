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
        walks_(mesh.patches(), *rays_),
        K_(areas_of(mesh)),
        rho_(to_columns(materials_.reflectance, scene.channel_count()).cwiseMax(least_reflectance)),
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
    const ColumnMatrix e = to_columns(exitance, scene_.channel_count());
    RadiositySolution s(mesh_, element_size_of(scene_, settings_));
    s.exitance = exitance;
    s.reflectance = materials_.reflectance;
    solvers::SolverState state{e};
    s.solver = solvers::make_solver(settings_.solver, settings_.solver_settings)
                   ->advance({K_, R_, e, &walks_}, state, rule, run);
    if (s.solver.why != solvers::SolverReport::Stopped::nothing_to_do && s.solver.history.empty())
      throw core::Interrupted("solve");
    const ColumnMatrix H = (state.x - e).cwiseQuotient(rho_);
    s.irradiance = to_spectra(H);
    for (std::size_t i = 0; i < exitance.size(); ++i)
      s.radiosity.push_back(exitance[i] + s.reflectance[i] * s.irradiance[i]);
    set_noise(s, state);
    estimate_errors_alone(s, {}, Spectrum::zero(),
                          [&](std::span<const Spectrum> sent) { return arriving_by_rays(walks_, sent, run); });
    s.coarse_radiosity = means_of_fours(mesh_, s.radiosity);
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

  /// Standard errors of irradiance, and what of them is one and the same deviation in all: with x = rho H + e, the sum
  /// S of G x varies by  Var S = sum (G rho)² own² + (sum G rho)² shared².
  void set_noise(RadiositySolution& s, const solvers::SolverState& state) const {
    const Index n = rho_.rows();
    ColumnMatrix noise = ColumnMatrix::Zero(n, rho_.cols());
    if (state.standard_error.size() > 0) noise = state.standard_error.cwiseQuotient(rho_);
    const Eigen::Map<const Eigen::ArrayXd> G(K_.gram().data(), n);
    for (Index c = 0; c < noise.cols() && state.standard_error.size() > 0; ++c) {
      const double of_a_ray = (G * state.x.col(c).array()).sum() / std::max(1.0, s.solver.rows());
      const auto known = noise.col(c).array() > 0;
      noise.col(c) = known.select(noise.col(c).array(), of_a_ray / G).matrix();
      const Eigen::ArrayXd reflecting = G * rho_.col(c).array();
      const double alone = (reflecting * noise.col(c).array()).square().sum(), all = core::ordered_sum(reflecting),
                   together = state.power_error(c) * state.power_error(c);
      const double shared = std::sqrt(std::max(0.0, (together - alone) / (all * all - reflecting.square().sum())));
      s.shared_noise[static_cast<int>(c)] = std::isfinite(shared) ? shared : 0;
      noise.col(c) = noise.col(c).cwiseMax(s.shared_noise[static_cast<int>(c)]);
    }
    s.irradiance_noise = to_spectra(noise);
  }

  const scene::Scene& scene_;
  const RadiositySettings& settings_;
  const mesh::ElementMesh& mesh_;
  ElementMaterials materials_;
  std::unique_ptr<raycast::RayCaster> rays_;
  RayTransitions walks_;
  AreasAlone K_;
  ColumnMatrix rho_;
  solvers::Reflection R_;
};

mesh::ElementMesh mesh_of(const scene::Scene& scene, const RadiositySettings& settings) {
  mesh::ElementMesh mesh = elements_alone(scene, settings);
  if (mesh.size() == 0) throw core::InputError("the scene has no surface that light could leave");
  return mesh;
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
  if (settings.order > 0)
    refuse(core::format("polynomials of order %d here; compare-solvers has them", settings.order));
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
  const double a_column = 8.0 * scene.channel_count() * (settings.solver_settings.replications + 4);
  const double solves = settings.light_groups ? 1.0 + static_cast<double>(measure::light_groups(scene).size()) : 1.0;
  const auto elements = static_cast<double>(mesh.size());
  return {elements, elements * (bytes_of_an_element + a_column),
          solves * seconds_of_a_solve(sampling, settings.stopping, run)};
}

}  // namespace interflect::fem
