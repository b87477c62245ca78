#include "montecarlo/sample_report.h"

#include <algorithm>
#include <limits>

#include "montecarlo/integrators.h"
#include "montecarlo/render.h"
#include "tests/montecarlo/rooms.h"
#include "tests/montecarlo/solution_rooms.h"
#include "tests/montecarlo/statistics.h"
#include "tests/montecarlo/sun_and_mirror.h"

// What integrators tell of samples that are no numbers, or of which one is much.
namespace interflect::montecarlo {
namespace {

using scene::SceneBuilder;

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

/// So many samples of 1, and one of `largest`.
Tally with_one_of(double largest, int ones) {
  Tally tally;
  for (int k = 0; k < ones; ++k) tally.add(test::grey(1), 1, static_cast<std::uint64_t>(k));
  Tally other;
  other.add(test::grey(largest), largest, 1000);
  tally.merge(other);
  return tally;
}

// More than 5 %, of no fewer than 400.
TEST(SampleReport, tells_where_one_sample_is_much) {
  SampleReport report;
  report.add(0, with_one_of(1, 999));
  report.add(1, with_one_of(50, 999));   // 4.8 %
  report.add(2, with_one_of(100, 900));  // 10 %
  report.add(3, with_one_of(60, 940));   // 6 %
  report.add(4, with_one_of(1, 3));      // a quarter, as each is
  report.add(5, with_one_of(42, 63));    // 40 % of 64
  report.add(6, with_one_of(398, 398));  // half of 399
  report.add(7, with_one_of(399, 399));  // half of 400
  ASSERT_EQ(report.heavy.size(), 3u);
  EXPECT_EQ(report.heavy[0].measurement, 2u);
  EXPECT_EQ(report.heavy[1].measurement, 3u);
  EXPECT_EQ(report.heavy[2].measurement, 7u);
  EXPECT_DOUBLE_EQ(report.heavy[1].share, .06);
  EXPECT_EQ(report.heavy_text({"a", "b", "c", "d", "e", "f", "g", "desk"}),
            "one sample carries 50 % of desk: its error may be understated; so in 3 of 8");
  EXPECT_EQ(SampleReport().heavy_text({}), "");
}

// Of sizes: what samples with signs leave of each other is no measure of how much one of them is.
TEST(SampleReport, shares_are_of_all_sizes) {
  Tally tally;
  for (int k = 0; k < 500; ++k) tally.add(test::grey(k % 2 == 0 ? 1 : -1), k % 2 == 0 ? 1 : -1, 0);
  EXPECT_DOUBLE_EQ(tally.share_of_one(), .002);
  EXPECT_EQ(Tally().share_of_one(), 0);
}

// Two pixels of 201 are less than 1 %, two of 200 are not.
TEST(SampleReport, tells_of_a_picture_by_its_share_of_pixels) {
  SampleReport report;
  report.add(17, with_one_of(60, 940));  // 6 %
  EXPECT_EQ(report.heavy_text_of_picture(20, 10), "");
  report.add(43, with_one_of(100, 900));  // 10 %
  EXPECT_EQ(report.heavy_text_of_picture(201, 1), "");
  const std::string text = report.heavy_text_of_picture(20, 10);
  EXPECT_EQ(text.find("in 1 % of the pixels one sample carries much, most in (3, 2), 10 %"), 0u) << text;
}

class EveryReport : public testing::TestWithParam<std::string> {
 protected:
  /// Of the paths that it finds to all that is asked.
  IntegratorSettings settings(std::uint64_t samples, std::span<const measure::Measurement> asked,
                              SampleReport& report) const {
    IntegratorSettings settings;
    settings.samples = samples;
    settings.report = &report;
    settings.paths = test::paths_found(GetParam(), asked);
    settings.solution = says();
    return settings;
  }
  Rendering picture(const scene::Scene& scene, const measure::PathClasses& paths) const {
    RenderSettings settings;
    settings.integrator = GetParam(), settings.samples = 16, settings.paths = paths;
    settings.solution = says();
    core::LocalRun run(1, 2);
    return render(scene, {0}, settings, run, *raycast::make_ray_caster("embree", scene));
  }
  bool is_two_pass() const { return GetParam() == "two-pass"; }
  /// Of integrators that need a solution: what it says of all surfaces.
  measure::SurfaceSolution says() const { return test::says_everywhere(Spectrum(reflected_)); }

