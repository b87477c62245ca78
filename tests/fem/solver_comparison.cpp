#include "fem/solver_comparison.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "fem/radiosity_operator.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

using solvers::ColumnMatrix;
using test::Room;

/// A cube of 8 x 8 elements a face, a strip of its floor shining; rho everywhere.
struct Cube {
  explicit Cube(double rho) {
    Room room;
    room.box({0, 0, 0}, {1, 1, 1}, 8, true, rho);
    scene = room.finish();
    patches = room.patches;
    const auto rays = raycast::make_ray_caster("embree", scene);
    RadiositySettings settings;
    settings.form_factors = "analytic";
    core::LocalRun run(1, 2);
    K = assemble_operator(scene, patches, *rays, settings, run.get()).K;
    e = ColumnMatrix::Zero(std::ssize(patches), 1);
    for (std::size_t i = 0; i < patches.size(); ++i)
      if (const Vec3 x = patches[i].centroid(); x.z() < 1e-9 && x.x() < 1. / 8) e(static_cast<Index>(i), 0) = 1;
    R.emplace(ColumnMatrix::Constant(e.rows(), 1, rho));
  }
  solvers::System system() const { return {*K, *R, e}; }

  scene::Scene scene;
  std::vector<scene::SurfacePatch> patches;
  std::unique_ptr<SymmetricOperator> K;
  ColumnMatrix e;
  std::optional<solvers::Reflection> R;
};

/// Sweeps over the matrix until the relative error, in the Euclidean norm, is below 1e-6.
int sweeps_of(const std::string& name, const Cube& cube) {
  core::LocalRun run(1, 2);
  solvers::SolverState exact{cube.e};
  solvers::make_solver("conjugate-gradients")->advance(cube.system(), exact, {1e-14, 200}, run);
  int needed = 0;
  solvers::SolverState state{cube.e};
  state.observer = [&](const solvers::SolverState& now, const solvers::SolverReport& report) {
    if (needed == 0 && (now.x - exact.x).norm() <= 1e-6 * exact.x.norm())
      needed = static_cast<int>(report.rows()) / static_cast<int>(now.x.rows());
  };
  solvers::make_solver(name)->advance(cube.system(), state, {1e-9, 5000}, run);
  return needed;
}

// docs/truths.md 1.17.  Jacobi's first product is of the start B = E itself; conjugate gradients' first is the right-hand
// side of t, so that they have one more than steps.
TEST(SolversOnACube, need_as_many_iterations_as_are_known) {
  const struct {
    double rho;
    int jacobi, gauss_seidel, conjugate_gradients;
  } known[] = {{.5, 17, 10, 8}, {.9, 127, 64, 12}, {.99, 1373, 688, 13}};
  for (const auto& k : known) {
    const Cube cube(k.rho);
    EXPECT_NEAR(sweeps_of("jacobi", cube) - 1, k.jacobi, 1) << k.rho;
    EXPECT_NEAR(sweeps_of("gauss-seidel", cube), k.gauss_seidel, 1) << k.rho;
    EXPECT_EQ(sweeps_of("conjugate-gradients", cube), k.conjugate_gradients) << k.rho;
  }
}

// All that go by one operator arrive at one solution, whatever the unknowns are; those that cannot have it say why.
TEST(SolverComparison, has_all_arrive_at_one_solution) {
  Room room;
  room.box({0, 0, 0}, {2, 1, 1}, 1, true, .8, 0);
  room.wall({.5, .3, .99}, {0, .4, 0}, {.4, 0, 0}, 1, 0, 1);
  const scene::Scene scene = room.finish();
  core::LocalRun run(1, 2);
  for (const Projection projection : {Projection::galerkin, Projection::gauss_points})
    for (const int order : {0, 1}) {
      RadiositySettings settings;
      settings.form_factors = "analytic";
      settings.element_size = .6;
      settings.order = order;
      settings.projection = projection;
      settings.stopping.tolerance = 1e-11;
      int told = 0;
      const SolverComparison all =
          compare_solvers(scene, settings, solvers::solver_names(), run.get(), [&](const SolverScore&) { ++told; });
      EXPECT_EQ(told, std::ssize(solvers::solver_names()));
      EXPECT_GT(all.elements, 20);
      for (const SolverScore& score : all.scores) {
        if (score.history.empty()) {
          const bool no_source = score.solver == "gathering-survival" && score.why.find("source") != std::string::npos;
          EXPECT_TRUE(projection == Projection::gauss_points || (score.samples && order > 0) || no_source)
              << score.solver;
          EXPECT_TRUE(no_source || score.why.find(score.samples ? "rays" : "symmetric") != std::string::npos)
              << score.why;
          continue;
        }
        EXPECT_EQ(score.why, "converged") << score.solver;
        EXPECT_LT(score.history.back().error, score.samples ? 3 * score.history.back().residual : 1e-9) << score.solver;
        EXPECT_GT(score.history.front().error, score.history.back().error);
        for (std::size_t k = 1; k < score.history.size(); ++k)
          EXPECT_GE(score.history[k].rows, score.history[k - 1].rows);
      }
    }
}

}  // namespace
}  // namespace interflect::fem
