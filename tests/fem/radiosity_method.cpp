#include "fem/radiosity_method.h"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/surface_measurements.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

using test::Room;
using test::solve;

std::vector<Estimate> answers(const scene::Scene& scene, const RadiositySolution& solution,
                              const std::vector<measure::Measurement>& asked, unsigned threads = 2,
                              PixelRays pixel = {}) {
  const auto rays = raycast::make_ray_caster("brute", scene);
  core::LocalRun run(1, threads);
  return RadiosityMethod(solution, *rays, pixel).answer(scene, asked, run.get());
}

/// docs/truths.md 2.4: unit squares one metre apart, reflectances .3 and .7, the lower one emits 1.
scene::Scene plates() {
  Room room;
  room.wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, .3, 1);
  room.wall({0, 0, 1}, {0, 1, 0}, {1, 0, 0}, 1, .7);
  return room.finish();
}
struct Exact {
  double x, y, B1, B2;
};
const std::vector<Exact> at_points = {{0, 0, 1.010337339662, .169085413687},
                                      {.25, .25, 1.008919660688, .146754402664},
                                      {.5, 0, 1.007707844849, .127350747221},
                                      {.5, .5, 1.005875595836, .097804812116}};

// Corners too: the iterated value has order two everywhere, where the element's own has one.
TEST(RadiosityMethod, gives_the_irradiance_at_points_within_its_bound) {
  const auto scene = plates();
  double worst[2] = {};
  for (int k = 0; k < 2; ++k) {
    const auto s = solve(scene, {.element_size = k == 0 ? .25 : .125, .tolerance = 1e-5});
    std::vector<measure::Measurement> asked;
    for (const Exact& e : at_points) {
      asked.push_back(measure::PointIrradiance{{.5 + e.x, .5 + e.y, 0}, Vec3::UnitZ(), scene::SurfaceId{0}});
      asked.push_back(measure::PointIrradiance{{.5 + e.x, .5 + e.y, 1}, -Vec3::UnitZ(), scene::SurfaceId{1}});
    }
    const auto found = answers(scene, s, asked);
    for (std::size_t p = 0; p < at_points.size(); ++p) {
      const double exact[2] = {(at_points[p].B1 - 1) / .3, at_points[p].B2 / .7};
      for (std::size_t side = 0; side < 2; ++side) {
        const Estimate& e = found[2 * p + side];
        const double error = std::abs(e.value[0] - exact[side]);
        EXPECT_LE(error, e.error_bound[0]) << p << " " << side;
        EXPECT_EQ(e.standard_error[0], 0) << "nothing is sampled";
        EXPECT_LT(e.error_bound[0], 0.1 * exact[side]);
        worst[k] = std::max(worst[k], error);
      }
    }
  }
  EXPECT_GT(std::log2(worst[0] / worst[1]), 1.6);
}

TEST(RadiosityMethod, of_an_element_is_its_galerkin_value_and_of_a_surface_their_mean) {
  const auto scene = plates();
  const auto s = solve(scene, {.element_size = .25});
  std::vector<measure::Measurement> asked;
  for (const auto& patch : s.mesh.patches()) asked.push_back(measure::PatchIrradiance{patch});
  asked.push_back(measure::Flux{measure::patches_of(scene, scene::SurfaceId{1}, scene::Side::front)});
  asked.push_back(measure::Flux{{measure::patches_of(scene, scene::SurfaceId{1}, scene::Side::front)[0]}});
  const auto found = answers(scene, s, asked);
  for (std::size_t i = 0; i < s.irradiance.size(); ++i) {
    EXPECT_EQ(found[i].value, s.irradiance[i]);
    EXPECT_EQ(found[i].error_bound, s.irradiance_error[i]);
    EXPECT_EQ(found[i].claim, Claim::estimated);
  }
  const double mean = test::mean_over(s, s.irradiance, {1});
  const Estimate &whole = found[s.irradiance.size()], &half = found.back();
  EXPECT_NEAR(whole.value[0], mean, 1e-12);
  EXPECT_NEAR(half.value[0], mean / 2, 1e-12) << "half of the square by its diagonal: symmetric";
  EXPECT_GT(half.error_bound[0], whole.error_bound[0] / 2) << "cut elements are known less well";
}