  double reflected_ = .5;
};

/// A point light of 1e305 W/sr 1 mm above a small floor: more than a double holds, wherever it is found.
scene::Scene beyond_numbers() {
  SceneBuilder builder({"grey"});
  builder.add_polygon("floor", test::parallelogram(Vec3(-.01, -.01, 0), .02 * x, .02 * y),
                      builder.add_material(test::diffuse("f", .5, 0)));
  builder.scene().lights.points.push_back({"p", .001 * z, test::grey(1e305)});
  builder.scene().cameras.push_back({"c", .02 * z, Vec3::Zero(), y, 20, 4, 3});
  return builder.finish();
}

/// The same floor in a room that glows.
scene::Scene seen_floor() {
  SceneBuilder builder({"grey"});
  builder.add_box("room", {Vec3(-1, -1, -1), Vec3(1, 1, 1)}, builder.add_material(test::diffuse("w", .5, 1)),
                  SceneBuilder::Facing::inward);
  builder.add_polygon("floor", test::parallelogram(Vec3(-.01, -.01, 0), .02 * x, .02 * y),
                      builder.add_material(test::diffuse("f", .5, 0)));
  builder.scene().cameras.push_back({"c", .02 * z, Vec3::Zero(), y, 20, 4, 3});
  return builder.finish();
}

/// Of two passes, which do not know such lights, the solution is no number.
TEST_P(EveryReport, counts_samples_that_are_no_numbers) {
  if (is_two_pass()) reflected_ = std::numeric_limits<double>::infinity();
  const scene::Scene scene = is_two_pass() ? seen_floor() : beyond_numbers();
  const std::vector<measure::Measurement> asked{
      measure::PatchIrradiance{measure::patches_of(scene, test::surface_named(scene, "floor"), scene::Side::front)[0]},
      measure::PointIrradiance{Vec3(0, 0, 1e-4), z, {}}};
  SampleReport report;
  core::LocalRun run(1, 2);
  const auto found = make_integrator(GetParam(), settings(64, asked, report))->answer(scene, asked, run.get());
  EXPECT_GE(report.not_finite, 64u);
  for (const Estimate& each : found) {
    EXPECT_EQ(each.claim, Claim::none);
    EXPECT_TRUE(std::isinf(each.error_bound[0]));
    EXPECT_TRUE(std::isfinite(each.value[0]));
  }
  const Rendering seen = picture(scene, is_two_pass() ? measure::PathClasses::all() : measure::PathClasses::of("PDE"));
  EXPECT_GE(seen.report.not_finite, 1u);
  int unknown = 0;
  for (std::size_t p = 0; p < seen.radiance.data.size(); ++p) {
    EXPECT_TRUE(std::isfinite(seen.radiance.data[p]));
    unknown += std::isinf(seen.standard_error.data[p]);
  }
  EXPECT_GE(unknown, 1);
}

/// In rooms of all lights and all materials, or those that it knows.
std::vector<scene::Scene> good_scenes(bool two_pass) {
  return two_pass ? std::vector{test::furnished(1), test::known_to_two_passes()}
                  : std::vector{test::lit_by_all(), test::shiny()};
}

// At patches, points and pixels.
TEST_P(EveryReport, has_no_such_samples_of_good_scenes) {
  for (scene::Scene scene : good_scenes(is_two_pass())) {
    if (scene.cameras.empty())
      scene.cameras.push_back(
          {"c", Vec3(.2, .9, .5), Vec3(2.2, 1, .35), z, scene::Projection(scene::Pinhole{80}), 3, 3});
    std::vector<measure::Measurement> asked{test::all_fronts(scene)};
    asked.emplace_back(measure::PointIrradiance{Vec3(.3, 1, .4), Vec3(.6, 0, .8), {}});
    for (int k = 0; k < 4; ++k) asked.emplace_back(measure::PixelRadiance{{0}, k % 2, k / 2});
    SampleReport report;
    const IntegratorSettings of = settings(GetParam() == "light" ? 100'000 : 10'000, asked, report);
    core::LocalRun run(1, 2);
    for (const Estimate& each : make_integrator(GetParam(), of)->answer(scene, asked, run.get()))
      EXPECT_NE(each.claim, Claim::none);
    EXPECT_EQ(report.not_finite, 0u);
    EXPECT_EQ(picture(scene, of.paths).report.not_finite, 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryReport,
                         testing::Values("path", "bidirectional", "light", "distributed", "whitted", "two-pass",
                                         "controlled"),
                         [](const auto& of) {
                           std::string name = of.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

// A small lamp in a mirror: paths from the floor meet it one time in 10 000 or so, and each find is much; paths from the
// lamp all do.
TEST(SampleReport, flags_what_is_found_by_rare_samples) {
  SceneBuilder builder({"grey"});
  scene::Material mirror;
  mirror.finish = scene::Mirror{test::grey(.8)};
  builder.add_polygon("floor", test::parallelogram(Vec3(-1, -1, 0), 2 * x, 2 * y),
                      builder.add_material(test::diffuse("f", 0, 0)));
  builder.add_polygon("mirror", test::parallelogram(Vec3(-1, -1, 2), 2 * y, 2 * x), builder.add_material(mirror));
  builder.add_polygon("lamp", test::parallelogram(Vec3(0, 0, .5), .06 * x, .06 * y),
                      builder.add_material(test::diffuse("l", 0, 1)));
  const scene::Scene scene = builder.finish();
  const measure::Measurement floor =
      measure::Flux{measure::patches_of(scene, test::surface_named(scene, "floor"), scene::Side::front)};
  const auto report_of = [&](const char* integrator) {
    SampleReport report;
    IntegratorSettings settings;
    settings.samples = 100'000, settings.paths = measure::PathClasses::of("ASE"), settings.report = &report;
    core::LocalRun run(1, 2);
    make_integrator(integrator, settings)->answer(scene, {&floor, 1}, run.get());
    return report;
  };
  const SampleReport rare = report_of("path"), common = report_of("light");
  ASSERT_EQ(rare.heavy.size(), 1u);
  EXPECT_GT(rare.heavy[0].share, .05);
  EXPECT_LE(rare.heavy[0].share, 1);
  EXPECT_TRUE(common.heavy.empty());
}

// Of many the one that has the fewest samples is named; parts of a list keep whose it is.
TEST(SampleReport, names_what_rare_light_may_be_missed_by) {
  const scene::Scene scene = test::sun_and_mirror(1, scene::Sun::seen_from_earth);
  const auto asked = test::asked_of_sun_and_mirror(scene, 1);
  SampleReport part;
  IntegratorSettings settings;
  settings.samples = 4096, settings.report = &part;
  core::LocalRun run(1, 2);
  make_integrator("path", settings)->answer(scene, {&asked.flux, 1}, run.get());
  ASSERT_FALSE(part.rare.empty());
  EXPECT_EQ(part.rare_text({"floor"}).find("floor: light of sun by way of mirrors"), 0u) << part.rare_text({"floor"});
  SampleReport whole;
  EXPECT_EQ(whole.rare_text({}), "");
  whole.add(part, std::vector<std::size_t>{2});
  SampleReport better = part;
  better.rare_samples *= 2;
  whole.add(better, std::vector<std::size_t>{1});
  EXPECT_EQ(whole.rare_text({"walls", "ceiling", "floor"}), part.rare_text({"floor"}));
}

}  // namespace
}  // namespace interflect::montecarlo
