#include "fem/progressive_radiosity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "fem/radiosity_method.h"
#include "scene/reader.h"
#include "solvers/bounce.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

using solvers::ColumnMatrix;
using test::Room;

/// A room with a lamp under its ceiling, a table, and a black plate on the floor.
scene::Scene furnished(double scale = 1) {
  Room room;
  const double s = scale;
  room.box({0, 0, 0}, {4 * s, 3 * s, 2.5 * s}, 1, true, .6);
  room.wall({1.5 * s, 1 * s, 2.4 * s}, {0, 1 * s, 0}, {1 * s, 0, 0}, 1, 0, 5);
  room.box({1 * s, 1 * s, .3 * s}, {1.5 * s, .8 * s, .1 * s}, 1, false, .3);
  room.wall({3 * s, 2 * s, .01 * s}, {.5 * s, 0, 0}, {0, .5 * s, 0}, 1, 0);
  return room.finish();
}

RadiositySettings settings_of(const char* method = "analytic", double size = .7) {
  RadiositySettings settings;
  settings.form_factors = method;
  settings.element_size = size;
  settings.solver = "progressive";
  settings.stopping.unshot = 0;
  settings.stopping.tolerance = 1e-7;
  return settings;
}

double relative_distance(std::span<const Spectrum> a, std::span<const Spectrum> b, const mesh::ElementMesh& mesh) {
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference += mesh.patches()[i].area * std::pow(a[i][0] - b[i][0], 2);
    size += mesh.patches()[i].area * b[i][0] * b[i][0];
  }
  return std::sqrt(difference / size);
}

// At the end it is what the matrix has, black receivers included, whatever the scale.
TEST(ProgressiveRadiosity, ends_where_a_matrix_does) {
  for (const double scale : {1e-6, 1., 1e6})
    for (const char* solver : {"progressive", "southwell"}) {
      const scene::Scene scene = furnished(scale);
      core::LocalRun run(1, 2);
      RadiositySettings settings = settings_of("analytic", 1.2 * scale);
      settings.solver = solver;
      ProgressiveRadiosity progressive(scene, settings, run.get());
      Shots shots = progressive.begin();
      const solvers::SolverReport report = progressive.advance(shots, [](const Shots&) {});
      ASSERT_EQ(report.why, solvers::SolverReport::Stopped::converged);
      const RadiositySolution shown = progressive.shown(shots, report);
      settings.solver = "automatic";
      const RadiositySolution solved = solve_radiosity(scene, settings, run.get());
      EXPECT_LT(relative_distance(shown.radiosity, solved.radiosity, shown.mesh), 1e-6);
      EXPECT_LT(relative_distance(shown.irradiance, solved.irradiance, shown.mesh), 1e-6);
    }
}

// On the way too: H is what was shot, and B = E + rho H of what is shown.
TEST(ProgressiveRadiosity, keeps_irradiance_true) {
  const scene::Scene scene = furnished();
  core::LocalRun run(1, 2);
  RadiositySettings settings = settings_of();
  settings.stopping.unshot = .02;
  ProgressiveRadiosity progressive(scene, settings, run.get());
  Shots shots = progressive.begin();
  progressive.advance(shots, [&](const Shots& now) {
    if (now.count() % 40 != 3) return;
    const ColumnMatrix r = solvers::residual_of(progressive.system(), now.state.x, run.get());
    EXPECT_LT((r - now.state.residual).cwiseAbs().maxCoeff(), 1e-13 * now.state.x.cwiseAbs().maxCoeff());
    const RadiositySolution shown = progressive.shown(now, {});
    for (std::size_t i = 0; i < shown.radiosity.size(); ++i)
      EXPECT_NEAR(shown.radiosity[i][0], shown.exitance[i][0] + shown.reflectance[i][0] * shown.irradiance[i][0],
                  1e-12 * 5);
  });
  EXPECT_GT(shots.count(), 100);
}

