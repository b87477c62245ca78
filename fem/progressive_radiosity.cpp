#include "fem/progressive_radiosity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/ordered_sum.h"
#include "fem/columns.h"
#include "fem/error_estimate.h"
#include "fem/radiosity_operator.h"
#include "fem/row_sum_check.h"
#include "solvers/progressive.h"
#include "solvers/shooting.h"

namespace interflect::fem {
namespace {

using solvers::ColumnMatrix;

mesh::ElementMesh mesh_of(const scene::Scene& scene, const RadiositySettings& settings) {
  require_diffuse(scene);
  if (settings.order > 0 || settings.projection != Projection::galerkin || settings.adaptive)
    throw core::InputError("progressive refinement", "constants on elements of one size are expected");
  if (settings.solver != "progressive" && settings.solver != "southwell")
    throw core::InputError("solver '" + settings.solver + "'", "one that shoots is expected: progressive, southwell");
  return elements_alone(scene, settings);
}

std::unique_ptr<FormFactorMethod> method_of(const scene::Scene& scene, const mesh::ElementMesh& mesh,
                                            const raycast::RayCaster& rays, const RadiositySettings& settings,
                                            std::uint64_t seed) {
  return make_form_factor_method(settings.form_factors,
                                 form_factor_context(scene, mesh.patches(), rays, settings, seed));
}

/// How far a solve has come from all unshot to what is asked for: as logarithms go, since every bounce leaves a part.
class Approach {
 public:
  Approach(core::Progress& progress, double from, double to)
      : from_(from), to_(to), stage_(progress, "shooting", steps) {}
  void at(double unshot) {
    const double part = to_ < from_ ? std::log(from_ / std::max(unshot, to_)) / std::log(from_ / to_) : 1;
    const auto now = static_cast<std::uint64_t>(std::clamp(part, 0.0, 1.0) * static_cast<double>(steps));
    if (now <= told_) return;
    stage_.advance(now - told_);
    told_ = now;
  }

