#include "fem/solver_comparison.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/seconds_since.h"
#include "fem/columns.h"
#include "fem/element_materials.h"
#include "fem/node_radiosity.h"
#include "fem/radiosity_operator.h"
#include "fem/ray_transitions.h"
#include "fem/row_sum_check.h"
#include "fem/space/polynomials.h"
#include "solvers/progressive.h"

namespace interflect::fem {
namespace {

using solvers::ColumnMatrix;

/// A scene's equations, with all that they are made of.
class Equations {
 public:
  Equations(const scene::Scene& scene, const RadiositySettings& settings, const std::optional<Goal>& goal, Run& run)
      : mesh_(elements_of(scene, settings)) {
    require_diffuse(scene);
    if (mesh_.size() == 0) throw core::InputError("the scene has no surface that light could leave");
    rays_ = raycast::make_ray_caster(settings.intersector, scene);
    RadiositySettings of_blocks = settings;
    of_blocks.order = order_of_blocks(settings, mesh_.patches());
    from_ = assemble_operator(scene, mesh_.patches(), *rays_, of_blocks, run);
    require_row_sums(scene, mesh_.patches(), from_.K->row_sums(run), *from_.K, run);
    const SymmetricOperator& K = from_.blocks ? *from_.blocks : *from_.K;
    const auto [exitance, reflectance] = materials_of(scene, mesh_.patches());
    const int channels = scene.channel_count();
    MaterialColumns columns;
    if (settings.projection == Projection::galerkin) {
      const std::vector<int> degree(mesh_.patches().size(), settings.order);
      columns = on_functions(exitance, reflectance, channels, degree, plane_functions(settings.order));
    } else {
      nodes_.emplace(node_equations(settings.projection, scene, mesh_, of_blocks.order, K, run));
      columns = at_nodes(exitance, reflectance, channels, nodes_->nodes);
    }
    if (!nodes_) walks_.emplace(mesh_.patches(), *rays_, settings.order);
    if (goal) target_ = target_of(weights_of(*goal, scene, mesh_, *rays_, settings.order, run), run);
    e_ = std::move(columns.e);
    R_.emplace(std::move(columns.R));
  }

  Index elements() const { return mesh_.size(); }
  solvers::System system() const {
    const SymmetricOperator& K = from_.blocks ? *from_.blocks : *from_.K;
    return {nodes_ ? static_cast<const solvers::TransportOperator&>(nodes_->T) : K, *R_, e_,
            walks_ ? &*walks_ : nullptr, target_};
  }

 private:
  /// t of J = sum t b: what is wanted of B, and what is of H, A_i H_i = sum_b K_ib b_b with the first functions of
  /// elements.
  std::vector<double> target_of(const GoalWeights& weights, Run& run) const {
    if (nodes_) throw core::InputError("--goal", "values at nodes have none; --projection galerkin would do");
    std::vector<double> target = weights.direct;
    if (weights.arriving.empty()) return target;
    const SymmetricOperator& K = from_.blocks ? *from_.blocks : *from_.K;
    const Index n = K.layout().unknowns(), functions = n / K.layout().elements();
    ColumnMatrix wanted = ColumnMatrix::Zero(n, 1), sent(n, 1);
    for (std::size_t i = 0; i < weights.arriving.size(); ++i)
      wanted(static_cast<Index>(i) * functions, 0) = weights.arriving[i];
    K.apply(wanted, sent, run);
    for (std::size_t a = 0; a < target.size(); ++a) target[a] += sent(static_cast<Index>(a), 0);
    return target;
  }