/// Area of the part of an axis-parallel element that lies in [x0, x1] x [y0, y1].
double overlap(const scene::SurfacePatch& element, double x0, double x1, double y0, double y1) {
  Vec3 low = element.corner[0], high = low;
  for (const Vec3& corner : element.ring()) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
  return std::max(0.0, std::min(high.x(), x1) - std::max(low.x(), x0)) *
         std::max(0.0, std::min(high.y(), y1) - std::max(low.y(), y0));
}

// A patch across several elements, most of them cut; the same patch of a solution on elements of a quarter of the size
// tells what cutting costs.
TEST(RadiosityMethod, of_patches_that_are_no_elements_is_the_mean_of_what_tiles_them) {
  const auto scene = plates();
  const auto s = solve(scene, {.element_size = .25});
  const Vec3 ring[] = {{.1, .1, 1}, {.1, .7, 1}, {.6, .7, 1}, {.6, .1, 1}};
  const Vec3 off_the_surface[] = {{5, 5, 1}, {5, 6, 1}, {6, 6, 1}};
  const auto found = answers(scene, s,
                             {measure::PatchIrradiance{scene::make_patch({1}, scene::Side::front, ring)},
                              measure::PatchIrradiance{scene::make_patch({1}, scene::Side::front, off_the_surface)}});
  double mean = 0;
  for (std::size_t i = 0; i < s.irradiance.size(); ++i)
    if (s.mesh.patches()[i].surface.value == 1)
      mean += overlap(s.mesh.patches()[i], .1, .6, .1, .7) / (.5 * .6) * s.irradiance[i][0];
  EXPECT_NEAR(found[0].value[0], mean, 1e-12);
  const auto fine = answers(scene, solve(scene, {.element_size = 1.0 / 16}),
                            {measure::PatchIrradiance{scene::make_patch({1}, scene::Side::front, ring)}});
  EXPECT_LE(std::abs(found[0].value[0] - fine[0].value[0]), found[0].error_bound[0]);
  EXPECT_EQ(found[1].claim, Claim::none);
  EXPECT_TRUE(std::isinf(found[1].error_bound[0]));
}

// In a furnace every pixel sees 1/pi; past the edge of the plates, nothing.
TEST(RadiosityMethod, of_pixels_is_radiosity_over_pi) {
  Room room;
  room.box({0, 0, 0}, {1, 1, 1}, 1, true, .5, .5);
  room.patches.clear();
  scene::Scene furnace = room.finish();
  furnace.cameras.push_back({"inside", {.5, .5, .5}, {1, .6, .4}, Vec3::UnitZ(), 60, 8, 8});
  const auto s = solve(furnace, {.element_size = .5, .tolerance = 1e-5});
  std::vector<measure::Measurement> asked;
  for (int k = 0; k < 8; ++k) asked.push_back(measure::PixelRadiance{{0}, k, 7 - k});
  for (const Estimate& e : answers(furnace, s, asked)) EXPECT_NEAR(e.value[0], inv_pi, 1e-5);

  scene::Scene open = plates();
  open.cameras.push_back({"away", {.5, .5, 3}, {.5, .5, 9}, Vec3::UnitX(), 60, 8, 8});
  const auto nothing = answers(open, solve(open, {.element_size = .5}), {measure::PixelRadiance{{0}, 3, 3}});
  EXPECT_EQ(nothing[0].value, Spectrum::zero());
}

/// A lit room with a body that hides some of every wall, and a camera whose single pixel sees a spot on the floor.
scene::Scene room_with_a_body() {
  Room room;
  room.box({0, 0, 0}, {1, 1, 1}, 1, true, .5, .5);
  room.box({.25, .25, .25}, {.25, .25, .25}, 1, false, .5);
  scene::Scene scene = room.finish();
  scene.cameras.push_back({"spot", {.3, .7, .9}, {.3, .7, 0}, Vec3::UnitX(), .1, 1, 1});
  return scene;
}

// With B = E + rho H all of a pixel is that of H at the point seen, times rho / pi: noise remains noise, and a bound a
// bound.  A single ray has no spread that would tell of the noise of its gather.
TEST(RadiosityMethod, of_a_pixel_of_one_ray_has_the_noise_and_the_bound_of_the_point_seen) {
  const scene::Scene scene = room_with_a_body();
  const auto s = solve(scene, {.element_size = .5});
  const auto hit = raycast::make_ray_caster("brute", scene)->closest({{.3, .7, .9}, -Vec3::UnitZ()});
  ASSERT_TRUE(hit);
  const auto found = answers(
      scene, s, {measure::PointIrradiance{hit->position, hit->normal, hit->surface}, measure::PixelRadiance{{0}, 0, 0}},
      1, {.side = 1, .gather = true});
  EXPECT_GT(found[0].standard_error[0], 0);
  EXPECT_NEAR(found[1].value[0], inv_pi * (.5 + .5 * found[0].value[0]), 1e-3 * found[1].value[0]);
  EXPECT_NEAR(found[1].standard_error[0], inv_pi * .5 * found[0].standard_error[0], .3 * found[1].standard_error[0]);
  EXPECT_NEAR(found[1].error_bound[0], inv_pi * .5 * found[0].error_bound[0], .02 * found[1].error_bound[0]);
}