 private:
  static constexpr std::uint64_t steps = 1000;
  double from_, to_;
  std::uint64_t told_ = 0;
  core::Progress::Stage stage_;
};

/// Of the mean over all elements, sqrt(2 sum A² v) / sum A: not below what any sharing of pairs makes of it, since (e
/// B_i + e B_j)² <= 2 e² (B_i² + B_j²).
Spectrum noise_of_mean(const mesh::ElementMesh& mesh, std::span<const Spectrum> variance) {
  Spectrum sum;
  double area = 0;
  for (std::size_t i = 0; i < variance.size(); ++i) {
    const double A = mesh.patches()[i].area;
    sum += 2 * A * A * variance[i];
    area += A;
  }
  return sqrt(sum) / area;
}

}  // namespace

ProgressiveRadiosity::ProgressiveRadiosity(const scene::Scene& scene, const RadiositySettings& settings, Run& run)
    : scene_(scene),
      settings_(settings),
      run_(run),
      mesh_(mesh_of(scene, settings)),
      element_size_(element_size_of(scene, settings)),
      materials_(materials_of(scene, mesh_.patches())),
      e_(to_columns(materials_.exitance, scene.channel_count())),
      R_(to_columns(materials_.reflectance, scene.channel_count())),
      rays_(raycast::make_ray_caster(settings.intersector, scene)),
      method_(method_of(scene, mesh_, *rays_, settings, run.seed)),
      K_(mesh_.patches(), *method_, run),
      system_{K_, R_, e_} {}

Index ProgressiveRadiosity::emitting() const {
  return std::count_if(materials_.exitance.begin(), materials_.exitance.end(),
                       [](const Spectrum& E) { return !E.is_zero(); });
}

Shots ProgressiveRadiosity::begin() const {
  const ColumnMatrix nothing = ColumnMatrix::Zero(e_.rows(), e_.cols());
  return {{nothing, 0, e_, {}, {}}, nothing, nothing, nothing};
}

double ProgressiveRadiosity::unshot_fraction(const Shots& shots) const {
  return solvers::unshot_fraction(system_, shots.state.residual);
}

/// The last shot's d = x - x before it brings K_ai / A_a d to all a.  Errors of a pair are the same in every shot, so
/// that they go with the whole of x.
void ProgressiveRadiosity::take(Shots& shots, ColumnMatrix& shot_before) const {
  const RowsOnDemand::Column& column = K_.last();
  if (column.of < 0) return;
  const double own = K_.gram()[static_cast<std::size_t>(column.of)];
  const Eigen::Map<const Eigen::ArrayXd> K(column.K.data(), mesh_.size()),
      e(column.standard_error.data(), mesh_.size());
  require_row_sum(scene_, mesh_.patches(), static_cast<std::size_t>(column.of), core::ordered_sum(K) / own,
                  std::sqrt(e.square().sum()) / own);
  const Eigen::RowVectorXd x = shots.state.x.row(column.of), before = shot_before.row(column.of);
  shot_before.row(column.of) = x;
  const Eigen::RowVectorXd d = x - before, of_squares = x.array().square() - before.array().square(),
                           of_sizes = x.cwiseAbs() - before.cwiseAbs();
  const std::span<const double> area = K_.gram();
  for (Index a = 0; a < mesh_.size(); ++a) {
    const auto k = static_cast<std::size_t>(a);
    const double noise = column.standard_error[k] / area[k];
    shots.irradiance.row(a) += column.K[k] / area[k] * d;
    shots.variance.row(a) += noise * noise * of_squares;
    shots.bound.row(a) += column.bound[k] / area[k] * of_sizes;
  }
}

solvers::SolverReport ProgressiveRadiosity::advance(Shots& shots, const std::function<void(const Shots&)>& look,
                                                    int most) {
  solvers::StoppingRule rule = settings_.stopping;
  rule.max_iterations = most - static_cast<int>(shots.count());
  solvers::SolverSettings one_by_one = settings_.solver_settings;
  one_by_one.steps = 1;
  if (rule.unshot > 0 && unshot_fraction(shots) <= rule.unshot)
    return {.why = solvers::SolverReport::Stopped::converged};
  if (rule.max_iterations <= 0) return {.why = solvers::SolverReport::Stopped::iteration_limit};
  Approach approach(run_.progress, unshot_fraction(shots), rule.unshot > 0 ? rule.unshot : rule.tolerance);
  ColumnMatrix shot_before = shots.state.x;
  shots.state.observer = [&](const solvers::SolverState&, const solvers::SolverReport&) {
    take(shots, shot_before);
    approach.at(unshot_fraction(shots));
    look(shots);
  };
  solvers::SolverReport report =
      solvers::make_solver(settings_.solver, one_by_one)->advance(system_, shots.state, rule, run_);
  shots.state.observer = nullptr;
  return report;
}

Spectrum ProgressiveRadiosity::missing(const Shots& shots) const {
  const Eigen::RowVectorXd ambient = solvers::ambient(system_, shots.state.residual);
  Spectrum missing;
  for (int c = 0; c < static_cast<int>(ambient.size()); ++c) missing[c] = std::abs(ambient(c));
  return missing;
}

RadiositySolution ProgressiveRadiosity::shown(const Shots& shots, const solvers::SolverReport& report) const {
  RadiositySolution s(mesh_, element_size_);
  s.exitance = materials_.exitance;
  s.reflectance = materials_.reflectance;
  s.radiosity = to_spectra(solvers::for_display(system_, shots.state));
  const Eigen::RowVectorXd ambient = solvers::ambient(system_, shots.state.residual);
  s.irradiance = to_spectra(shots.irradiance.rowwise() + ambient);
  const Spectrum later = later_bounces(s);
  const std::vector<Spectrum> bound = to_spectra(shots.bound), variance = to_spectra(shots.variance);
  s.shared_noise = later * noise_of_mean(mesh_, variance);
  for (const Spectrum& own : variance) s.irradiance_noise.push_back(sqrt(own + s.shared_noise * s.shared_noise));
  estimate_errors_alone(s, bound, missing(shots));
  s.coarse_radiosity = means_of_fours(mesh_, s.radiosity);
  s.solver = report;
  s.pairs = K_.counts();
  return s;
}

}  // namespace interflect::fem
