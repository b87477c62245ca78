#include "fem/solver_comparison.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/seconds_since.h"
#include "fem/element_materials.h"
#include "fem/node_radiosity.h"
#include "fem/radiosity_operator.h"
#include "fem/ray_transitions.h"
#include "fem/space/polynomials.h"
#include "solvers/progressive.h"

namespace interflect::fem {
namespace {

using solvers::ColumnMatrix;

/// A scene's equations, with all that they are made of.
class Equations {
 public:
  Equations(const scene::Scene& scene, const RadiositySettings& settings, Run& run)
      : mesh_(elements_of(scene, settings)) {
    if (mesh_.size() == 0) throw core::InputError("the scene has no surface that light could leave");
    rays_ = raycast::make_ray_caster(settings.intersector, scene);
    RadiositySettings of_blocks = settings;
    of_blocks.order = order_of_blocks(settings, mesh_.patches());
    from_ = assemble_operator(scene, mesh_.patches(), *rays_, of_blocks, run);
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
    if (!from_.blocks && !nodes_) walks_.emplace(mesh_.patches(), *rays_);
    e_ = std::move(columns.e);
    R_.emplace(std::move(columns.R));
  }

  Index elements() const { return mesh_.size(); }
  solvers::System system() const {
    const SymmetricOperator& K = from_.blocks ? *from_.blocks : *from_.K;
    return {nodes_ ? static_cast<const solvers::TransportOperator&>(nodes_->T) : K, *R_, e_,
            walks_ ? &*walks_ : nullptr};
  }

 private:
  mesh::ElementMesh mesh_;
  std::unique_ptr<raycast::RayCaster> rays_;
  RadiosityOperator from_;
  std::optional<RayTransitions> walks_;  ///< of constants
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

SolverScore score(const std::string& name, const solvers::System& system, const ColumnMatrix& solution,
                  const RadiositySettings& settings, Run& run) {
  SolverScore out{name, solvers::solver_named(name).samples(), {}, ""};
  solvers::SolverSettings of_solver = settings.solver_settings;
  if (of_solver.steps == 0) of_solver.steps = static_cast<int>(std::max<Index>(1, system.e.rows() / 50));
  solvers::SolverState state{system.e};
  double looking = 0;
  state.observer = [&](const solvers::SolverState& now, const solvers::SolverReport& report) {
    const auto start = std::chrono::steady_clock::now();
    const solvers::IterationRecord& last = report.history.back();
    const double error = relative_error(solvers::for_display(system, now), solution, system.K.gram());
    out.history.push_back({last.rows, last.seconds - looking, error, last.residual});
    looking += core::seconds_since(start);
  };
  try {
    out.why = describe(solvers::make_solver(name, of_solver)->advance(system, state, settings.stopping, run).why);
  } catch (const core::InputError& error) {
    out.why = error.what();
  }
  run.throw_if_stopped("comparing solvers");
  return out;
}

}  // namespace

SolverComparison compare_solvers(const scene::Scene& scene, const RadiositySettings& settings,
                                 std::span<const std::string> names, Run& run,
                                 const std::function<void(const SolverScore&)>& scored) {
  require_compatible(settings);
  const Equations equations(scene, settings, run);
  const solvers::System system = equations.system();
  solvers::SolverState solution{system.e};
  solvers::make_solver("automatic")->advance(system, solution, {1e-13, 200}, run);
  run.throw_if_stopped("comparing solvers");
  SolverComparison out{equations.elements(), system.e.rows(), {}};
  core::Progress::Stage stage(run.progress, "solvers", names.size());
  for (const std::string& name : names) {
    out.scores.push_back(score(name, system, solution.x, settings, run));
    scored(out.scores.back());
    stage.advance(1);
  }
  return out;
}

}  // namespace interflect::fem