// Stopped anywhere, and gone on with: the same bits.
TEST(ProgressiveRadiosity, goes_on_to_the_same_bits) {
  const scene::Scene scene = furnished();
  for (const double overshoot : {0., .5}) {
    RadiositySettings settings = settings_of("gauss-lambert");
    settings.stopping.unshot = .02;
    settings.solver_settings.overshoot = overshoot;
    core::LocalRun run(5, 3);
    ProgressiveRadiosity whole(scene, settings, run.get());
    Shots at_once = whole.begin();
    whole.advance(at_once, [](const Shots&) {});
    std::stop_source stop;
    interflect::Run stopped{run.get().seed, run.get().threads, run.get().progress, stop.get_token()};
    ProgressiveRadiosity first(scene, settings, stopped);
    Shots shots = first.begin();
    const auto report = first.advance(shots, [&](const Shots& now) {
      if (now.count() == 17) stop.request_stop();
    });
    ASSERT_EQ(report.why, solvers::SolverReport::Stopped::asked_to);
    ASSERT_LE(shots.count(), 18);
    ASSERT_LT(shots.count(), at_once.count());
    ProgressiveRadiosity second(scene, settings, run.get());
    second.advance(shots, [](const Shots&) {});
    EXPECT_EQ(shots.count(), at_once.count());
    EXPECT_EQ(shots.state.x, at_once.state.x);
    EXPECT_EQ(shots.state.residual, at_once.state.residual);
    EXPECT_EQ(shots.irradiance, at_once.irradiance);
    EXPECT_EQ(shots.variance, at_once.variance);
    const Index before = shots.count();
    EXPECT_TRUE(second.advance(shots, [](const Shots&) {}).converged()) << "nothing is left to do";
    EXPECT_EQ(shots.count(), before);
  }
}

// Early pictures: after the lamp's elements have shot, and some more, the ambient term makes up for most of the rest.
TEST(ProgressiveRadiosity, shows_much_early) {
  const scene::Scene scene = furnished();
  core::LocalRun run(1, 2);
  RadiositySettings settings = settings_of("analytic", .35);
  ProgressiveRadiosity progressive(scene, settings, run.get());
  settings.solver = "automatic";
  const RadiositySolution solved = solve_radiosity(scene, settings, run.get());
  settings.solver = "progressive";
  settings.stopping.unshot = .2;
  Shots shots = progressive.begin();
  Index first = 0;
  progressive.advance(shots, [&](const Shots& now) {
    const RadiositySolution shown = progressive.shown(now, {});
    if (first == 0 && relative_distance(shown.irradiance, solved.irradiance, shown.mesh) < .1) first = now.count();
  });
  EXPECT_GT(first, 0);
  EXPECT_LE(first, progressive.emitting() + progressive.mesh().size() / 25);
}

// The office, to 10 % (L2 of H over what does not emit, with ambient) by no more rows than emitting elements and one in
// a hundred of all.
TEST(ProgressiveRadiosity, shows_the_office_by_few_rows) {
  const scene::Scene scene = scene::read_scene(std::string(INTERFLECT_SOURCE_DIR) + "/data/scenes/office.json");
  core::LocalRun run(1, 2);
  RadiositySettings settings;
  const RadiositySolution solved = solve_radiosity(scene, settings, run.get());
  settings.solver = "progressive";
  ProgressiveRadiosity progressive(scene, settings, run.get());
  const Index rows = progressive.emitting() + progressive.mesh().size() / 100;
  std::stop_source stop;
  interflect::Run stopped{run.get().seed, run.get().threads, run.get().progress, stop.get_token()};
  ProgressiveRadiosity few(scene, settings, stopped);
  Shots shots = few.begin();
  few.advance(shots, [&](const Shots& now) {
    if (now.count() == rows - 1) stop.request_stop();
  });
  ASSERT_LE(shots.count(), rows);
  const RadiositySolution shown = few.shown(shots, {});
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < shown.irradiance.size(); ++i) {
    if (!shown.exitance[i].is_zero()) continue;
    const double area = shown.mesh.patches()[i].area, H = scene.weigh(solved.irradiance[i]);
    difference += area * std::pow(scene.weigh(shown.irradiance[i]) - H, 2);
    size += area * H * H;
  }
  EXPECT_LT(std::sqrt(difference / size), .1);
}

