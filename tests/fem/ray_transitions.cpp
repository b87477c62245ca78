#include "fem/ray_transitions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/sample_sequence.h"
#include "core/student_t.h"
#include "fem/element_materials.h"
#include "fem/radiosity_operator.h"
#include "fem/space/polynomials.h"
#include "solvers/power_transfer.h"
#include "solvers/replications.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

using test::Room;

/// A room of unequal elements with a body, and an opening.
struct Furnished {
  Furnished() {
    Room room;
    room.wall({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, 2, .3);
    room.wall({0, 0, 1}, {0, 1, 0}, {2, 0, 0}, 1, .8);
    room.wall({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 2, .5, 1);
    room.wall({2, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1, .7);
    room.wall({0, 0, 0}, {0, 0, 1}, {2, 0, 0}, 1, .6);  // y = 1 is open
    room.box({.8, .3, .1}, {.4, .3, .3}, 1, false, .4);
    room.triangle({.1, .2, .5}, {.4, .2, .6}, {.2, .7, .7}, .5);
    scene = room.finish();
    patches = room.patches;
    rays = raycast::make_ray_caster("embree", scene);
  }
  scene::Scene scene;
  std::vector<scene::SurfacePatch> patches;
  std::unique_ptr<raycast::RayCaster> rays;
};

// Counts of 40 000 draws from each element against analytic form factors: within five standard errors of a binomial,
// and their chi² over all pairs that can expect ten of them as large as it should be.
TEST(RayTransitions, have_form_factors_for_probabilities) {
  const Furnished room;
  const RayTransitions transitions(room.patches, *room.rays);
  RadiositySettings settings;
  settings.form_factors = "analytic";
  settings.quadrature_tolerance = 1e-6;
  core::LocalRun run(1, 2);
  const auto K = assemble_operator(room.scene, room.patches, *room.rays, settings, run.get()).K;
  const auto sequence = core::make_sequence("independent", 9);
  constexpr std::uint64_t n = 40000;
  double chi_squared = 0, pairs = 0;
  for (Index i = 0; i < K->size(); ++i) {
    std::vector<double> counts(room.patches.size());
    for (std::uint64_t k = 0; k < n; ++k) {
      double u[4];
      sequence->point(k + n * static_cast<std::uint64_t>(i), u);
      if (const auto j = transitions.from_element(i, u)) ++counts[static_cast<std::size_t>(*j)];
    }
    for (Index j = 0; j < K->size(); ++j) {
      const double F = K->entry(i, j) / room.patches[static_cast<std::size_t>(i)].area,
                   deviation = counts[static_cast<std::size_t>(j)] - n * F;
      EXPECT_LE(std::abs(deviation), 5 * std::sqrt(n * F) + 2) << i << ' ' << j;
      if (n * F < 10) continue;
      chi_squared += deviation * deviation / (n * F * (1 - F));
      ++pairs;
    }
  }
  EXPECT_GT(pairs, 100);
  EXPECT_NEAR(chi_squared / pairs, 1, 5 * std::sqrt(2 / pairs));
}

TEST(RayTransitions, lead_to_the_same_one_by_one_and_many_at_once) {
  const Furnished room;
  const RayTransitions transitions(room.patches, *room.rays);
  const auto sequence = core::make_sequence("independent", 10);
  constexpr std::size_t n = 200;
  std::vector<double> u(4 * n);
  sequence->points(0, 4, u);
  std::vector<Index> from(n), arrived(n);
  for (std::size_t k = 0; k < n; ++k) from[k] = static_cast<Index>(k % room.patches.size());
  transitions.from_elements(from, u, arrived);
  std::size_t nowhere = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const auto one = transitions.from_element(from[k], std::span(u).subspan(4 * k, 4));
    EXPECT_EQ(arrived[k], one.value_or(solvers::TransitionSampler::nowhere)) << k;
    nowhere += !one;
  }
  EXPECT_GT(nowhere, 5u);
}

// Random walks by rays arrive where the matrix does, within what they state, and its own tolerance of 1e-3.
TEST(RayTransitions, lead_random_walks_to_the_solution) {
  const Furnished room;
  const RayTransitions transitions(room.patches, *room.rays);
  RadiositySettings settings;
  settings.form_factors = "analytic";
  core::LocalRun run(1, 2);
  const auto K = assemble_operator(room.scene, room.patches, *room.rays, settings, run.get()).K;
  solvers::ColumnMatrix e(K->size(), 1), rho(K->size(), 1);
  for (Index i = 0; i < K->size(); ++i) {
    const scene::Material& material = room.scene.material(room.patches[static_cast<std::size_t>(i)].surface);
    e(i, 0) = material.exitance_of(scene::Side::front)[0];
    rho(i, 0) = material.reflectance_of(scene::Side::front)[0];
  }
  const solvers::Reflection R(rho);
  const std::vector<double> all(static_cast<std::size_t>(K->size()), 1);
  const solvers::System system{*K, R, e, &transitions}, asked{*K, R, e, &transitions, all};
  solvers::SolverState exact{e};
  solvers::make_solver("automatic")->advance(system, exact, {}, run);
  using Needs = solvers::SolverEntry::Needs;
  for (const std::string& name : solvers::solver_names({Needs::walks, Needs::lines, Needs::target})) {
    solvers::SolverState state{e};
    solvers::StoppingRule rule;
    rule.noise = 1e-2;
    const bool asks = solvers::solver_named(name).needs == Needs::target;
    solvers::make_solver(name)->advance(asks ? asked : system, state, rule, run);
    for (Index i = 0; i < K->size(); ++i)
      EXPECT_NEAR(state.x(i, 0), exact.x(i, 0), 5 * state.standard_error(i, 0) + 1e-3 * exact.x(i, 0)) << name << i;
  }
}

/// The room's equations for polynomials.
struct PolynomialEquations {
  PolynomialEquations(const Furnished& room, int order, core::LocalRun& run) : walks(room.patches, *room.rays, order) {
    RadiositySettings settings;
    settings.form_factors = "analytic";
    settings.order = order;
    settings.quadrature_tolerance = 1e-5;
    from = assemble_operator(room.scene, room.patches, *room.rays, settings, run.get());
    const auto [exitance, reflectance] = materials_of(room.scene, room.patches);
    const std::vector<int> degree(room.patches.size(), order);
    MaterialColumns columns = on_functions(exitance, reflectance, 1, degree, plane_functions(order));
    e = std::move(columns.e);
    R.emplace(std::move(columns.R));
  }
  solvers::System system() const { return {*from.blocks, *R, e, &walks}; }
  RadiosityOperator from;
  solvers::ColumnMatrix e;
  std::optional<solvers::Reflection> R;
  RayTransitions walks;
};

// Linear and quadratic functions by rays: coefficients of B_h within what they state, and the matrix's tolerance.
TEST(RayTransitions, solve_for_polynomials) {
  const Furnished room;
  for (const int order : {1, 2})
    for (const char* name : {"stochastic-jacobi", "regular-stochastic-jacobi"}) {
      core::LocalRun run(3, 2);
      const PolynomialEquations equations(room, order, run);
      const solvers::System system = equations.system();
      solvers::SolverState exact{system.e}, state{system.e};
      solvers::make_solver("automatic")->advance(system, exact, {}, run);
      solvers::StoppingRule rule;
      rule.noise = .02;
      const auto report = solvers::make_solver(name)->advance(system, state, rule, run);
      EXPECT_TRUE(report.converged());
      const double most = exact.x.cwiseAbs().maxCoeff();
      double squares = 0;
      for (Index a = 0; a < system.e.rows(); ++a) {
        const double off = std::abs(state.x(a, 0) - exact.x(a, 0)), stated = state.standard_error(a, 0);
        EXPECT_LE(off, 5 * stated + 1e-4 * most) << name << order << ' ' << a;
        squares += off * off / (stated * stated + 1e-8 * most * most) / static_cast<double>(system.e.rows());
      }
      EXPECT_GT(squares, .5) << "errors are no larger than they need be";
      EXPECT_LT(squares, 1.5);
    }
}

// What arrives is spread over an element before it leaves, in the equations and in discrete walks; a continuous walk
// goes on from where it is.  Its means are those of light: of fine elements, averaged.  A room three times as long as
// wide, an element a wall, and light at one end.
TEST(RayTransitions, go_on_from_points_to_what_light_does) {
  const auto solved = [](int n, const char* solver) {
    Room room;
    room.box({0, 0, 0}, {1, 1, 3}, n, true, .7);
    const scene::Scene scene = room.finish();
    const auto rays = raycast::make_ray_caster("embree", scene);
    const RayTransitions walks(room.patches, *rays);
    RadiositySettings settings;
    settings.form_factors = "analytic";
    core::LocalRun run(6, 2);
    const auto K = assemble_operator(scene, room.patches, *rays, settings, run.get()).K;
    solvers::ColumnMatrix e = solvers::ColumnMatrix::Zero(K->size(), 1);
    const solvers::Reflection R(solvers::ColumnMatrix::Constant(K->size(), 1, .7));
    for (Index i = 0; i < K->size(); ++i)
      if (room.patches[std::size_t(i)].normal().z() > .5) e(i, 0) = 1;
    solvers::SolverState state{e};
    solvers::StoppingRule rule;
    rule.noise = 1e-3;
    solvers::make_solver(solver)->advance({*K, R, e, &walks}, state, rule, run);
    // the mean of the far wall, and its error
    double sum = 0, area = 0, squares = 0;
    for (Index i = 0; i < K->size(); ++i) {
      const auto& patch = room.patches[std::size_t(i)];
      if (patch.normal().z() > -.5) continue;
      sum += patch.area * state.x(i, 0), area += patch.area;
      if (state.standard_error.size() > 0) squares += std::pow(patch.area * state.standard_error(i, 0), 2);
    }
    return std::pair(sum / area, std::sqrt(squares) / area);
  };
  const double coarse = solved(1, "automatic").first, fine = solved(12, "automatic").first;
  const auto [continuous, error] = solved(1, "continuous-shooting");
  const auto [discrete, of_discrete] = solved(1, "shooting-collision");
  EXPECT_NEAR(discrete, coarse, 4.5 * of_discrete);
  EXPECT_NEAR(continuous, fine, 4.5 * error + .01 * fine) << "the equations' own error at a twelfth is that much";
  EXPECT_GT(coarse, 1.7 * fine);
}

/// Slope of log2 of the error of one bounce against log2 of the rays, 2^10 .. 2^18, and its standard error; errors are
/// root mean squares over the elements of a cube and 24 replications.
std::pair<double, double> slope_of(const std::string& name) {
  Room room;
  room.box({0, 0, 0}, {1, 1, 1}, 2, true, .6);
  const scene::Scene scene = room.finish();
  const auto rays = raycast::make_ray_caster("embree", scene);
  const RayTransitions transitions(room.patches, *rays);
  RadiositySettings settings;
  settings.form_factors = "analytic";
  settings.quadrature_tolerance = 1e-9;
  core::LocalRun run(1, 2);
  const auto K = assemble_operator(scene, room.patches, *rays, settings, run.get()).K;
  const Index n = K->size();
  const solvers::ColumnMatrix rho = solvers::ColumnMatrix::Constant(n, 1, .6);
  const solvers::Reflection R(rho);
  const solvers::System system{*K, R, rho, &transitions};
  solvers::ColumnMatrix power(n, 1), exact(n, 1);
  for (Index i = 0; i < n; ++i) power(i, 0) = 1. + static_cast<double>(i % 5);
  K->apply(power, exact, run);
  exact *= .6 / room.patches[0].area;
  const solvers::PowerTransfer transfer(system, power);
  constexpr int lowest = 10, highest = 18, replications = 24;
  std::vector<double> x, y;
  const auto sequence = core::make_sequence(name, 4);
  for (int bits = lowest; bits <= highest; ++bits) {
    double squares = 0;
    for (std::uint64_t r = 0; r < replications; ++r) {
      solvers::ColumnMatrix found = solvers::ColumnMatrix::Zero(n, 1);
      transfer.add(*sequence->replicate(r), 0, std::uint64_t{1} << bits, 1, found);
      squares += (found - exact).squaredNorm();
    }
    x.push_back(bits);
    y.push_back(.5 * std::log2(squares));
  }
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0, left = 0;
  const auto count = static_cast<double>(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) mean_x += x[k] / count, mean_y += y[k] / count;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - mean_x) * (x[k] - mean_x);
    xy += (x[k] - mean_x) * (y[k] - mean_y);
  }
  for (std::size_t k = 0; k < x.size(); ++k) left += std::pow(y[k] - mean_y - xy / xx * (x[k] - mean_x), 2);
  return {xy / xx, std::sqrt(left / (count - 2) / xx)};
}

// The 95 % interval of Sobol's slope is below -0.55; independent rays have -0.5.
TEST(RayTransitions, of_sobol_points_are_better_than_independent_ones) {
  const double t = core::student_t(.95, 7);
  const auto [independent, error_of_independent] = slope_of("independent");
  EXPECT_NEAR(independent, -.5, t * error_of_independent + .01);
  const auto [sobol, error_of_sobol] = slope_of("sobol");
  EXPECT_LT(sobol + t * error_of_sobol, -.55) << sobol;
}

}  // namespace
}  // namespace interflect::fem
