#include "fem/solver_comparison.h"

#include <gtest/gtest.h>

#include <thread>

#include "core/error.h"
#include "core/student_t.h"
#include "fem/radiosity_operator.h"
#include "measure/sensor_points.h"
#include "scene/reader.h"
#include "tests/fem/rooms.h"
#include "tests/support/family.h"

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

// docs/truths.md 1.17.  Jacobi's first product is of the start B = E itself; conjugate gradients' first is the
// right-hand side of t, so that they have one more than steps.
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

/// Whether a solver says of these equations what it may say of them.
bool may_refuse(const SolverScore& score, Projection projection, int order) {
  using Needs = solvers::SolverEntry::Needs;
  const auto says = [&](const char* word) { return score.why.find(word) != std::string::npos; };
  const Needs needs = solvers::solver_named(score.solver).needs;
  if (needs == Needs::products) return false;
  if (needs == Needs::symmetry) return projection != Projection::galerkin && says("symmetric");
  if (projection != Projection::galerkin) return says("rays") || says("target");
  if (needs == Needs::target) return says("target") || says("constants");
  if (order > 0) return score.solver.find("stochastic-jacobi") != 0 && says("constants");
  if (needs == Needs::closed_room) return says("closed");  // a lamp's back is black
  return score.solver == "gathering-survival" && says("source");
}

// A goal has all arrive at its one number, and those that are for it as well.
TEST(SolverComparison, of_a_goal_has_all_arrive_at_one_number) {
  Room room;
  room.box({0, 0, 0}, {2, 1, 1}, 1, true, .5, 0);
  room.wall({.5, .3, .99}, {0, .4, 0}, {.4, 0, 0}, 1, .2, 1);
  const scene::Scene scene = room.finish();
  core::LocalRun run(1, 2);
  const Goal goals[] = {
      {"floor", Goal::OnSurface{scene.surface_ids().front(), scene::Side::front}},
      {"point", Goal::AtPoints{{measure::PointIrradiance{Vec3(1.6, .5, .4), Vec3(-1, 0, .2).normalized(), {}}}}}};
  for (const Goal& goal : goals)
    for (const int order : {0, 1}) {
      RadiositySettings settings;
      settings.form_factors = "analytic";
      settings.element_size = .6;
      settings.order = order;
      settings.stopping.tolerance = 1e-11;
      const SolverComparison all =
          compare_solvers(scene, settings, solvers::solver_names(), goal, run.get(), [](const SolverScore&) {});
      EXPECT_TRUE(all.of_goal());
      int asked = 0;
      for (const SolverScore& score : all.scores) {
        if (score.history.empty()) {
          EXPECT_TRUE(order > 0 || score.why.find("closed") != std::string::npos) << score.solver << score.why;
          continue;
        }
        const bool to_light = score.solver == "continuous-shooting";
        EXPECT_LT(score.history.back().error, to_light        ? .1
                                              : score.samples ? 4.5 * score.history.back().residual
                                                              : 1e-9)
            << score.solver << ' ' << goal.name << order;
        ++asked;
      }
      EXPECT_GE(asked, order == 0 ? std::ssize(solvers::solver_names()) - 1 : 10);
    }
}

// A furnace has H = E / (1 - rho) everywhere: so has the solution, and each solver within what it says of it.
TEST(SolverComparison, of_a_goal_has_its_value_by_each) {
  constexpr double rho = .5, exitance = 3, H = exitance / (1 - rho);
  Room room;
  room.box({0, 0, 0}, {2, 1, 1}, 1, true, rho, exitance);
  const scene::Scene scene = room.finish();
  RadiositySettings settings;
  settings.form_factors = "analytic";
  settings.element_size = .6;
  settings.quadrature_tolerance = 1e-11;  // of touching elements: their row sums are to be 1
  settings.stopping.noise = .03;
  core::LocalRun run(3, 2);
  const Goal wall{"wall", Goal::OnSurface{scene.surface_ids().front(), scene::Side::front}};
  const SolverComparison all =
      compare_solvers(scene, settings, solvers::solver_names(), wall, run.get(), [](const SolverScore&) {});
  EXPECT_NEAR((*all.goal)[0], H, 1e-9 * H);
  EXPECT_FALSE(all.stopped());
  // Standard errors are by how replications differ: intervals are Student's.  Alpha is divided among all (Bonferroni).
  const double each = interflect::test::alpha / static_cast<double>(all.scores.size());
  const double t = core::student_t(1 - each, settings.solver_settings.replications - 1);
  int sampled = 0;
  for (const SolverScore& score : all.scores) {
    ASSERT_EQ(score.why, "converged") << score.solver;
    const SolverScore::At& last = score.history.back();
    EXPECT_NEAR(last.error, std::abs(last.goal[0] - (*all.goal)[0]) / (*all.goal)[0], 1e-12) << score.solver;
    if (!score.samples) {
      EXPECT_NEAR(last.goal[0], H, 1e-8 * H) << score.solver;
      EXPECT_EQ(last.goal_error, Spectrum::zero()) << score.solver;
      continue;
    }
    EXPECT_LE(std::abs(last.goal[0] - H), t * last.goal_error[0] + 1e-9 * H) << score.solver;
    EXPECT_NEAR(last.goal_error[0], last.residual * last.goal[0], 1e-9 * H) << score.solver;
    ++sampled;
  }
  EXPECT_GE(sampled, 15);
}

/// A lamp below the ceiling, and walls that glow.
scene::Scene lit_room() {
  Room room;
  room.box({0, 0, 0}, {2, 1, 1}, 1, true, .5, 1);
  room.wall({.5, .3, .99}, {0, .4, 0}, {.4, 0, 0}, 1, 0, 1);
  return room.finish();
}

