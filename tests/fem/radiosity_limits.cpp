#include <gtest/gtest.h>

#include <functional>

#include "core/error.h"
#include "fem/radiosity.h"
#include "fem/solver_comparison.h"
#include "tests/fem/emitting_cube.h"
#include "tests/fem/rooms.h"
#include "tests/support/shapes.h"

// What is forecast of a solution, and refused: before the work.
namespace interflect::fem {
namespace {

using test::cube;

TEST(Radiosity, refuses_what_it_cannot_do_in_one_line) {
  const auto scene = cube(.5);
  core::LocalRun run(1, 1);
  RadiositySettings settings;
  settings.element_size = 1e-3;
  EXPECT_THROW(forecast(scene, settings, run.get()), core::InputError);
  try {
    forecast(scene, settings, run.get());
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("--element-size"), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
  settings.element_size = .5;
  settings.form_factors = "by magic";
  EXPECT_THROW(solve_radiosity(scene, settings, run.get()), core::InputError);
  settings.form_factors = RadiositySettings().form_factors;
  settings.closure = "by decree";
  EXPECT_THROW(solve_radiosity(scene, settings, run.get()), core::InputError);
}

// A row that adds up to more than 1 is none of view factors, wherever it comes from.
TEST(Radiosity, refuses_rows_that_send_more_than_there_is) {
  const auto scene = cube(.5);
  core::LocalRun run(1, 1);
  RadiositySettings settings;
  settings.element_size = .5;
  const auto scaled_by = [&](double factor) {
    settings.stored_factors = [factor](const scene::Scene&, std::span<const scene::SurfacePatch> patches,
                                       ExchangeSink& sink) {
      double area = 0;
      for (const auto& patch : patches) area += patch.area;
      for (std::size_t i = 0; i < patches.size(); ++i)
        for (std::size_t j = i + 1; j < patches.size(); ++j)
          sink.add(Index(i), Index(j), {factor * patches[i].area * patches[j].area / area, 0, 0});
    };
    return settings;
  };
  const std::vector<std::string> jacobi{"jacobi"};
  const std::function<void(const RadiositySettings&)> commands[] = {
      [&](const RadiositySettings& asked) { solve_radiosity(scene, asked, run.get()); },
      [&](const RadiositySettings& asked) {
        compare_solvers(scene, asked, jacobi, {}, run.get(), [](const SolverScore&) {});
      }};
  for (const auto& command : commands) {
    EXPECT_NO_THROW(command(scaled_by(1.05)));
    try {
      command(scaled_by(1.3));
      ADD_FAILURE() << "1.25 leaves each element";
    } catch (const core::InputError& error) {
      EXPECT_NE(std::string(error.what()).find("no more than 1 can be"), std::string::npos) << error.what();
    }
  }
}

// Facets that a mesh brings are elements whatever the size: the way out that is named must be one.
TEST(Radiosity, refuses_too_many_elements_with_a_way_out_that_works) {
  scene::SceneBuilder builder({"y"});
  builder.add_facets("ball", interflect::test::icosphere(4, 1, true), builder.add_material(test::diffuse(.5)));
  const scene::Scene ball = builder.finish();  // 5 120 facets: 20 480 elements at least, 2.8 GB
  core::LocalRun run(1, 1);
  RadiositySettings settings;
  const auto complaint = [&](const scene::Scene& scene) -> std::string {
    try {
      elements_of(scene, settings);
      return "";
    } catch (const core::InputError& error) {
      return error.what();
    }
  };
  settings.max_memory = 1e9;
  EXPECT_NE(complaint(ball).find("no --element-size fits"), std::string::npos) << complaint(ball);
  EXPECT_NE(complaint(ball).find("--max-memory 4GB"), std::string::npos) << complaint(ball);
  settings.max_memory = 4e9;
  EXPECT_EQ(complaint(ball), "");

  settings.max_memory = 1e8;
  settings.element_size = .01;
  const std::string of_cube = complaint(cube(.5));
  settings.element_size = std::stod(of_cube.substr(of_cube.find("--element-size ") + 15));
  EXPECT_LT(settings.element_size, .1);
  EXPECT_EQ(complaint(cube(.5)), "") << of_cube;
}

// By default about 2 500 elements; a mesh with a large face beside many small ones has the large face resolved.
TEST(Radiosity, has_elements_by_default_that_resolve_the_scene) {
  RadiositySettings settings;
  EXPECT_NEAR(static_cast<double>(elements_of(cube(.5), settings).size()), 2500, 500);
  scene::SceneBuilder builder({"y"});
  const auto grey = builder.add_material(test::diffuse(.5));
  builder.add_facets("ball", interflect::test::icosphere(3, .05, false), grey);  // 1 280 facets on 0.03 m²
  builder.add_polygon("floor", test::parallelogram({-2, -2, -1}, {4, 0, 0}, {0, 4, 0}), grey);
  const scene::Scene scene = builder.finish();
  std::size_t of_floor = 0;
  const mesh::ElementMesh mesh = elements_of(scene, settings);
  for (const auto& patch : mesh.patches()) of_floor += patch.surface.value == 1;
  EXPECT_GT(of_floor, 400u);
}

// 12 bytes a pair and three quarters of one; both views of a pair, 24 bytes, for methods that go by rows; counts, 4,
// for lines; at most N / drop_below kept pairs.
TEST(Radiosity, is_forecast_with_what_its_method_needs_on_the_way) {
  const auto scene = cube(.5);
  core::LocalRun run(1, 1);
  RadiositySettings settings;
  settings.element_size = .1;
  const double pairs = 0.5 * 600 * 600;
  const auto beside_elements = [&](const std::string& method) {
    settings.form_factors = method;
    return forecast(scene, settings, run.get()).bytes - 4000 * 600;
  };
  EXPECT_DOUBLE_EQ(beside_elements("gauss-lambert"), 12.75 * pairs);
  EXPECT_DOUBLE_EQ(beside_elements("hemicube"), 36 * pairs);
  settings.samples = 1000;
  EXPECT_DOUBLE_EQ(beside_elements("global-lines"), 16 * pairs);
  settings.drop_below = 0.05;
  EXPECT_NEAR(beside_elements("gauss-lambert"), (16 + 20 * 180000.0 / 16 / 12000) * 12000, 1);
  settings.drop_below = 0;
  settings.max_memory = 5e6;
  settings.form_factors = "gauss-lambert";
  EXPECT_NO_THROW(forecast(scene, settings, run.get()));
  settings.form_factors = "hemicube";
  EXPECT_THROW(forecast(scene, settings, run.get()), core::InputError);
  EXPECT_THROW(solve_radiosity(scene, settings, run.get()), core::InputError)
      << "before the work, not when memory is gone";
}

TEST(Radiosity, is_forecast_within_its_element_count) {
  const auto scene = cube(.5);
  core::LocalRun run(1, 1);
  RadiositySettings settings;
  settings.element_size = .1;
  const Forecast f = forecast(scene, settings, run.get());
  EXPECT_NEAR(f.elements, 600, 1);
  EXPECT_GT(f.seconds, 0);
  EXPECT_GT(f.bytes, 4.0 * 600 * 600);
}

}  // namespace
}  // namespace interflect::fem
