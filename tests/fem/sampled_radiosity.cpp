#include "fem/sampled_radiosity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "fem/error_estimate.h"
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

/// Of the order, by analytic form factors where there is a matrix.
RadiositySettings of_order(int order, const std::string& solver, double size) {
  RadiositySettings settings = settings_of(solver, size);
  settings.order = order;
  settings.quadrature_tolerance = 1e-5;
  return settings;
}

// Polynomials against the matrix: coefficients of irradiance within what they state, chi² as it should be, also of what
// reflects nothing; means, and what the field has at points.
TEST(SampledRadiosity, of_polynomials_is_what_the_matrix_says) {
  const scene::Scene scene = furnished();
  core::LocalRun run(4, 2);
  for (const int order : {1, 2, 3}) {
    const RadiositySolution exact = solve_radiosity(scene, of_order(order, "automatic", .5), run);
    for (const char* solver : {"stochastic-jacobi", "regular-stochastic-jacobi"}) {
      RadiositySettings by_rays = of_order(order, solver, .5);
      by_rays.stopping.noise = .04;
      const RadiositySolution found = solve_radiosity(scene, by_rays, run);
      EXPECT_TRUE(found.solver.converged());
      ASSERT_TRUE(found.field && exact.field);
      ASSERT_EQ(found.field->irradiance.rows(), exact.field->irradiance.rows());
      const double most = exact.field->irradiance.cwiseAbs().maxCoeff();
      double squares = 0;
      for (Index a = 0; a < exact.field->irradiance.rows(); ++a) {
        const double off = std::abs(found.field->irradiance(a, 0) - exact.field->irradiance(a, 0)),
                     stated = found.field->irradiance_noise(a, 0);
        EXPECT_LE(off, 6 * stated + 1e-3 * most) << solver << order << ' ' << a;
        squares += off * off / (stated * stated + 1e-7 * most * most);
      }
      squares /= static_cast<double>(exact.field->irradiance.rows());
      EXPECT_GT(squares, .5) << solver << order;
      EXPECT_LT(squares, 1.6) << solver << order;
      for (std::size_t i = 0; i < found.irradiance.size(); ++i) {
        const Vec3 x = found.mesh.patches()[i].centroid();
        const double noise = found.reflectance[i][0] * found.field->noise_at(i, x)[0];
        EXPECT_NEAR(found.field->at(i, x)[0], exact.field->at(i, x)[0], 6 * noise + 2e-3 * most) << solver << order;
        EXPECT_NEAR(found.radiosity[i][0], found.exitance[i][0] + found.reflectance[i][0] * found.irradiance[i][0],
                    1e-12 * most);
      }
    }
  }
}

// Errors of discretisation are what the highest degree brings: in 95 % of elements, against a matrix of finer ones of
// the same order; and they fall from order to order.
TEST(SampledRadiosity, of_polynomials_states_errors_that_hold) {
  const scene::Scene scene = furnished();
  core::LocalRun run(4, 2);
  const RadiositySolution truth = solve_radiosity(scene, of_order(2, "automatic", .25), run);
  const auto rays = raycast::make_ray_caster("embree", scene);
  const auto mean_error = [&](int order) {
    RadiositySettings settings = of_order(order, "regular-stochastic-jacobi", .5);
    settings.stopping.noise = .01;
    const RadiositySolution found = solve_radiosity(scene, settings, run);
    std::vector<measure::Measurement> elements;
    for (const scene::SurfacePatch& patch : found.mesh.patches())
      elements.emplace_back(measure::PatchIrradiance{patch});
    const std::vector<Estimate> means = RadiosityMethod(truth, *rays).answer(scene, elements, run.get());
    int held = 0;
    for (std::size_t i = 0; i < found.irradiance.size(); ++i)
      if (std::abs(found.irradiance[i][0] - means[i].value[0]) <=
          found.irradiance_error[i][0] + 2 * found.irradiance_noise[i][0])
        ++held;
    EXPECT_GE(held, .95 * static_cast<double>(found.irradiance.size())) << order;
    return area_mean(found.mesh, found.irradiance_error)[0];
  };
  const double of_first = mean_error(1), of_second = mean_error(2);
  EXPECT_LT(of_second, of_first);
  EXPECT_LT(of_first, .2 * area_mean(truth.mesh, truth.irradiance)[0]);
}