/// A run of a test, which says when it is to stop.
struct StoppableRun {
  core::Threads threads{2};
  core::Progress progress;
  std::stop_source stop;
  Run run{1, threads, progress, stop.get_token()};
};

/// Of solvers that sample without end, where they do, until the run is asked to stop.
RadiositySettings without_end() {
  RadiositySettings settings;
  settings.form_factors = "analytic";
  settings.element_size = .6;
  settings.stopping.noise = 1e-7;
  return settings;
}

// The one at work is kept with its iterations, each the same as without a stop; those after it are named.
TEST(SolverComparison, that_is_stopped_keeps_what_there_is) {
  const scene::Scene scene = lit_room();
  StoppableRun run;
  std::jthread later;
  const std::string names[] = {"jacobi", "shooting-collision", "gmres", "southwell"};
  const SolverComparison parts =
      compare_solvers(scene, without_end(), names, std::nullopt, run.run, [&](const SolverScore& score) {
        if (score.solver == "jacobi")
          later = std::jthread([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(500));
            run.stop.request_stop();
          });
      });
  EXPECT_TRUE(parts.stopped());
  ASSERT_EQ(parts.scores.size(), 2u);
  EXPECT_EQ(parts.scores[0].why, "converged");
  EXPECT_FALSE(parts.scores[0].stopped);
  EXPECT_EQ(parts.scores[1].why, "asked to stop");
  EXPECT_TRUE(parts.scores[1].stopped);
  EXPECT_EQ(parts.left_out, (std::vector<std::string>{"gmres", "southwell"}));

  RadiositySettings as_far = without_end();
  as_far.stopping.max_iterations = static_cast<int>(parts.scores[1].history.size());
  ASSERT_GE(as_far.stopping.max_iterations, 1);
  core::LocalRun whole(1, 2);
  const SolverComparison again = compare_solvers(scene, as_far, std::span(names).subspan(1, 1), std::nullopt,
                                                 whole.get(), [](const SolverScore&) {});
  EXPECT_EQ(again.scores[0].history.back().error, parts.scores[1].history.back().error);
}

// Those that refuse have reached nothing.
TEST(SolverComparison, that_is_stopped_before_an_iteration_is_none) {
  const scene::Scene scene = lit_room();
  StoppableRun run;
  RadiositySettings settings = without_end();
  settings.projection = Projection::gauss_points;
  const std::string names[] = {"conjugate-gradients", "jacobi"};
  std::string why;
  EXPECT_THROW(compare_solvers(scene, settings, names, std::nullopt, run.run,
                               [&](const SolverScore& score) {
                                 why = score.why;
                                 run.stop.request_stop();
                               }),
               core::Interrupted);
  EXPECT_NE(why.find("symmetric"), std::string::npos) << why;
}

// The mean on the work plane of the room without a lamp, for as many rays from the lamp: rays drawn for it leave a
// third of the variance at most, and less for as many rays in all, those that find out what light is worth included.
TEST(SolverComparison, of_two_rooms_has_importance_lower_the_variance) {
  const scene::Scene scene = scene::read_scene(INTERFLECT_SOURCE_DIR "/data/scenes/two_rooms.json");
  Goal::AtPoints plane;
  for (const measure::SensorPoint& point : measure::sensor_points(scene))
    if (point.sensor == "dark_plane") plane.points.push_back(point.at);
  RadiositySettings settings;
  settings.element_size = .5;
  settings.stopping.samples = 200 * 4096;
  settings.solver_settings.replications = 200;
  core::LocalRun run(2, 2);
  const std::string names[] = {"stochastic-jacobi", "importance-driven-stochastic-jacobi", "shooting-collision",
                               "potential-driven"};
  const SolverComparison all =
      compare_solvers(scene, settings, names, Goal{"dark_plane", plane}, run.get(), [](const SolverScore&) {});
  std::vector<double> variance, work;
  for (const SolverScore& score : all.scores) {
    ASSERT_EQ(score.why, "converged") << score.solver;
    const SolverScore::At& last = score.history.back();
    EXPECT_LT(last.error, 4.5 * last.residual + .002) << score.solver;
    variance.push_back(last.residual * last.residual);
    work.push_back(variance.back() * last.rows);
  }
  EXPECT_GT(variance[0], 3 * variance[1]);
  EXPECT_GT(work[0], 1.3 * work[1]);
  EXPECT_GT(variance[2], 1.3 * variance[3]);
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
      const SolverComparison all = compare_solvers(scene, settings, solvers::solver_names(), std::nullopt, run.get(),
                                                   [&](const SolverScore&) { ++told; });
      EXPECT_EQ(told, std::ssize(solvers::solver_names()));
      EXPECT_GT(all.elements, 20);
      for (const SolverScore& score : all.scores) {
        if (score.history.empty()) {
          EXPECT_TRUE(may_refuse(score, projection, order)) << score.solver << ": " << score.why;
          continue;
        }
        EXPECT_EQ(score.why, "converged") << score.solver;
        const bool to_light = score.solver == "continuous-shooting";  // and not to what elements of .6 m make of it
        const double allowed = to_light ? .1 : score.samples ? 3 * score.history.back().residual : 1e-9;
        EXPECT_LT(score.history.back().error, allowed) << score.solver;
        if (!score.samples) {
          EXPECT_GT(score.history.front().error, score.history.back().error) << score.solver;
        }
        for (std::size_t k = 1; k < score.history.size(); ++k)
          EXPECT_GE(score.history[k].rows, score.history[k - 1].rows);
      }
    }
}

}  // namespace
}  // namespace interflect::fem
