#include "fem/ray_transitions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/sample_sequence.h"
#include "fem/radiosity_operator.h"
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

// Counts of 40 000 draws from each element against analytic form factors: within five standard errors of a binomial, and
// their chi² over all pairs that can expect ten of them as large as it should be.
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
  const solvers::System system{*K, R, e, &transitions};
  solvers::SolverState exact{e};
  solvers::make_solver("automatic")->advance(system, exact, {}, run);
  for (const std::string& name : solvers::solver_names(true)) {
    solvers::SolverState state{e};
    solvers::StoppingRule rule;
    rule.noise = 1e-2;
    solvers::make_solver(name)->advance(system, state, rule, run);
    for (Index i = 0; i < K->size(); ++i)
      EXPECT_NEAR(state.x(i, 0), exact.x(i, 0), 5 * state.standard_error(i, 0) + 1e-3 * exact.x(i, 0)) << name << i;
  }
}

/// Slope of log2 of the error of one bounce against log2 of the rays, 2^10 .. 2^18, and its standard error; errors are root
/// mean squares over the elements of a cube and 24 replications.
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
  const double t = solvers::student_t(.95, 7);
  const auto [independent, error_of_independent] = slope_of("independent");
  EXPECT_NEAR(independent, -.5, t * error_of_independent + .01);
  const auto [sobol, error_of_sobol] = slope_of("sobol");
  EXPECT_LT(sobol + t * error_of_sobol, -.55) << sobol;
}

}  // namespace
}  // namespace interflect::fem
