#include "montecarlo/render.h"

#include "core/student_t.h"
#include "montecarlo/film/reconstruction_filter.h"
#include "tests/montecarlo/statistics.h"
#include "tests/montecarlo/stopping_caster.h"
#include "tests/support/shapes.h"

namespace interflect::montecarlo {
namespace {

using scene::SceneBuilder;

/// A cube whose floor emits (rho 1/2), seen from inside.
scene::Scene lit_cube(double rho, double everywhere, double floor, int width, int height) {
  SceneBuilder builder({"r", "g"});
  scene::Material wall, lit;
  for (int c = 0; c < 2; ++c)
    wall.reflectance[c] = lit.reflectance[c] = rho, wall.exitance[c] = (c + 1) * everywhere,
    lit.exitance[c] = (c + 1) * floor;
  builder.add_box("cube", {Vec3(0, 0, 0), Vec3(1, 1, 1)}, builder.add_material(wall), SceneBuilder::Facing::inward);
  builder.scene().surfaces[test::surface_named(builder.scene(), "cube/z-").value].material = builder.add_material(lit);
  builder.scene().cameras.push_back({"eye", Vec3(0.5, 0.1, 0.5), Vec3(0.5, 1, 0.4), Vec3::UnitZ(), 80, width, height});
  return builder.finish();
}

// In a furnace every pixel is 1 / pi in the first channel and 2 / pi in the second.
TEST(Render, shows_a_furnace_as_one_even_radiance) {
  const scene::Scene scene = lit_cube(0.5, 0.5, 0.5, 24, 16);
  core::LocalRun run;
  const Rendering found = render(scene, {0}, 256, run);
  EXPECT_EQ(found.samples, 256u);
  EXPECT_EQ(found.radiance.width, 24);
  EXPECT_EQ(found.radiance.height, 16);
  EXPECT_EQ(found.radiance.channels, scene.channels);
  const double limit = test::critical_z(test::alpha, 2 * 24 * 16 + 1);
  double sum = 0;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 24; ++x)
      for (int c = 0; c < 2; ++c) {
        const double z = (found.radiance.at(x, y, c) - (c + 1) * inv_pi) / found.standard_error.at(x, y, c);
        EXPECT_LT(std::abs(z), limit) << x << ' ' << y << ' ' << c;
        if (c == 0) sum += z;
      }
  // The signed mean of z: a loss of 1 % everywhere would pass every single pixel.
  EXPECT_LT(std::abs(sum / std::sqrt(24.0 * 16)), limit);
}

// The picture and the measurement are the same number by two roads: pixel (x, y) of the image is what PixelRadiance
// answers.
TEST(Render, agrees_with_the_measurement_of_single_pixels) {
  const scene::Scene scene = lit_cube(0.5, 0, 1, 12, 10);
  core::LocalRun run;
  const Rendering found = render(scene, {0}, 4096, run);
  std::vector<measure::Measurement> asked;
  for (int y = 0; y < 10; y += 3)
    for (int x = 0; x < 12; x += 3) asked.emplace_back(measure::PixelRadiance{{0}, x, y});
  const auto pixels = PathTracer({.samples = 4096}).answer(scene, asked, run);
  const double limit = test::critical_z(test::alpha, 2 * pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const auto& [camera, x, y] = std::get<measure::PixelRadiance>(asked[i]);
    for (int c = 0; c < 2; ++c) {
      const double se = std::hypot(pixels[i].standard_error[c], found.standard_error.at(x, y, c));
      EXPECT_LE(std::abs(pixels[i].value[c] - found.radiance.at(x, y, c)), limit * se + 1e-6) << x << ' ' << y;
    }
  }
  // The floor's emission is seen in the lower part of the picture alone.
  EXPECT_GT(found.radiance.at(6, 9, 0), 0.9 * inv_pi);
  EXPECT_LT(found.radiance.at(6, 2, 0), 0.5 * inv_pi);
}

// A pixel is the mean over its area on the image plane.  Frames of 90 degrees, one pixel and then 2 x 2, onto a black
// scene with a lamp of radiance 1 on the left quarter of the upper half: 1/8 of the whole frame, 1/2 of the upper left
// pixel.
TEST(Render, averages_a_pixel_over_its_area_on_the_image_plane) {
  SceneBuilder builder({"grey"});
  builder.add_polygon("lamp", {{Vec3(-1, 1, -1), Vec3(-1, 0, -1), Vec3(-0.5, 0, -1), Vec3(-0.5, 1, -1)}, {}},
                      builder.add_material(test::diffuse("lamp", 0, pi)));
  builder.scene().cameras.push_back({"one", Vec3(0, 0, 0), -Vec3::UnitZ(), Vec3::UnitY(), 90, 1, 1});
  builder.scene().cameras.push_back({"four", Vec3(0, 0, 0), -Vec3::UnitZ(), Vec3::UnitY(), 90, 2, 2});
  const scene::Scene scene = builder.finish();
  const auto pixel = [](std::uint32_t camera, int x, int y, double part) {
    return test::Question{measure::PixelRadiance{{camera}, x, y}, test::grey(part), "pixel"};
  };
  test::expect_agreement(scene,
                         {pixel(0, 0, 0, 1.0 / 8), pixel(1, 0, 0, 1.0 / 2), pixel(1, 1, 0, 0), pixel(1, 0, 1, 0)},
                         {.samples = 100'000}, 0.02);
}

TEST(Render, gives_the_same_bits_for_any_number_of_threads) {
  const scene::Scene scene = lit_cube(0.5, 0, 1, 40, 30);
  core::LocalRun one(5, 1);
  const Rendering expected = render(scene, {0}, 11, one);
  EXPECT_EQ(expected.samples, 11u);
  for (unsigned threads : {2u, 3u, 8u}) {
    core::LocalRun run(5, threads);
    const Rendering found = render(scene, {0}, 11, run);
    EXPECT_EQ(found.radiance.data, expected.radiance.data);
    EXPECT_EQ(found.standard_error.data, expected.standard_error.data);
  }
}

// A sample of this closed room is 5 rays or so (a ray to the wall, two a vertex, two vertices), and the first pass has
// 1600 samples: the 40 000th ray falls into a later one.
TEST(Render, gives_the_whole_picture_when_it_is_stopped_and_throws_when_there_is_none) {
  const scene::Scene scene = lit_cube(0.5, 0, 1, 20, 20);
  std::stop_source source;
  core::LocalRun run(1, 1);
  run.get().stop = source.get_token();
  const test::StoppingCaster caster(scene, source, 40'000);
  const Rendering found = render(scene, {0}, 1u << 30, run, caster);
  EXPECT_GE(found.samples, 4u);
  EXPECT_LT(found.samples, 64u);
  for (float value : found.radiance.data) EXPECT_GT(value, 0);
  EXPECT_THROW(render(scene, {0}, 4, run), core::Interrupted);
  EXPECT_THROW(render(scene, {1}, 4, run), core::InputError);
  EXPECT_THROW(render(scene, {0}, 0, run), core::InputError);
}

RenderSettings settings_with(std::uint64_t samples, const std::string& filter, const std::string& sequence) {
  RenderSettings settings;
  settings.samples = samples, settings.filter = filter, settings.sequence = sequence;
  return settings;
}

void expect_same(const Rendering& a, const Rendering& b) {
  EXPECT_EQ(a.samples, b.samples);
  EXPECT_EQ(a.radiance.data, b.radiance.data);
  EXPECT_EQ(a.standard_error.data, b.standard_error.data);
  EXPECT_EQ(a.samples_a_pixel.data, b.samples_a_pixel.data);
}

/// That need no solution of radiosity.
constexpr const char* without_a_solution[] = {"path", "bidirectional", "light", "distributed", "whitted"};

/// Of a room that is diffuse.
measure::PathClasses found_in_pictures(const std::string& integrator) {
  const bool trees = integrator == "whitted" || integrator == "distributed";
  return measure::PathClasses::of(trees ? "LD?E" : "L.*E");
}

// Stopped once and again, at any ray, on other numbers of threads, and asked for more samples on the way: the bits of a
// run that nothing stopped.
TEST(Render, goes_on_from_where_it_was_stopped_to_the_same_bits) {
  const scene::Scene scene = lit_cube(0.5, 0, 1, 20, 16);
  // Rays before a stop: sweeps are whole or not at all, and whitted's first pass has 16 samples a pixel.
  for (const auto& [filter, sequence, integrator, rays_before_a_stop] :
       {std::tuple{"box", "independent", "path", 9'000},
        {"mitchell", "independent", "path", 9'000},
        {"gaussian", "zero-two", "path", 9'000},
        {"box", "independent", "bidirectional", 150'000},
        {"mitchell", "independent", "bidirectional", 150'000},
        {"box", "independent", "light", 60'000},
        {"mitchell", "independent", "light", 60'000},
        {"box", "independent", "distributed", 9'000},
        {"mitchell", "independent", "distributed", 9'000},
        {"box", "independent", "whitted", 3'000},
        {"mitchell", "independent", "whitted", 6'000}}) {
    const auto settings_of = [&, filter = filter, sequence = sequence, integrator = integrator](std::uint64_t samples) {
      RenderSettings of = settings_with(samples, filter, sequence);
      of.integrator = integrator, of.paths = found_in_pictures(integrator);
      return of;
    };
    const RenderSettings settings = settings_of(256);
    core::LocalRun undisturbed(3, 2);
    const auto rays = raycast::make_ray_caster("brute", scene);
    const Rendering expected = render(scene, {0}, settings, undisturbed, *rays);
    FilmState kept;
    int stops = 0;
    for (const unsigned threads : {1u, 3u, 2u, 7u, 1u}) {
      std::stop_source source;
      core::LocalRun run(3, threads);
      run.get().stop = source.get_token();
      const bool last = threads == 1 && stops > 0;
      const test::StoppingCaster caster(scene, source,
                                        last ? ~std::uint64_t{0} >> 1 : static_cast<std::uint64_t>(rays_before_a_stop));
      RenderCheckpoints checkpoints;
      const FilmState before = kept;
      if (kept.size() > 0) checkpoints.from = &before;
      checkpoints.keep = [&](const FilmState& state) { kept = state; };
      const RenderSettings some = stops == 0 ? settings_of(128) : settings;
      try {
        const Rendering found = render(scene, {0}, some, run, caster, checkpoints);
        if (last)
          expect_same(found, expected);
        else
          EXPECT_LT(found.samples, 256u) << integrator;
      } catch (const core::Interrupted&) {
        EXPECT_EQ(stops, 0) << integrator;  // before every pixel had a sample, and kept all the same
      }
      EXPECT_GT(kept.size(), 0);
      stops += last ? 0 : 1;
    }
    EXPECT_EQ(stops, 4);
  }
}

// By any integrator, pixel by pixel within both errors, filters with negative lobes too; sweeps splat into neighbours.
TEST(Render, is_the_same_picture_by_any_integrator) {
  const scene::Scene scene = lit_cube(0.5, 0, 1, 12, 10);
  const auto rays = raycast::make_ray_caster("embree", scene);
  for (const char* filter : {"box", "gaussian", "mitchell"})
    for (const auto& [integrator, samples] :
         {std::pair{"bidirectional", 512}, {"light", 4096}, {"distributed", 1024}, {"whitted", 512}}) {
      RenderSettings settings = settings_with(2048, filter, "independent");
      settings.paths = found_in_pictures(integrator);
      core::LocalRun run(3, 2);
      const Rendering path = render(scene, {0}, settings, run, *rays);
      settings.integrator = integrator, settings.samples = static_cast<std::uint64_t>(samples);
      const Rendering other = render(scene, {0}, settings, run, *rays);
      // Whitted's errors are those of 16 means: Student's, with 15 degrees of freedom.
      const std::size_t comparisons = 12 * path.radiance.data.size();
      const double limit =
          settings.integrator == "whitted"
              ? core::student_t(std::pow(1 - test::alpha, 1 / static_cast<double>(comparisons)), sequence_batches - 1)
              : test::critical_z(test::alpha, comparisons);
      for (std::size_t k = 0; k < path.radiance.data.size(); ++k) {
        const double error = std::hypot(path.standard_error.data[k], other.standard_error.data[k]);
        EXPECT_NEAR(other.radiance.data[k], path.radiance.data[k], limit * error + 1e-6)
            << integrator << ' ' << filter << ' ' << k;
        EXPECT_LT(error, .1 * path.radiance.data[k] + 1e-3) << integrator << ' ' << filter << ' ' << k;
      }
    }
}

// To a target it ends at 64 samples, or twice as many, .., where errors are as small, and not far below.
TEST(Render, ends_where_errors_are_as_small_as_is_asked_for) {
  const scene::Scene scene = lit_cube(0.5, 0, 1, 20, 16);
  const auto rays = raycast::make_ray_caster("embree", scene);
  for (const std::string integrator : without_a_solution) {
    RenderSettings settings = settings_with(1 << 16, "box", "independent");
    settings.integrator = integrator, settings.target = integrator == "whitted" ? .005 : .05;
    settings.paths = found_in_pictures(integrator);
    core::LocalRun run(3, 2);
    const Rendering found = render(scene, {0}, settings, run, *rays);
    EXPECT_LT(found.samples, settings.samples) << integrator;
    EXPECT_GT(found.samples, 64u) << integrator;
    EXPECT_EQ(found.samples & (found.samples - 1), 0u) << found.samples;
    settings.samples = found.samples, settings.target = 0;
    expect_same(render(scene, {0}, settings, run, *rays), found);
    settings.samples = 1 << 16, settings.target = .5;
    EXPECT_EQ(render(scene, {0}, settings, run, *rays).samples, 64u);
  }
}

// Checkpoints by the clock are whole states too, at any time.
TEST(Render, keeps_states_on_the_way) {
  const scene::Scene scene = lit_cube(0.5, 0, 1, 40, 30);
  core::LocalRun run(4, 2);
  const auto rays = raycast::make_ray_caster("embree", scene);
  const RenderSettings settings = settings_with(100, "box", "independent");
  std::vector<FilmState> kept;
  RenderCheckpoints checkpoints;
  checkpoints.seconds_between = 0, checkpoints.at_end = true;
  checkpoints.keep = [&](const FilmState& state) { kept.push_back(state); };
  const Rendering expected = render(scene, {0}, settings, run, *rays, checkpoints);
  ASSERT_GT(kept.size(), 3u);
  for (const FilmState& state : {kept.front(), kept[kept.size() / 2], kept.back()}) {
    RenderCheckpoints from;
    from.from = &state;
    expect_same(render(scene, {0}, settings, run, *rays, from), expected);
  }
  RenderCheckpoints from;
  from.from = &kept.back();
  EXPECT_THROW(render(scene, {0}, settings_with(64, "box", "independent"), run, *rays, from), core::InputError);
  EXPECT_THROW(render(scene, {0}, settings_with(160, "box", "sobol"), run, *rays, from), core::InputError);
  const FilmState less = kept.back().topRows(7);
  from.from = &less;
  EXPECT_THROW(render(scene, {0}, settings, run, *rays, from), core::InputError);
}

// However samples are cut into passes: of 48, then of 80, then of 160.
TEST(Render, goes_on_from_any_number_of_samples) {
  const scene::Scene scene = lit_cube(0.5, 0, 1, 20, 16);
  core::LocalRun run(3, 2);
  const auto rays = raycast::make_ray_caster("embree", scene);
  for (const std::string integrator : without_a_solution) {
    FilmState state;
    const auto gone_on_to = [&](std::uint64_t samples, bool from_state) {
      RenderSettings settings = settings_with(samples, "mitchell", "independent");
      settings.integrator = integrator, settings.paths = found_in_pictures(integrator);
      const FilmState before = state;
      RenderCheckpoints checkpoints;
      if (from_state) checkpoints.from = &before;
      checkpoints.seconds_between = 0, checkpoints.at_end = true;
      checkpoints.keep = [&](const FilmState& now) { state = now; };
      return render(scene, {0}, settings, run, *rays, checkpoints);
    };
    gone_on_to(48, false), gone_on_to(80, true);
    const Rendering parts = gone_on_to(160, true);
    expect_same(parts, gone_on_to(160, false));
  }
}

// A state may have come further in some pixels than the next pass goes: of a stop within a pass of another pace.
TEST(Render, goes_on_from_pixels_that_are_further_than_others) {
  const scene::Scene scene = lit_cube(0.5, 0, 1, 20, 16);
  core::LocalRun run(3, 2);
  const auto rays = raycast::make_ray_caster("embree", scene);
  for (const char* sequence : {"independent", "zero-two"}) {
    const auto state_at = [&](std::uint64_t samples) {
      FilmState state;
      RenderCheckpoints checkpoints;
      checkpoints.seconds_between = 0, checkpoints.at_end = true;
      checkpoints.keep = [&](const FilmState& now) { state = now; };
      render(scene, {0}, settings_with(samples, "box", sequence), run, *rays, checkpoints);
      return state;
    };
    FilmState mixed = state_at(16);
    const FilmState further = state_at(1024);
    ASSERT_EQ(mixed.rows(), further.rows());
    for (Index p = 0; p < mixed.rows(); p += 3) mixed.row(p) = further.row(p);
    RenderCheckpoints from;
    from.from = &mixed;
    const RenderSettings settings = settings_with(2048, "box", sequence);
    expect_same(render(scene, {0}, settings, run, *rays, from), render(scene, {0}, settings, run, *rays));
  }
}

// All that a path sees first is one radiance: an even picture is shown without noise by every filter.
TEST(Render, reproduces_constants_by_any_filter) {
  SceneBuilder builder({"grey"});
  builder.add_box("cube", {Vec3(0, 0, 0), Vec3(1, 1, 1)}, builder.add_material(test::diffuse("wall", 0, pi)),
                  SceneBuilder::Facing::inward);
  builder.scene().cameras.push_back({"eye", Vec3(0.5, 0.1, 0.5), Vec3(0.5, 1, 0.4), Vec3::UnitZ(), 80, 20, 15});
  const scene::Scene scene = builder.finish();
  core::LocalRun run;
  const auto rays = raycast::make_ray_caster("embree", scene);
  for (const char* filter : {"box", "triangle", "gaussian", "mitchell"}) {
    const Rendering found = render(scene, {0}, settings_with(64, filter, "independent"), run, *rays);
    for (std::size_t p = 0; p < found.radiance.data.size(); ++p) {
      EXPECT_FLOAT_EQ(found.radiance.data[p], 1) << filter;
      EXPECT_LT(found.standard_error.data[p], 1e-12) << filter;
    }
  }
}

// The filtered film of a lamp's edge, which runs along x = 10 between pixels: 1 to its left.  A pixel whose middle is d
// from the edge has int_(u < -d) h, of the pixel's own filter.
TEST(Render, filters_an_edge_as_it_should) {
  SceneBuilder builder({"grey"});
  builder.add_polygon("lamp", {{Vec3(-9, 9, -1), Vec3(-9, -9, -1), Vec3(0, -9, -1), Vec3(0, 9, -1)}, {}},
                      builder.add_material(test::diffuse("lamp", 0, pi)));
  builder.scene().cameras.push_back({"eye", Vec3(0, 0, 0), -Vec3::UnitZ(), Vec3::UnitY(), 90, 20, 6});
  const scene::Scene scene = builder.finish();
  core::LocalRun run;
  const auto rays = raycast::make_ray_caster("embree", scene);
  for (const char* name : {"box", "triangle", "gaussian", "mitchell"}) {
    const auto filter = make_filter(name);
    const Rendering found = render(scene, {0}, settings_with(4096, name, "independent"), run, *rays);
    for (int x = 7; x < 13; ++x) {
      constexpr int n = 512;
      double truth = 0;
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const double dx = 4 * (i + 0.5) / n - 2, dy = 4 * (j + 0.5) / n - 2;
          if (x + 0.5 + dx < 10) truth += filter->value({dx, dy}) * 16 / (n * n);
        }
      for (int y = 0; y < 6; ++y) {
        const double se = found.standard_error.at(x, y, 0);
        EXPECT_LT(std::abs(found.radiance.at(x, y, 0) - truth), test::critical_z(test::alpha, 36 * 4) * se + 1e-4)
            << name << ' ' << x << ' ' << y;
      }
    }
  }
}

// Errors of sequences are those of 16 randomisations each pixel by itself: (L - truth) / SE has Student's distribution
// with 15 degrees of freedom, within 2.131 of 0 in 95 % of all pixels.  Of 1200 pixels 1140 +- 7.5; 4 deviations either way.
TEST(Render, knows_how_wrong_sequences_are) {
  const scene::Scene scene = lit_cube(0.5, 0.5, 0.5, 40, 30);
  core::LocalRun run(2);
  const auto rays = raycast::make_ray_caster("embree", scene);
  const auto squares = [&](const std::string& sequence) {
    const Rendering found = render(scene, {0}, settings_with(256, "box", sequence), run, *rays);
    double sum = 0;
    int within = 0;
    for (int y = 0; y < 30; ++y)
      for (int x = 0; x < 40; ++x) {
        const double off = found.radiance.at(x, y, 0) - inv_pi;
        if (std::abs(off) < 2.131 * found.standard_error.at(x, y, 0)) ++within;
        sum += off * off;
      }
    if (sequence != "independent") {
      EXPECT_NEAR(within, 1140, 30) << sequence;
    }
    return sum;
  };
  const double independent = squares("independent");
  for (const char* sequence : {"stratified", "latin-hypercube", "sobol"})
    EXPECT_LT(squares(sequence), 1.1 * independent);
  for (const char* sequence : {"halton", "sobol-owen", "zero-two"})
    EXPECT_LT(squares(sequence), .8 * independent) << sequence;
  EXPECT_THROW(render(scene, {0}, settings_with(100, "box", "sobol"), run, *rays), core::InputError);
  EXPECT_THROW(render(scene, {0}, settings_with(16, "box", "sobel"), run, *rays), core::InputError);
  EXPECT_THROW(render(scene, {0}, settings_with(16, "bocks", "sobol"), run, *rays), core::InputError);
}

}  // namespace
}  // namespace interflect::montecarlo
