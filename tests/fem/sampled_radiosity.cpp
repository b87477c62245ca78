#include "fem/sampled_radiosity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "fem/radiosity_method.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

using test::Room;

/// A room with a box, a lamp that reflects nothing, and a black wall.
scene::Scene furnished(double scale = 1) {
  Room room;
  room.box({0, 0, 0}, Vec3(2, 1, 1) * scale, 1, true, .6, 0);
  room.box(Vec3(.8, .3, .1) * scale, Vec3(.4, .3, .3) * scale, 1, false, .4);
  room.wall(Vec3(.5, .3, .98) * scale, Vec3(0, .4, 0) * scale, Vec3(.4, 0, 0) * scale, 1, 0, 5);
  room.wall(Vec3(.02, .2, .2) * scale, Vec3(0, .5, 0) * scale, Vec3(0, 0, .5) * scale, 1, 0);
  return room.finish();
}

RadiositySettings settings_of(const std::string& solver, double size = .25) {
  RadiositySettings settings;
  settings.solver = solver;
  settings.element_size = size;
  settings.form_factors = "analytic";
  settings.stopping.noise = .02;
  return settings;
}

using Needs = solvers::SolverEntry::Needs;
bool by_survival(const std::string& solver) { return solver.find("survival") != std::string::npos; }

// Every solver that samples against the matrix: the chi² of deviations in what they state is as it should be, also of
// what reflects nothing.
TEST(SampledRadiosity, is_what_the_matrix_says) {
  const scene::Scene scene = furnished();
  core::LocalRun run(4, 2);
  const RadiositySolution exact = solve_radiosity(scene, settings_of("automatic"), run);
  for (const std::string& solver : solvers::solver_names({Needs::walks, Needs::lines})) {
    if (by_survival(solver)) continue;
    const RadiositySolution found = solve_radiosity(scene, settings_of(solver), run);
    ASSERT_EQ(found.irradiance.size(), exact.irradiance.size());
    EXPECT_TRUE(found.solver.converged());
    EXPECT_GT(found.pairs.rays, 1000u);
    double squares = 0;
    for (std::size_t i = 0; i < found.irradiance.size(); ++i) {
      const double off = found.irradiance[i][0] - exact.irradiance[i][0], stated = found.irradiance_noise[i][0];
      EXPECT_LE(std::abs(off), 6 * stated + 2e-3 * exact.irradiance[i][0]) << solver << i;
      EXPECT_NEAR(found.radiosity[i][0], found.exitance[i][0] + found.reflectance[i][0] * found.irradiance[i][0],
                  1e-12);
      squares += off * off / (stated * stated) / static_cast<double>(found.irradiance.size());
    }
    EXPECT_GT(squares, .6) << solver;
    EXPECT_LT(squares, 1.6) << solver;
    const EnergyBalance& energy = found.energy;
    EXPECT_NEAR(energy.residual[0], 0, .03 * energy.emitted[0]) << solver;
    EXPECT_EQ(energy.form_factor_error[0], 0);
  }
}

// Means of a whole surface have an error that holds too, by what the room's power as a whole varies by: of 40 seeds
// 95 %.
TEST(SampledRadiosity, knows_what_elements_share) {
  const scene::Scene scene = furnished();
  core::LocalRun first(1, 2);
  const RadiositySolution exact = solve_radiosity(scene, settings_of("automatic", .5), first);
  for (const char* solver : {"shooting-collision", "stochastic-jacobi"}) {
    int held = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      core::LocalRun run(seed, 2);
      const RadiositySolution found = solve_radiosity(scene, settings_of(solver, .5), run);
      double off = 0, area = 0, own = 0;
      for (std::size_t i = 0; i < found.irradiance.size(); ++i) {
        const double A = found.mesh.patches()[i].area;
        off += A * (found.irradiance[i][0] - exact.irradiance[i][0]);
        own += A * A * found.own_variance(i)[0];
        area += A;
      }
      const double stated = std::sqrt(own / (area * area) + found.shared_noise[0] * found.shared_noise[0]);
      if (std::abs(off / area) <= 2.04 * stated + 1e-3 * exact.irradiance[0][0]) ++held;
    }
    EXPECT_GE(held, 34) << solver;
  }
}

TEST(SampledRadiosity, is_the_same_at_any_scale_and_for_any_threads) {
  RadiositySolution first = [&] {
    core::LocalRun run(7, 1);
    return solve_radiosity(furnished(), settings_of("regular-stochastic-jacobi"), run);
  }();
  for (const unsigned threads : {2u, 3u}) {
    core::LocalRun run(7, threads);
    const RadiositySolution again = solve_radiosity(furnished(), settings_of("regular-stochastic-jacobi"), run);
    EXPECT_EQ(again.irradiance, first.irradiance);
    EXPECT_EQ(again.irradiance_noise, first.irradiance_noise);
  }
  for (const double scale : {1e-6, 1e6}) {
    core::LocalRun run(7, 2);
    const RadiositySolution scaled =
        solve_radiosity(furnished(scale), settings_of("regular-stochastic-jacobi", .25 * scale), run);
    for (std::size_t i = 0; i < first.irradiance.size(); ++i)
      EXPECT_NEAR(scaled.irradiance[i][0], first.irradiance[i][0], 8 * first.irradiance_noise[i][0])
          << scale << ' ' << i;
  }
}

