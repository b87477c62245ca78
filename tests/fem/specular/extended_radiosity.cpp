#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "fem/radiosity_method.h"
#include "fem/specular/channel_by_channel.h"
#include "fem/specular/specular_chains.h"
#include "fem/surface_solution.h"
#include "measure/surface_measurements.h"
#include "tests/fem/specular/mirrored_rooms.h"

namespace interflect::fem {
namespace {

using test::both;
using test::of_finish;
using test::parallelogram;
using test::solved_by_rays;

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

double error_of(const RadiositySolution& s, std::size_t i, int channel) {
  return s.irradiance_error[i][channel] + 4 * s.irradiance_noise[i][channel];
}

// In a furnace every wall sends and receives 1, whatever perfect mirrors and clear glass stand in it.
TEST(ExtendedRadiosity, furnace) {
  scene::SceneBuilder builder = test::furnace();
  builder.add_polygon("mirror", parallelogram(Vec3(.5, .2, .2), 1.5 * y, .6 * z),
                      builder.add_material(of_finish(scene::Mirror{Spectrum(1)})));
  builder.add_box("glass", {Vec3(1, .5, .2), Vec3(1.6, 1.2, .8)},
                  builder.add_material(of_finish(scene::Glass{1.5, 0})));
  builder.add_polygon("pane", parallelogram(Vec3(2.2, .2, .1), 1.5 * y, .7 * z),
                      builder.add_material(of_finish(scene::Pane{Spectrum(scene::most_transmitted(1.5)), 1.5})));
  const scene::Scene scene = builder.finish();
  const RadiositySolution s = solved_by_rays(scene, .5, 4096);
  Spectrum mean;
  double area = 0;
  for (std::size_t i = 0; i < s.irradiance.size(); ++i) {
    mean += s.mesh.patches()[i].area * s.irradiance[i], area += s.mesh.patches()[i].area;
    for (int c = 0; c < 2; ++c) {
      EXPECT_NEAR(s.irradiance[i][c], 1, 4.5 * s.irradiance_noise[i][c]) << i;
      EXPECT_LT(s.irradiance_noise[i][c], .02) << i;
    }
  }
  for (int c = 0; c < 2; ++c) EXPECT_NEAR(mean[c] / area, 1, 1e-3);
}

// A room beside a perfect mirror is half of one twice as large: elements that see themselves and what is behind them.
TEST(ExtendedRadiosity, a_mirror_doubles_a_room) {
  for (const double scale : {1.0, 1e-6, 1e6}) {
    const scene::Scene half = test::half_or_whole(false, scale), whole = test::half_or_whole(true, scale);
    const RadiositySolution by_mirror = solved_by_rays(half, .25 * scale, 16384),
                            doubled = solved_by_rays(whole, .25 * scale, 16384, 2, 2);
    ASSERT_EQ(doubled.irradiance.size(), 2 * by_mirror.irradiance.size());
    Spectrum of_half, of_whole;
    for (std::size_t i = 0; i < by_mirror.irradiance.size(); ++i)
      for (int c = 0; c < 2; ++c) {
        const double noise = std::hypot(by_mirror.irradiance_noise[i][c], doubled.irradiance_noise[i][c]);
        EXPECT_NEAR(by_mirror.irradiance[i][c], doubled.irradiance[i][c], 5 * noise) << i;
        EXPECT_LT(noise, .1 * doubled.irradiance[i][c]) << i;
        of_half[c] += by_mirror.mesh.patches()[i].area * by_mirror.irradiance[i][c];
        of_whole[c] += by_mirror.mesh.patches()[i].area * doubled.irradiance[i][c];
      }
    for (int c = 0; c < 2; ++c) EXPECT_NEAR(of_half[c], of_whole[c], .005 * of_whole[c]);
  }
}

/// A room with a coloured mirror, a tinted pane and a block of glass.
scene::Scene coloured() {
  scene::SceneBuilder builder({"a", "b"}, scene::Quantity::radiometric);
  builder.add_box("room", {Vec3(0, 0, 0), Vec3(3, 2, 1)}, builder.add_material(test::painted(.5, .7)),
                  scene::SceneBuilder::Facing::inward);
  builder.add_polygon("lamp", parallelogram(Vec3(1.2, .6, .95), .4 * y, .6 * x),
                      builder.add_material(test::painted(.3, .1, 10)));
  builder.add_polygon("mirror", parallelogram(Vec3(.02, .1, .1), 1.8 * y, .8 * z),
                      builder.add_material(of_finish(scene::Mirror{both(.9, .4)})));
  builder.add_polygon("pane", parallelogram(Vec3(2, .1, .05), 1.8 * y, .8 * z),
                      builder.add_material(of_finish(scene::Pane{both(.3, .8)})));
  builder.add_box("glass", {Vec3(.8, .4, .1), Vec3(1.2, .8, .4)},
                  builder.add_material(of_finish(scene::Glass{1.5, 0})));
  builder.scene().cameras.push_back({"c", Vec3(2.8, 1, .6), Vec3(.5, 1, .4), z, 60, 4, 3});
  return builder.finish();
}

// Walks of a sampling solver see by mirrors too, and find what form factors do.
TEST(ExtendedRadiosity, by_walks_as_by_form_factors) {
  const scene::Scene scene = coloured();
  const RadiositySolution matrix = solved_by_rays(scene, .3, 8192);
  RadiositySettings settings;
  settings.element_size = .3;
  settings.solver = "stochastic-jacobi";
  settings.stopping.noise = .006;
  core::LocalRun run(5, 2);
  const RadiositySolution walks = solve_radiosity(scene, settings, run.get());
  Spectrum by_matrix, by_walks;
  for (std::size_t i = 0; i < matrix.irradiance.size(); ++i) {
    const double area = matrix.mesh.patches()[i].area;
    by_matrix += area * matrix.irradiance[i], by_walks += area * walks.irradiance[i];
    for (int c = 0; c < 2; ++c)
      EXPECT_NEAR(walks.irradiance[i][c], matrix.irradiance[i][c],
                  5.5 * std::hypot(walks.irradiance_noise[i][c], matrix.irradiance_noise[i][c]))
          << i;
  }
  for (int c = 0; c < 2; ++c) EXPECT_NEAR(by_walks[c], by_matrix[c], .01 * by_matrix[c]);
}

// The same seed, the same bits; colours solved channel by channel.
TEST(ExtendedRadiosity, same_bits_for_any_threads) {
  const scene::Scene scene = coloured();
  const RadiositySolution one = solved_by_rays(scene, .5, 1024, 1);
  for (const unsigned threads : {2u, 3u, 8u})
    EXPECT_EQ(solved_by_rays(scene, .5, 1024, threads).irradiance, one.irradiance) << threads;
}

// Light in the second channel alone is light: the first is forecast and solved as it is where there is some.
TEST(ExtendedRadiosity, is_not_dark_with_light_in_one_channel) {
  scene::Scene scene = coloured();
  for (scene::Material& material : scene.materials) material.exitance[0] = 0;
  RadiositySettings settings;
  settings.element_size = .5;
  core::LocalRun run(1, 2);
  const Forecast of_one = forecast(scene, settings, run.get()), of_both = forecast(coloured(), settings, run.get());
  EXPECT_EQ(of_one.elements, of_both.elements);
  EXPECT_EQ(of_one.bytes, of_both.bytes);
  EXPECT_GT(of_one.seconds, .05 * of_both.seconds);
  const RadiositySolution one = solved_by_rays(scene, .5, 1024), both = solved_by_rays(coloured(), .5, 1024);
  ASSERT_EQ(one.irradiance.size(), both.irradiance.size());
  for (std::size_t i = 0; i < one.irradiance.size(); ++i) {
    EXPECT_EQ(one.irradiance[i][0], 0);
    EXPECT_EQ(one.irradiance[i][1], both.irradiance[i][1]);
  }
  EXPECT_FALSE(one.row_sum.empty());
}

// Colours are solved channel by channel: each is what it is by itself; groups too, where some are dark in a channel.
TEST(ExtendedRadiosity, has_the_channels_of_channels) {
  scene::SceneBuilder builder({"a", "b", "c"}, scene::Quantity::radiometric);
  const auto lamp = [&](const char* group, double a, double b) {
    scene::Material material = test::painted(.3, .1);
    material.name = group, material.exitance = both(a, b);
    return builder.add_material(material);
  };
  builder.add_box("room", {Vec3(0, 0, 0), Vec3(3, 2, 1)}, builder.add_material(test::painted(.5, .7)),
                  scene::SceneBuilder::Facing::inward);
  builder.add_polygon("red", parallelogram(Vec3(1.2, .6, .95), .4 * y, .6 * x), lamp("red", 5, 0));
  builder.add_polygon("blue", parallelogram(Vec3(2.2, .6, .9), .4 * y, .3 * x), lamp("blue", 0, 7));
  builder.add_polygon("white", parallelogram(Vec3(.4, 1.2, .85), .3 * y, .2 * x), lamp("white", 3, 4));
  builder.add_polygon("mirror", parallelogram(Vec3(.02, .1, .1), 1.8 * y, .8 * z),
                      builder.add_material(of_finish(scene::Mirror{both(.9, .4)})));
  builder.scene().weights = both(.2, .7);
  const scene::Scene scene = builder.finish();
  RadiositySettings settings;
  settings.element_size = .5;
  settings.samples = 512;
  settings.form_factors = "hemisphere-rays";
  settings.light_groups = true;
  core::LocalRun run(3, 2);
  const RadiositySolution all = solve_radiosity(scene, settings, run.get());
  ASSERT_EQ(all.of_groups.size(), 3u);
  const std::vector<std::vector<std::string>> groups{{"red", "white"}, {"blue", "white"}, {}};
  for (int c = 0; c < 3; ++c) {
    const RadiositySolution one = solve_radiosity(in_one_channel(scene, c), settings, run.get());
    for (std::size_t i = 0; i < all.irradiance.size(); ++i) {
      EXPECT_EQ(all.irradiance[i][c], one.irradiance[i][0]);
      EXPECT_EQ(all.irradiance_noise[i][c], one.irradiance_noise[i][0]);
      Spectrum sum;
      for (const RadiositySolution& group : all.of_groups) sum += group.irradiance[i];
      EXPECT_NEAR(sum[c], all.irradiance[i][c], 1e-8 * all.irradiance[i].max());
    }
    ASSERT_EQ(one.of_groups.size(), groups[static_cast<std::size_t>(c)].size());
  }
  for (std::size_t i = 0; i < all.irradiance.size(); ++i) {
    EXPECT_EQ(all.of_groups[0].irradiance[i][1], 0);
    EXPECT_EQ(all.of_groups[1].irradiance[i][0], 0);
    EXPECT_EQ(all.of_groups[1].reflectance[i], all.reflectance[i]);
  }
}

// What is not there bends nothing, however rough it is: no light of mirrors, and the solution of the empty room.
TEST(ExtendedRadiosity, glass_of_index_1_is_nothing) {
  const auto room = [](bool with_glass) {
    scene::SceneBuilder builder({"a"}, scene::Quantity::radiometric);
    builder.add_box("room", {Vec3(0, 0, 0), Vec3(3, 2, 1)}, builder.add_material(test::diffuse(.5)),
                    scene::SceneBuilder::Facing::inward);
    builder.add_polygon("lamp", parallelogram(Vec3(1.2, .6, .95), .4 * y, .6 * x),
                        builder.add_material(test::diffuse(.1, 9)));
    if (with_glass) {
      builder.add_box("rough", {Vec3(1, .5, .2), Vec3(1.6, 1.2, .8)},
                      builder.add_material(of_finish(scene::Glass{1, .4})));
      builder.add_box("smooth", {Vec3(2, .5, .2), Vec3(2.6, 1.2, .8)},
                      builder.add_material(of_finish(scene::Glass{1 + 1e-8, 0})));
    }
    return builder.finish();
  };
  const scene::Scene scene = room(true);
  const RadiositySolution s = solved_by_rays(scene, .5, 1024), empty = solved_by_rays(room(false), .5, 1024);
  EXPECT_NEAR(s.rows.mean, empty.rows.mean, 2e-3);
  const auto rays = raycast::make_ray_caster("brute", scene);
  core::LocalRun run(3, 2);
  const MirroredLight mirrored = mirrored_light(scene, s, *rays, run.get());
  for (std::size_t i = 0; i < s.irradiance.size(); ++i) {
    EXPECT_TRUE(mirrored.irradiance[i].is_zero());
    EXPECT_GT(mirrored.standard_error[i][0], 0);
  }
}

// emitted = absorbed by elements + what leaves them and gets to none, which mirrors and glass absorb here.
TEST(ExtendedRadiosity, energy_is_kept) {
  const RadiositySolution s = solved_by_rays(coloured(), .25, 4096);
  for (int c = 0; c < 2; ++c) {
    const double lost = s.energy.in_mirrors[c] + s.energy.on_backs[c];  // the lamp has a black back
    EXPECT_EQ(s.energy.escaped[c], 0);
    EXPECT_GT(s.energy.in_mirrors[c], .02 * s.energy.emitted[c]);
    EXPECT_NEAR(s.energy.emitted[c], s.energy.absorbed[c] + lost, .02 * s.energy.emitted[c]);
    EXPECT_NEAR(s.energy.residual[c], 0, 1e-6 * s.energy.emitted[c]);
  }
}

// A point on the floor is answered as its element is, a pixel sees B / pi in mirrors and through glass.
TEST(ExtendedRadiosity, answers_points_and_pixels) {
  const scene::Scene scene = coloured();
  const RadiositySolution s = solved_by_rays(scene, .2, 4096);
  const auto rays = raycast::make_ray_caster("embree", scene);
  const RadiosityMethod method(s, *rays);
  core::LocalRun run(2, 2);
  std::vector<measure::Measurement> asked;
  std::vector<std::size_t> elements;
  for (std::size_t i = 0; i < s.irradiance.size(); i += 37) {
    const scene::SurfacePatch& patch = s.mesh.patches()[i];
    asked.push_back(measure::PointIrradiance{patch.centroid(), patch.normal(), patch.surface});
    elements.push_back(i);
  }
  const std::vector<Estimate> found = method.answer(scene, asked, run.get());
  for (std::size_t k = 0; k < found.size(); ++k)
    for (int c = 0; c < 2; ++c)
      EXPECT_NEAR(found[k].value[c], s.irradiance[elements[k]][c],
                  4 * found[k].standard_error[c] + found[k].error_bound[c] + error_of(s, elements[k], c))
          << k;
  const std::vector<measure::Measurement> pixels{measure::PixelRadiance{{0}, 1, 1}, measure::PixelRadiance{{0}, 2, 0}};
  for (const Estimate& each : method.answer(scene, pixels, run.get())) {
    EXPECT_GT(each.value[0], 0);
    EXPECT_LT(each.standard_error[0], .5 * each.value[0]);
  }
}

TEST(ExtendedRadiosity, is_a_field_of_places) {
  const scene::Scene scene = test::half_or_whole(false);
  const RadiositySolution s = solved_by_rays(scene, .3, 1024);
  const auto rays = raycast::make_ray_caster("brute", scene);
  core::LocalRun run(3, 2);
  const MirroredLight mirrored = mirrored_light(scene, s, *rays, run.get());
  const measure::SurfaceSolution field = as_surface_solution(s, mirrored);
  for (std::size_t i = 0; i < s.irradiance.size(); ++i) {
    const scene::SurfacePatch& patch = s.mesh.patches()[i];
    const scene::SurfacePoint at{patch.surface, patch.side, 0, Vec2::Zero(), patch.centroid(), patch.normal()};
    EXPECT_EQ(field.at(at).reflected, s.reflectance[i] * s.irradiance[i]);
    EXPECT_EQ(field.at(at).mirrored, s.reflectance[i] * mirrored.irradiance[i]);
    EXPECT_GE(field.at(at).error_bound[0], 0);
  }
  const scene::SurfaceId mirror = scene.surface_ids().back();
  EXPECT_TRUE(field.at({mirror, scene::Side::front, 0, Vec2::Zero(), Vec3(0, .5, .5), x}).reflected.is_zero());
}

// A lamp that a mirror shows: the light of its image, R F(i, image) E, and none of what comes straight.
TEST(MirroredLight, is_that_of_images_of_lamps) {
  scene::SceneBuilder builder({"a", "b"}, scene::Quantity::radiometric);
  builder.add_polygon("floor", parallelogram(Vec3::Zero(), 2 * x, y), builder.add_material(test::painted(.5, .5)));
  builder.add_polygon("lamp", parallelogram(Vec3(.5, .2, .5), .4 * x, .3 * y),
                      builder.add_material(test::painted(0, 0, 3)));
  builder.add_polygon("mirror", parallelogram(Vec3(-50, -50, 2), 100 * y, 100 * x),
                      builder.add_material(of_finish(scene::Mirror{both(.9, .4)})));
  const scene::Scene scene = builder.finish();
  scene::SceneBuilder image({"a", "b"}, scene::Quantity::radiometric);
  image.add_polygon("floor", parallelogram(Vec3::Zero(), 2 * x, y), image.add_material(test::painted(0, 0)));
  image.add_polygon("image", parallelogram(Vec3(.5, .2, 3.5), .3 * y, .4 * x),
                    image.add_material(test::painted(0, 0, 3)));
  scene::Material black = test::painted(0, 0);
  image.add_polygon("lamp's back", parallelogram(Vec3(.5, .2, .5), .4 * x, .3 * y), image.add_material(black));
  const scene::Scene unfolded = image.finish();
  const RadiositySolution s = solved_by_rays(scene, .25, 256);
  RadiositySettings exact;
  exact.element_size = .25;
  exact.form_factors = "analytic";
  core::LocalRun run(3, 2);
  const RadiositySolution of_image = solve_radiosity(unfolded, exact, run.get());
  const auto rays = raycast::make_ray_caster("brute", scene);
  const MirroredLight found = mirrored_light(scene, s, *rays, run.get());
  for (std::size_t i = 0; i < s.irradiance.size(); ++i) {
    if (scene.surface(s.mesh.patches()[i].surface).name != "floor") continue;
    for (int c = 0; c < 2; ++c) {
      const double expected = (c == 0 ? .9 : .4) * of_image.irradiance[i][c];
      EXPECT_NEAR(found.irradiance[i][c], expected, 4.5 * found.standard_error[i][c] + 1e-3 * expected) << i;
      EXPECT_LT(found.standard_error[i][c], .05 * expected + .01) << i;  // beneath the lamp nothing is expected
    }
  }
}

std::string refusal(const scene::Scene& scene, const RadiositySettings& settings) {
  core::LocalRun run(1, 1);
  try {
    solve_radiosity(scene, settings, run.get());
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ExtendedRadiosity, refuses_what_does_not_see_mirrors) {
  const scene::Scene scene = test::half_or_whole(false);
  RadiositySettings settings;
  settings.element_size = 1;
  settings.form_factors = "analytic";
  EXPECT_NE(refusal(scene, settings).find("hemisphere-rays"), std::string::npos);
  settings.form_factors = default_form_factors;
  settings.form_factors_chosen = true;
  EXPECT_NE(refusal(scene, settings).find("hemisphere-rays"), std::string::npos);
  settings.form_factors_chosen = false;
  EXPECT_EQ(refusal(scene, settings), "");
  settings.form_factors = "hemisphere-rays";
  settings.closure = "scaling";
  EXPECT_NE(refusal(scene, settings).find("closure"), std::string::npos);
  scene::SceneBuilder builder = test::furnace();
  builder.add_polygon("rough", parallelogram(Vec3(1, 1, .2), .5 * x, .5 * y),
                      builder.add_material(of_finish(scene::Metal{Spectrum(.8), .3})));
  const scene::Scene rough = builder.finish();
  RadiositySettings defaults;
  defaults.element_size = 1;
  EXPECT_NE(refusal(rough, defaults).find("two-pass"), std::string::npos);
  defaults.rough_is_black = true;
  EXPECT_EQ(refusal(rough, defaults), "");
}

}  // namespace
}  // namespace interflect::fem