// Sixteen rays to one element find the same B there, and so no spread: they all have its noise, which does not average
// out.
TEST(RadiosityMethod, of_a_pixel_has_the_noise_of_the_element_seen) {
  const scene::Scene scene = room_with_a_body();
  const auto s = solve(scene, {.element_size = .5});
  const auto seen = s.mesh.locate(*raycast::make_ray_caster("brute", scene)->closest({{.3, .7, .9}, -Vec3::UnitZ()}));
  ASSERT_TRUE(seen);
  const std::size_t i = seen->element.value;
  const Estimate pixel = answers(scene, s, {measure::PixelRadiance{{0}, 0, 0}})[0];
  EXPECT_EQ(pixel.samples, 16u);
  EXPECT_GT(s.irradiance_noise[i][0], 0);
  EXPECT_NEAR(pixel.standard_error[0], inv_pi * .5 * s.irradiance_noise[i][0], 1e-12);
  EXPECT_NEAR(pixel.error_bound[0], inv_pi * (.5 * s.irradiance_error[i] + s.field_error[i])[0], 1e-12);
}

// Sampled visibilities are keyed by the question: its place in the list does not matter.
TEST(RadiosityMethod, answers_a_question_the_same_wherever_it_stands_in_the_list) {
  Room room;
  room.box({0, 0, 0}, {1, 1, 1}, 1, true, .5, .5);
  room.box({.25, .25, .25}, {.25, .25, .25}, 1, false, .5);
  scene::Scene scene = room.finish();
  scene.cameras.push_back({"inside", {.9, .9, .9}, {0, 0, .4}, Vec3::UnitZ(), 60, 8, 8});
  const auto s = solve(scene, {.element_size = .5});
  const measure::PointIrradiance point{{.3, .6, 0}, Vec3::UnitZ(), scene::SurfaceId{4}};
  const measure::PixelRadiance pixel{{0}, 2, 5};
  const auto first = answers(scene, s, {point, pixel}), last = answers(scene, s, {pixel, pixel, point});
  EXPECT_GT(first[0].samples, 0u);
  EXPECT_EQ(first[0].value, last[2].value);
  EXPECT_EQ(first[1].value, last[0].value);
  EXPECT_EQ(last[0].value, last[1].value);
}

TEST(RadiosityMethod, answers_the_same_bits_for_any_number_of_threads) {
  Room room;
  room.box({0, 0, 0}, {1, 1, 1}, 1, true, .5, .5);
  room.box({.25, .25, .25}, {.25, .25, .25}, 1, false, .5);
  const auto scene = room.finish();
  const auto s = solve(scene, {.element_size = .25});
  std::vector<measure::Measurement> asked;
  for (int k = 0; k < 40; ++k)
    asked.push_back(measure::PointIrradiance{{.02 * k + .1, .5, 0}, Vec3::UnitZ(), scene::SurfaceId{4}});
  const auto one = answers(scene, s, asked, 1);
  for (unsigned threads : {2u, 3u, 8u}) {
    const auto many = answers(scene, s, asked, threads);
    for (std::size_t k = 0; k < one.size(); ++k) {
      EXPECT_EQ(many[k].value, one[k].value);
      EXPECT_EQ(many[k].standard_error, one[k].standard_error);
    }
  }
}

// Lights that are no surfaces are refused by name, before any work.
TEST(RadiosityMethod, refuses_lights_that_are_no_surfaces) {
  scene::Scene scene = plates();
  scene.lights.suns.push_back({"sun", -Vec3::UnitZ(), Spectrum(1)});
  try {
    solve(scene, {});
    ADD_FAILURE();
  } catch (const core::InputError& error) {
    EXPECT_STREQ(error.what(), "'sun': radiosity knows lights that are surfaces; interflect trace does this");
  }
}

}  // namespace
}  // namespace interflect::fem