// Errors of discretisation are estimated from what irradiance varies by, noise subtracted, where noise is little,
// inside them and in those that they see: 95 % of elements are within. The others are the underside of the box, which
// sees nothing but the edge of a shadow that elements of the floor are too large for, and is off by 1.2 to 1.6 times
// what is stated.
TEST(SampledRadiosity, states_errors_that_hold) {
  const scene::Scene scene = furnished();
  core::LocalRun run(4, 2);
  RadiositySettings coarse = settings_of("regular-stochastic-jacobi", .5);
  coarse.stopping.noise = .004;
  const RadiositySolution found = solve_radiosity(scene, coarse, run);
  const RadiositySolution truth = solve_radiosity(scene, settings_of("automatic", .125), run);
  const auto rays = raycast::make_ray_caster("embree", scene);
  std::vector<measure::Measurement> elements;
  for (const scene::SurfacePatch& patch : found.mesh.patches()) elements.emplace_back(measure::PatchIrradiance{patch});
  const std::vector<Estimate> true_means = RadiosityMethod(truth, *rays).answer(scene, elements, run.get());
  int held = 0;
  for (std::size_t i = 0; i < found.irradiance.size(); ++i) {
    const double off = std::abs(found.irradiance[i][0] - true_means[i].value[0]);
    if (off <= found.irradiance_error[i][0] + 2 * found.irradiance_noise[i][0]) ++held;
  }
  EXPECT_GE(held, .95 * static_cast<double>(found.irradiance.size()));
}

TEST(SampledRadiosity, has_light_groups) {
  const scene::Scene scene = furnished();
  core::LocalRun run(4, 2);
  RadiositySettings settings = settings_of("stochastic-jacobi");
  settings.light_groups = true;
  const RadiositySolution s = solve_radiosity(scene, settings, run);
  ASSERT_EQ(s.of_groups.size(), 1u);
  for (std::size_t i = 0; i < s.irradiance.size(); ++i)
    EXPECT_NEAR(s.of_groups[0].irradiance[i][0], s.irradiance[i][0], 6 * s.irradiance_noise[i][0] + 1e-9);
}

TEST(SampledRadiosity, refuses_what_it_cannot_do) {
  const scene::Scene scene = furnished();
  core::LocalRun run;
  const auto complaint = [&](RadiositySettings settings) {
    try {
      forecast(scene, settings, run);
      solve_radiosity(scene, settings, run);
    } catch (const core::InputError& error) {
      EXPECT_EQ(core::single_line(error.what()), error.what());
      return std::string(error.what());
    }
    return std::string();
  };
  RadiositySettings of = settings_of("stochastic-jacobi");
  of.order = 1;
  EXPECT_NE(complaint(of).find("polynomials"), std::string::npos);
  of = settings_of("stochastic-jacobi");
  of.closure = "scaling";
  EXPECT_NE(complaint(of).find("closure"), std::string::npos);
  EXPECT_NE(complaint(settings_of("adjoint")).find("--goal"), std::string::npos);
  EXPECT_NE(complaint(settings_of("shooting-survival")).find("shooting-collision"), std::string::npos);
  EXPECT_NE(complaint(settings_of("control-variate-stochastic-jacobi")).find("closed"), std::string::npos);
}

// Its rounds are tried until a quarter of a second has gone by, and those to come are told from how the noise fell:
// within a factor of five on a machine that does other work meanwhile.
TEST(SampledRadiosity, is_forecast_by_what_it_takes) {
  const scene::Scene scene = furnished();
  core::LocalRun run(4, 2);
  RadiositySettings settings = settings_of("stochastic-jacobi");
  settings.stopping.noise = 2.5e-3;
  const double about = forecast(scene, settings, run).seconds;
  const solvers::SolverReport taken = solve_radiosity(scene, settings, run).solver;
  EXPECT_GT(about, .2 * taken.history.back().seconds);
  EXPECT_LT(about, 5 * taken.history.back().seconds);
}

TEST(SampledRadiosity, of_darkness_is_darkness) {
  Room room;
  room.box({0, 0, 0}, {1, 1, 1}, 1, true, .5);
  core::LocalRun run;
  const RadiositySolution s = solve_radiosity(room.finish(), settings_of("stochastic-jacobi"), run);
  for (std::size_t i = 0; i < s.irradiance.size(); ++i) {
    EXPECT_EQ(s.irradiance[i][0], 0);
    EXPECT_EQ(s.irradiance_noise[i][0], 0);
  }
}

}  // namespace
}  // namespace interflect::fem