// What it says of its errors holds, at any time, against elements a quarter the size, for nineteen of twenty elements.
TEST(ProgressiveRadiosity, states_errors_that_hold) {
  const scene::Scene scene = furnished();
  core::LocalRun run(1, 2);
  RadiositySettings fine = settings_of("analytic", .7 / 4);
  fine.solver = "automatic";
  const RadiositySolution truth = solve_radiosity(scene, fine, run.get());
  const auto rays = raycast::make_ray_caster("embree", scene);
  for (const char* method : {"analytic", "gauss-lambert"})
    for (const double unshot : {.3, .05, 1e-3}) {
      RadiositySettings settings = settings_of(method);
      settings.stopping.unshot = unshot;
      ProgressiveRadiosity progressive(scene, settings, run.get());
      Shots shots = progressive.begin();
      const auto report = progressive.advance(shots, [](const Shots&) {});
      const RadiositySolution shown = progressive.shown(shots, report);
      EXPECT_LE(progressive.unshot_fraction(shots), unshot);
      std::vector<measure::Measurement> elements;
      for (const scene::SurfacePatch& patch : shown.mesh.patches())
        elements.emplace_back(measure::PatchIrradiance{patch});
      const std::vector<Estimate> true_means = RadiosityMethod(truth, *rays).answer(scene, elements, run.get());
      double held = 0, width = 0, size = 0;
      for (std::size_t i = 0; i < shown.radiosity.size(); ++i) {
        const double mean = true_means[i].value[0], area = shown.mesh.patches()[i].area;
        const double bound = shown.irradiance_error[i][0] + normal_95 * shown.irradiance_noise[i][0];
        held += std::abs(shown.irradiance[i][0] - mean) <= bound;
        width += area * bound;
        size += area * mean;
      }
      EXPECT_GE(held, .95 * static_cast<double>(shown.radiosity.size())) << method << " " << unshot;
      EXPECT_LT(width, (.4 + 2 * unshot) * size) << method << " " << unshot;
    }
}

TEST(ProgressiveRadiosity, has_nothing_to_do_in_the_dark) {
  Room room;
  room.box({0, 0, 0}, {1, 1, 1}, 1, true, .5);
  const scene::Scene scene = room.finish();
  core::LocalRun run(1, 2);
  const RadiositySettings settings = settings_of();
  ProgressiveRadiosity progressive(scene, settings, run.get());
  Shots shots = progressive.begin();
  const auto report = progressive.advance(shots, [](const Shots&) {});
  EXPECT_TRUE(report.converged());
  EXPECT_TRUE(progressive.shown(shots, report).radiosity[0].is_zero());
}

TEST(ProgressiveRadiosity, refuses_what_it_cannot_have) {
  const scene::Scene scene = furnished();
  core::LocalRun run(1, 2);
  RadiositySettings polynomials = settings_of(), other = settings_of(), lines = settings_of("global-lines");
  polynomials.order = 1;
  other.solver = "jacobi";
  for (const RadiositySettings& settings : {polynomials, other, lines})
    EXPECT_THROW(ProgressiveRadiosity(scene, settings, run.get()), core::InputError);
  RadiositySettings tiny = settings_of();
  tiny.element_size = 1e-4;
  EXPECT_THROW(ProgressiveRadiosity(scene, tiny, run.get()), core::InputError) << "more elements than memory";
}

}  // namespace
}  // namespace interflect::fem
