#include <array>

#include "core/moments.h"
#include "core/student_t.h"
#include "montecarlo/integrators.h"
#include "montecarlo/render.h"
#include "tests/montecarlo/rooms.h"

// That nothing is sampled by the numbers of something else: what all is the same on average differs as its errors say.
namespace interflect::montecarlo {
namespace {

using test::Question;

constexpr int spreads = 4;  ///< that this file looks at, under one alpha

/// Bounds of chi-squared of n - 1 degrees of freedom, over these.
struct Spread {
  core::ScalarMoments values, squared_errors;

  void add(double value, double standard_error) {
    values.add(value);
    squared_errors.add(standard_error * standard_error);
  }
  void expect_as_stated(const std::string& of) const {
    const double a = 2 / (9. * static_cast<double>(values.count() - 1)), z = test::critical_z(test::alpha, spreads);
    const double part = values.variance() / squared_errors.mean();  // Wilson and Hilferty's cube
    EXPECT_GT(part, std::pow(1 - a - z * std::sqrt(a), 3)) << of;
    EXPECT_LT(part, std::pow(1 - a + z * std::sqrt(a), 3)) << of;
  }
};

TEST(Numbers, differ_from_measurement_to_measurement) {
  const scene::Scene scene = test::facing_squares();
  const auto patches = measure::patches_of(scene, test::surface_named(scene, "lower"), scene::Side::front);
  const std::vector<measure::Measurement> asked(64, measure::PatchIrradiance{patches[0]});
  core::LocalRun run;
  Spread spread;
  for (const Estimate& found : PathTracer({.samples = 1024}).answer(scene, asked, run.get()))
    spread.add(found.value[0], found.standard_error[0]);
  spread.expect_as_stated("a patch");
}

// A floor's pixels, below half a sky, are rho / pi times pi / 2 times its radiance: 1/2 each.
TEST(Numbers, differ_from_pixel_to_pixel) {
  const scene::Scene scene = test::floor_below_a_sky();
  for (const char* integrator : {"path", "bidirectional", "distributed"}) {
    RenderSettings settings;
    settings.integrator = integrator;
    settings.samples = 256;
    settings.paths = measure::PathClasses::of("FDE");
    core::LocalRun run;
    const Rendering found = render(scene, {0}, settings, run.get(), *raycast::make_ray_caster("embree", scene));
    Spread spread;
    for (int row = 0; row < 16; ++row)
      for (int column = 0; column < 16; ++column)
        spread.add(found.radiance.at(column, row, 0), found.standard_error.at(column, row, 0));
    spread.expect_as_stated(integrator);
    EXPECT_NEAR(spread.values.mean(), .5, test::critical_z(test::alpha, 3) * spread.values.standard_error())
        << integrator;
  }
}

/// Lambert's formula for a floor point and a lamp that stands on the floor: x = .35, |y| <= .3, z <= .3, faces -x.
double irradiance_before_lamp(double x, double y) {
  const std::array<Vec3, 4> r{Vec3(.35 - x, -.3 - y, 0), Vec3(.35 - x, -.3 - y, .3), Vec3(.35 - x, .3 - y, .3),
                              Vec3(.35 - x, .3 - y, 0)};
  double sum = 0;
  for (std::size_t k = 0; k < r.size(); ++k) {
    const Vec3 across = r[k].cross(r[(k + 1) % r.size()]);
    sum += std::atan2(across.norm(), r[k].dot(r[(k + 1) % r.size()])) * across.z() / across.norm();
  }
  return std::abs(sum) / (2 * pi);
}

/// Means by midpoints, to 2e-7: over a disk about the origin, and over a square, which has the lamp's back in it.
double mean_over_disk(double radius) {
  constexpr int n = 200;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double r = radius * std::sqrt((i + .5) / n), turn = 2 * pi * (j + .5) / n;
      sum += irradiance_before_lamp(r * std::cos(turn), r * std::sin(turn));
    }
  return sum / (n * n);
}
double mean_over_square(double half) {
  constexpr int n = 400;
  const double width = half + .35;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      sum += irradiance_before_lamp(width * (i + .5) / n - half, half * (2 * (j + .5) / n - 1));
  return sum / (n * n) * width / (2 * half);
}

// A floor beside a lamp, seen from above as one wide pixel, and out of focus by way of a wide lens, whichever way up:
// where a path begins says nothing of where it goes on to.
TEST(Numbers, differ_from_the_film_and_the_lens_to_the_first_vertex) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  scene::SceneBuilder builder({"grey"});
  builder.add_polygon("floor", test::parallelogram(-4 * x - 4 * y, 8 * x, 8 * y),
                      builder.add_material(test::diffuse("f", .6, 0)));
  builder.add_polygon("lamp", test::parallelogram(Vec3(.35, -.3, 0), .3 * z, .6 * y),
                      builder.add_material(test::diffuse("l", 0, 1)));
  const double half = 2 * std::tan(pi / 6), lens = .3;  // what is seen at 2 of 60 degrees; at twice the lens's focus
  std::vector<Question> questions;
  for (const Vec3& up : {x, y, Vec3(-x), Vec3(-y)})
    for (const bool wide : {true, false}) {
      const auto projection = wide ? scene::Projection(scene::Pinhole{60}) : scene::ThinLens{.1, lens, 1};
      const auto number = static_cast<std::uint32_t>(questions.size());
      builder.scene().cameras.push_back({"c" + std::to_string(number), 2 * z, Vec3::Zero(), up, projection, 1, 1});
      questions.push_back({measure::PixelRadiance{{number}, 0, 0},
                           test::grey(.6 * inv_pi * (wide ? mean_over_square(half) : mean_over_disk(lens))),
                           wide ? "film" : "lens", 1e-7});
    }
  const scene::Scene scene = builder.finish();
  for (const char* integrator : {"path", "bidirectional", "distributed"}) {
    SCOPED_TRACE(integrator);
    IntegratorSettings settings;
    settings.samples = 100'000;
    settings.paths = measure::PathClasses::of("ADE");
    test::expect_agreement(*make_integrator(integrator, settings), scene, questions, .02);
  }
  // Pictures, which have numbers of their own.
  const auto rays = raycast::make_ray_caster("embree", scene);
  const auto pictures = 4 * questions.size();
  const double normal = test::critical_z(test::alpha, pictures);
  const double of_copies =
      core::student_t(std::pow(1 - test::alpha, 1 / static_cast<double>(pictures)), sequence_batches - 1);
  for (const std::string integrator : {"path", "bidirectional", "distributed", "whitted"})
    for (std::uint32_t camera = 0; camera < questions.size(); ++camera) {
      RenderSettings settings;
      settings.integrator = integrator;
      settings.samples = 1 << 14;
      settings.paths = measure::PathClasses::of("ADE");
      core::LocalRun run;
      const Rendering found = render(scene, {camera}, settings, run, *rays);
      const double truth = questions[camera].truth[0], error = found.standard_error.at(0, 0, 0);
      const double limit = integrator == "whitted" ? of_copies : normal;
      EXPECT_NEAR(found.radiance.at(0, 0, 0), truth, limit * error + 1e-6 * truth) << integrator << ' ' << camera;
      EXPECT_LT(error, .05 * truth) << integrator << ' ' << camera;
    }
}

}  // namespace
}  // namespace interflect::montecarlo