// At points the noise of all coefficients is stated: over 20 seeds, of points on a plane within the room.
TEST(SampledRadiosity, of_polynomials_states_noise_at_points) {
  const scene::Scene scene = furnished();
  core::LocalRun first(1, 2);
  const auto rays = raycast::make_ray_caster("embree", scene);
  std::vector<measure::Measurement> points;
  for (const double x : {.2, .6, 1.4, 1.8}) points.emplace_back(measure::PointIrradiance{{x, .15, .5}, {0, 0, 1}, {}});
  const RadiositySolution exact = solve_radiosity(scene, of_order(1, "automatic", .5), first);
  const std::vector<Estimate> truth = RadiosityMethod(exact, *rays).answer(scene, points, first.get());
  double squares = 0;
  constexpr int seeds = 20;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    core::LocalRun run(seed, 2);
    const RadiositySolution found = solve_radiosity(scene, of_order(1, "stochastic-jacobi", .5), run);
    const std::vector<Estimate> estimates = RadiosityMethod(found, *rays).answer(scene, points, run.get());
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double off = estimates[k].value[0] - truth[k].value[0], stated = estimates[k].standard_error[0];
      squares += off * off / (stated * stated) / static_cast<double>(seeds * points.size());
    }
  }
  EXPECT_LT(squares, 1.6);
  EXPECT_GT(squares, .2);
}

// At corners of elements, of which those near the lamp have light fall on one end: the noise that is stated is no less
// than what 20 seeds have, chi² / 20 of each below 2.4 (5e-4 above), and 1 in the mean.
TEST(SampledRadiosity, of_polynomials_states_noise_at_corners) {
  Room room;
  room.box({0, 0, 0}, {2, 1, 1}, 1, true, .6);
  room.wall({.98, .45, .98}, {0, .1, 0}, {.1, 0, 0}, 1, 0, 100);
  room.wall({.02, .02, .1}, {0, .05, 0}, {.05, 0, 0}, 1, 0, 100);
  const scene::Scene scene = room.finish();
  core::LocalRun first(1, 2);
  const RadiositySolution exact = solve_radiosity(scene, of_order(2, "automatic", .7), first);
  constexpr int seeds = 20;
  std::vector<double> squares;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    core::LocalRun run(seed, 2);
    RadiositySettings by_rays = of_order(2, "stochastic-jacobi", .7);
    by_rays.stopping.noise = .05;
    const RadiositySolution found = solve_radiosity(scene, by_rays, run);
    std::size_t k = 0;
    for (std::size_t i = 0; i < found.irradiance.size(); ++i)
      for (const Vec3& x : found.mesh.patches()[i].ring()) {
        const double off = found.field->irradiance_at(i, x)[0] - exact.field->irradiance_at(i, x)[0],
                     stated = found.field->noise_at(i, x)[0];
        if (seed == 1) squares.push_back(0);
        squares[k++] += off * off / (stated * stated) / seeds;
      }
  }
  double mean = 0;
  for (const double each : squares) {
    EXPECT_LT(each, 2.4);
    mean += each / static_cast<double>(squares.size());
  }
  EXPECT_LT(mean, 1);
  EXPECT_GT(mean, .05);
}

// The same bits by any threads; and the same light at any scale.
TEST(SampledRadiosity, of_polynomials_is_the_same_at_any_scale_and_for_any_threads) {
  const auto solved = [](double scale, unsigned threads) {
    core::LocalRun run(7, threads);
    RadiositySettings settings = of_order(2, "stochastic-jacobi", .5 * scale);
    settings.stopping.noise = .05;
    return solve_radiosity(furnished(scale), settings, run);
  };
  const RadiositySolution one = solved(1, 1);
  for (const unsigned threads : {2u, 3u, 8u}) {
    const RadiositySolution again = solved(1, threads);
    EXPECT_EQ(again.field->irradiance, one.field->irradiance);
    EXPECT_EQ(again.field->irradiance_noise, one.field->irradiance_noise);
    EXPECT_EQ(again.irradiance_error, one.irradiance_error);
  }
  for (const double scale : {1e-6, 1e6}) {
    const RadiositySolution scaled = solved(scale, 2);
    for (std::size_t i = 0; i < one.irradiance.size(); ++i)
      EXPECT_NEAR(scaled.irradiance[i][0], one.irradiance[i][0], 8 * one.irradiance_noise[i][0]) << scale << ' ' << i;
  }
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
  RadiositySettings of = settings_of("shooting-collision");
  of.order = 1;
  EXPECT_NE(complaint(of).find("'stochastic-jacobi' would do"), std::string::npos);
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
