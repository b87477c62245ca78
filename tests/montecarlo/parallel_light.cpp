#include <array>

#include "core/error.h"
#include "montecarlo/integrators.h"
#include "tests/montecarlo/statistics.h"
#include "tests/montecarlo/sun_and_mirror.h"

// What a sun without an angle sends by way of a mirror is found or refused, and never left out.
namespace interflect::montecarlo {
namespace {

Estimate answer(const std::string& name, const scene::Scene& scene, const measure::Measurement& asked,
                const std::string& paths = "L.*E") {
  core::LocalRun run(5, 2);
  IntegratorSettings settings;
  settings.samples = name == "light" ? 400'000 : 50'000;
  settings.paths = measure::PathClasses::of(paths);
  return make_integrator(name, settings)->answer(scene, {&asked, 1}, run.get())[0];
}

/// With which path.
std::string refusal(const std::string& name, const scene::Scene& scene, const measure::Measurement& asked) {
  try {
    answer(name, scene, asked);
  } catch (const core::InputError& error) {
    const std::string text = error.what();
    const std::size_t begin = text.find("paths ") + 6;
    return text.substr(begin, text.find(' ', begin) - begin);
  }
  return "found";
}

constexpr int comparisons = 3 * 4;

void expect_truth(const Estimate& found, double truth, const char* what) {
  const double noise = found.standard_error[0];
  EXPECT_LE(noise, .03 * truth) << what;
  EXPECT_LE(std::abs(found.value[0] - truth), test::critical_z(1e-3, comparisons) * noise + 1e-9 * truth) << what;
}

TEST(ParallelLight, is_found_by_way_of_a_mirror_or_refused) {
  for (const double scale : {1e-6, 1., 1e6}) {
    const scene::Scene scene = test::sun_and_mirror(scale, 0);
    const auto asked = test::asked_of_sun_and_mirror(scene, scale);
    const double flux = test::under_sun_and_mirror * scale * scale, pixel = .5 * test::under_sun_and_mirror * inv_pi;
    expect_truth(answer("bidirectional", scene, asked.flux), flux, "bidirectional, flux");
    expect_truth(answer("light", scene, asked.flux), flux, "light, flux");
    expect_truth(answer("bidirectional", scene, asked.pixel, "B.?DE"), pixel, "bidirectional, pixel");
    expect_truth(answer("light", scene, asked.pixel, "B.?DE"), pixel, "light, pixel");
    for (const char* name : {"path", "controlled", "distributed", "whitted"})
      for (const measure::Measurement& each : {asked.flux, asked.point, asked.pixel})
        EXPECT_NE(refusal(name, scene, each), "found") << name;
    EXPECT_EQ(refusal("path", scene, asked.flux), "BSE");
    EXPECT_EQ(refusal("path", scene, asked.point), "BSE");
    EXPECT_EQ(refusal("path", scene, asked.pixel), "BSDE");
    EXPECT_EQ(refusal("bidirectional", scene, asked.point), "BSE");
    EXPECT_EQ(refusal("bidirectional", scene, asked.pixel), "BSDSE");
    EXPECT_EQ(refusal("light", scene, asked.point), "BSE");
    EXPECT_EQ(refusal("light", scene, asked.pixel), "BDSE");
  }
}

// What comes straight, or from a diffuse surface, is found by all that find the like of a point.
TEST(ParallelLight, that_comes_straight_is_found_by_all) {
  const scene::Scene scene = test::sun_and_mirror(1, 0);
  const auto asked = test::asked_of_sun_and_mirror(scene, 1);
  const std::array<const char*, 5> names{"path", "bidirectional", "light", "distributed", "whitted"};
  test::Family family(names.size() * 2 * 2);
  for (const char* name : names) {
    const Estimate flux = answer(name, scene, asked.flux, "LE"), point = answer(name, scene, asked.point, "LE"),
                   pixel = answer(name, scene, asked.pixel, "LDE");
    EXPECT_NEAR(flux.value[0], .8, family.z() * flux.standard_error[0] + 1e-9) << name;
    EXPECT_NEAR(point.value[0], .8, 1e-9) << name;
    EXPECT_NEAR(pixel.value[0], .5 * .8 * inv_pi, family.z() * pixel.standard_error[0] + 1e-9) << name;
  }
}

}  // namespace
}  // namespace interflect::montecarlo