  mesh::ElementMesh mesh_;
  std::unique_ptr<raycast::RayCaster> rays_;
  RadiosityOperator from_;
  std::optional<RayTransitions> walks_;
  std::vector<double> target_;
  std::optional<NodeEquations> nodes_;
  ColumnMatrix e_;
  std::optional<solvers::Reflection> R_;
};

/// sqrt(sum G (x - y)²) over all columns, / that of y.
double relative_error(const ColumnMatrix& x, const ColumnMatrix& y, std::span<const double> gram) {
  const Eigen::Map<const Eigen::ArrayXd> G(gram.data(), x.rows());
  const auto norm = [&](const ColumnMatrix& of) { return std::sqrt((of.array().square().colwise() * G).sum()); };
  const double size = norm(y);
  return size > 0 ? norm(x - y) / size : 0;
}

/// J = sum_a t_a b_a of every column.
Eigen::RowVectorXd value_of_target(const solvers::System& system, const ColumnMatrix& b) {
  return Eigen::Map<const Eigen::RowVectorXd>(system.target.data(), b.rows()) * b;
}

/// What solvers say of J that know of it, or what their x makes it; and |J - J_h|, relative.
void look_at_target(SolverScore::At& at, const solvers::System& system, const solvers::SolverState& now,
                    const ColumnMatrix& solution) {
  const Eigen::RowVectorXd exact = value_of_target(system, solution);
  const Eigen::RowVectorXd found =
      now.target.size() > 0 ? now.target : value_of_target(system, solvers::for_display(system, now));
  at.error = exact.norm() > 0 ? (found - exact).norm() / exact.norm() : 0;
  at.goal = to_spectrum(found);
  at.goal_error = to_spectrum(now.target_error);
}

/// Nothing where the run was asked to stop before it had an iteration.
std::optional<SolverScore> score(const std::string& name, const solvers::System& system, const ColumnMatrix& solution,
                                 const RadiositySettings& settings, Run& run) {
  if (run.stop.stop_requested()) return {};
  SolverScore out{name, solvers::solver_named(name).samples(), {}, "", false};
  solvers::SolverSettings of_solver = settings.solver_settings;
  if (of_solver.steps == 0) of_solver.steps = static_cast<int>(std::max<Index>(1, system.e.rows() / 50));
  solvers::SolverState state{system.e};
  double looking = 0;
  state.observer = [&](const solvers::SolverState& now, const solvers::SolverReport& report) {
    const auto start = std::chrono::steady_clock::now();
    const solvers::IterationRecord& last = report.history.back();
    SolverScore::At at{last.rows, last.seconds - looking, 0, last.residual};
    if (system.target.empty())
      at.error = relative_error(solvers::for_display(system, now), solution, system.K.gram());
    else
      look_at_target(at, system, now, solution);
    out.history.push_back(at);
    looking += core::seconds_since(start);
  };
  try {
    using Stopped = solvers::SolverReport::Stopped;
    const auto why = solvers::make_solver(name, of_solver)->advance(system, state, settings.stopping, run).why;
    out.why = describe(why);
    out.stopped = run.stop.stop_requested() && (why == Stopped::asked_to || why == Stopped::time_limit);
  } catch (const core::InputError& error) {
    out.why = error.what();
  }
  if (out.stopped && out.history.empty()) return {};
  return out;
}

}  // namespace

SolverComparison compare_solvers(const scene::Scene& scene, const RadiositySettings& settings,
                                 std::span<const std::string> names, const std::optional<Goal>& goal, Run& run,
                                 const std::function<void(const SolverScore&)>& scored) {
  require_compatible(settings);
  const Equations equations(scene, settings, goal, run);
  const solvers::System system = equations.system();
  solvers::SolverState solution{system.e};
  solvers::make_solver("automatic")->advance(system, solution, {1e-13, 200}, run);
  run.throw_if_stopped("comparing solvers");
  SolverComparison out{equations.elements(), system.e.rows(), {}, {}, {}};
  if (goal) out.goal = to_spectrum(value_of_target(system, solution.x));
  core::Progress::Stage stage(run.progress, "solvers", names.size());
  for (const std::string& name : names) {
    if (std::optional<SolverScore> its = score(name, system, solution.x, settings, run)) {
      out.scores.push_back(*std::move(its));
      scored(out.scores.back());
    } else {
      out.left_out.push_back(name);
    }
    stage.advance(1);
  }
  const auto nothing_of = [](const SolverScore& each) { return each.history.empty(); };
  if (out.stopped() && std::all_of(out.scores.begin(), out.scores.end(), nothing_of))
    throw core::Interrupted("comparing solvers");
  return out;
}

}  // namespace interflect::fem
