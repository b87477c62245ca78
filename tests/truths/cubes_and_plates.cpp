#include "tests/support/shapes.h"
#include "tests/support/temporary_folder.h"
#include "tests/truths/both_methods.h"
#include "tests/truths/scene_text.h"

// Solutions of the radiosity equation that other programs found: docs/truths.md 2.1, 2.4, 2.6, 2.11.
namespace interflect::test {
namespace {

/// Two unit squares at distance 1; the lower emits 1.
scene::Scene squares(const Placement& placement = {}) {
  SceneText text({".5,.5", ".3,.7"}, placement);
  text.material("lower", {0.5, 0.3}, {1, 1});
  text.material("upper", {0.5, 0.7}, {0, 0});
  text.polygon("lower", "lower", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  text.polygon("upper", "upper", {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}});
  return text.read();
}
const double lower_means[] = {1.010218055060, 1.008568960685}, upper_means[] = {0.100947189239, 0.141092268875};
std::vector<Truth> truths_of_squares() {
  return {{"lower", {(lower_means[0] - 1) / 0.5, (lower_means[1] - 1) / 0.3}},
          {"upper", {upper_means[0] / 0.5, upper_means[1] / 0.7}}};
}

// docs/truths.md 2.4.
TEST(ParallelSquares, have_their_known_means_by_both_methods_and_both_ray_casters) {
  for (const char* intersector : {"embree", "brute"})
    expect_both_true(squares(), truths_of_squares(),
                     {.element_size = 0.125, .samples = 400'000, .intersector = intersector});
  for (const Placement& placement :
       {Placement{.scale = 1e-6}, Placement{.scale = 1e6}, Placement{.shift = {1e9, 1e9, -1e9}}})
    expect_both_true(squares(placement), truths_of_squares(),
                     {.element_size = 0.125 * placement.scale, .samples = 100'000, .mc_error = 0.04});
}

// The error of means over whole plates falls as h².
TEST(ParallelSquares, are_approached_with_order_two) {
  const scene::Scene scene = squares();
  const auto errors = [&](double h) {
    const Solved solved(scene, {.element_size = h, .tolerance = 1e-7});
    std::vector<double> found;
    for (const Truth& truth : truths_of_squares()) {
      const auto mean = means(scene, {truth}, [&](auto asked) { return solved.answer(scene, asked); });
      for (int c = 0; c < 2; ++c) found.push_back(mean[0].value[c] - truth.irradiance[static_cast<std::size_t>(c)]);
    }
    return found;
  };
  const auto coarse = errors(1.0 / 4), fine = errors(1.0 / 8);
  for (std::size_t k = 0; k < coarse.size(); ++k) EXPECT_NEAR(std::log2(std::abs(coarse[k] / fine[k])), 2, 0.1) << k;
}

// docs/truths.md 2.6: the limit of fine meshes.  Uniform meshes come to it with order 1.5 to 2; the bounds are the
// solution's own.
TEST(Cube, with_a_glowing_floor_has_its_known_means_by_both_methods_and_both_ray_casters) {
  SceneText text({".5", ".8"});
  text.material("floor", {0.5, 0.8}, {1, 1});
  text.material("grey", {0.5, 0.8}, {0, 0});
  text.polygon("floor", "floor", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  text.polygon("ceiling", "grey", {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}});
  text.polygon("wall", "grey", {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}});
  text.polygon("wall", "grey", {{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}});
  text.polygon("wall", "grey", {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}});
  text.polygon("wall", "grey", {{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}});
  const double digits = 2e-6 / 0.8;  // what is known of the limit
  const std::vector<Truth> truths{{"floor", {(1.1043615 - 1) / 0.5, (1.587505 - 1) / 0.8}, digits},
                                  {"ceiling", {0.1712161 / 0.5, 0.660979 / 0.8}, digits},
                                  {"wall", {0.1811056 / 0.5, 0.687879 / 0.8}, digits}};
  const scene::Scene scene = text.read();
  for (const char* intersector : {"embree", "brute"})
    expect_both_true(scene, truths,
                     {.element_size = 0.125, .samples = 400'000, .mc_error = 0.01, .intersector = intersector});
}

// docs/truths.md 2.11, V6 and V7: without reflections H_2 = F_21 E_1, and what a thin square in between takes away is
// known.
TEST(Occluder, takes_the_part_that_it_hides) {
  const double open = 0.199824895698, quarter = 0.149868671774, centred = 0.099506294599;
  for (const auto& [low, side, truth] : {std::tuple{0.0, 0.0, open}, {0.0, 0.5, quarter}, {0.25, 0.5, centred}}) {
    SceneText text({"y"});
    text.material("lamp", {0}, {1});
    text.material("black", {0}, {0});
    text.polygon("lower", "lamp", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    text.polygon("upper", "black", {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}});
    const double high = low + side;
    if (side > 0)
      text.polygon("between", "black", {{low, low, 0.5}, {high, low, 0.5}, {high, high, 0.5}, {low, high, 0.5}});
    expect_both_true(text.read(), {{"upper", {truth}}}, {.element_size = 0.125, .samples = 400'000, .mc_error = 0.01});
  }
}

/// An icosphere that emits 1 + cos(theta), facet by facet, and reflects half: each facet a surface.
struct EmittingSphere {
  explicit EmittingSphere(int level) {
    SceneText text({"y"});
    for (const auto& corners : icosphere(level, 1, true)) {
      const std::string name = core::format("facet %zu", cosine.size());
      cosine.push_back(((corners[0] + corners[1] + corners[2]) / 3).normalized().z());
      text.material(name, {0.5}, {1 + cosine.back()});
      text.polygon(name, name, corners);
    }
    scene = text.read();
  }
  /// sum A B cos(theta) over 4 pi / 3, from the irradiance of each facet.
  double moment(std::span<const Estimate> irradiance) const {
    double sum = 0;
    for (std::size_t i = 0; i < cosine.size(); ++i)
      sum += scene.facets[i].area * (1 + cosine[i] + 0.5 * irradiance[i].value[0]) * cosine[i];
    return sum / (4 * pi / 3);
  }
  std::vector<measure::Measurement> facets() const {
    std::vector<measure::Measurement> asked;
    for (const scene::SurfaceId id : scene.surface_ids())
      asked.emplace_back(measure::PatchIrradiance{measure::patches_of(scene, id, scene::Side::front)[0]});
    return asked;
  }
  scene::Scene scene;
  std::vector<double> cosine;  ///< of each facet's direction from +z
};

// docs/truths.md 2.1: inside a sphere the irradiance is <E> / (1 - rho) everywhere, 2 for E = 1 + cos(theta) and rho =
// 1/2, so that the moment sum A B cos(theta) is 4 pi / 3.  Flat facets come to it with order 2; the irradiance of a
// single one, whose normal does not go through its centroid, with order 1 (0.018 at level 1, 0.0091 at level 2).
TEST(Sphere, of_any_emission_has_a_uniform_irradiance_with_order_two) {
  std::vector<double> error;
  for (const int level : {1, 2}) {
    const EmittingSphere sphere(level);
    const auto asked = sphere.facets();
    const Solved solved(sphere.scene, {.element_size = 4.0, .tolerance = 1e-4});  // a facet's four quarters
    const std::vector<Estimate> fem = solved.answer(sphere.scene, asked);
    for (const Estimate& H : fem) EXPECT_NEAR(H.value[0], 2, 0.02 / level);
    error.push_back(std::abs(sphere.moment(fem) - 1));

    core::LocalRun run;
    const auto mc = montecarlo::PathTracer({.samples = 16'384}).answer(sphere.scene, asked, run.get());
    double variance = 0;  // of the moment
    for (std::size_t i = 0; i < mc.size(); ++i)
      variance += std::pow(sphere.scene.facets[i].area * 0.5 * mc[i].standard_error[0] * sphere.cosine[i], 2);
    const double noise = std::sqrt(variance) / (4 * pi / 3);
    EXPECT_LT(noise, 1.2e-3);
    EXPECT_NEAR(sphere.moment(mc), sphere.moment(fem), 3.5 * noise + 2e-4);  // alpha 5e-4 each; four constants a facet
  }
  EXPECT_LT(error[1], 0.03);
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.25);
}

// The shipped scene: a furnace in one channel, a cube in flight in the other.
TEST(ConcentricCubes, hide_what_they_hide) {
  const scene::Scene scene = scene::read_scene(shipped_scene("concentric_cubes"));
  for (const char* intersector : {"embree", "brute"})
    expect_both_true(scene, {{"room", {1, 1.0 / 9}}, {"cube", {1, 0}}},
                     {.element_size = 0.5, .tolerance = 1e-4, .samples = 200'000, .intersector = intersector});
}

}  // namespace
}  // namespace interflect::test
