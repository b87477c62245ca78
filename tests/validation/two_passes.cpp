#include "montecarlo/two_pass/two_pass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "fem/radiosity.h"
#include "fem/surface_solution.h"
#include "montecarlo/bidirectional/bidirectional_tracer.h"
#include "montecarlo/render.h"
#include "tests/montecarlo/rooms.h"

/// Radiosity and paths together, against paths alone.
namespace interflect {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

Spectrum both(double a, double b) {
  Spectrum s = test::grey(a);
  s[1] = b;
  return s;
}

/// A room with a block, a lamp and a camera, to be furnished.
scene::SceneBuilder room(double scale) {
  scene::SceneBuilder builder({"a", "b"});
  const auto painted = [&](double a, double b, double lamp = 0) {
    scene::Material material = test::diffuse("painted", a, lamp);
    material.reflectance = both(a, b), material.exitance = both(lamp, 2 * lamp);
    return builder.add_material(material);
  };
  builder.add_box("room", {Vec3::Zero(), scale * Vec3(3, 2, 1)}, painted(.5, .7), scene::SceneBuilder::Facing::inward);
  builder.add_box("block", {scale * Vec3(2.2, .2, .1), scale * Vec3(2.6, .6, .5)}, painted(.8, .3));
  builder.add_polygon("lamp", test::parallelogram(scale * Vec3(1.2, .6, .95), scale * .4 * y, scale * .6 * x),
                      painted(.3, .1, 10));
  builder.scene().cameras.push_back(
      {"c", scale * Vec3(2.8, 1, .6), scale * Vec3(.3, 1, .4), z, scene::Projection(scene::Pinhole{70}), 6, 4});
  return builder;
}

scene::MaterialId of(scene::SceneBuilder& builder, scene::Finish finish) {
  scene::Material material;
  material.name = "finish", material.finish = std::move(finish), material.sides = scene::Sides::both;
  return builder.add_material(material);
}

void add_smooth(scene::SceneBuilder& builder, double scale) {
  builder.add_polygon("mirror", test::parallelogram(scale * Vec3(.3, .1, .1), scale * 1.8 * y, scale * .8 * z),
                      of(builder, scene::Mirror{both(.9, .4)}));
  builder.add_polygon("pane", test::parallelogram(scale * Vec3(1.9, .1, .05), scale * 1.8 * y, scale * .8 * z),
                      of(builder, scene::Pane{both(.3, .8)}));
  builder.add_box("glass", {scale * Vec3(.8, .4, .1), scale * Vec3(1.2, .8, .4)}, of(builder, scene::Glass{1.5, 0}));
}

void add_rough(scene::SceneBuilder& builder, double scale) {
  builder.add_box("metal", {scale * Vec3(.4, 1.2, .1), scale * Vec3(.9, 1.7, .5)},
                  of(builder, scene::Metal{both(.9, .6), .3}));
  builder.add_polygon("table", test::parallelogram(scale * Vec3(1, .9, .3), scale * .6 * x, scale * .9 * y),
                      of(builder, scene::Metal{both(.7, .95), .5}));
  builder.add_box("frosted", {scale * Vec3(1.3, .2, .1), scale * Vec3(1.6, .6, .4)},
                  of(builder, scene::Glass{1.5, .4}));
}

std::vector<measure::Measurement> all_of(const scene::Scene& scene, double scale) {
  std::vector<measure::Measurement> asked;
  for (const scene::SurfaceId id : scene.surface_ids())
    asked.push_back(measure::Flux{measure::patches_of(scene, id, scene::Side::front)});
  asked.push_back(measure::PointIrradiance{scale * Vec3(.5, 1, .6), Vec3(.6, 0, .8), {}});
  asked.push_back(measure::PointIrradiance{scale * Vec3(1.7, 1.8, .2), z, {}});
  for (int k = 0; k < 6; ++k) asked.push_back(measure::PixelRadiance{{0}, k, k % 4});
  return asked;
}

/// Two passes and bidirectional path tracing agree within the errors that they state, which are cautious; and in the
/// mean of all that is asked better than these ask for.
void expect_two_passes_agree(const scene::Scene& scene, double scale, double element_size, double target) {
  fem::RadiositySettings settings;
  settings.element_size = element_size * scale;
  settings.rough_is_black = true;
  settings.form_factors = "hemisphere-rays";
  settings.samples = 8192;
  core::LocalRun run(4, 2);
  const fem::RadiositySolution solution = fem::solve_radiosity(scene, settings, run.get());
  montecarlo::TwoPassSettings passes;
  passes.target = target;
  const auto rays = raycast::make_ray_caster("embree", scene);
  const fem::MirroredLight mirrored = fem::mirrored_light(scene, solution, *rays, run.get());
  passes.solution = fem::as_surface_solution(solution, mirrored);
  montecarlo::BidirectionalTracerSettings paths;
  paths.target = target;
  const auto asked = all_of(scene, scale);
  const auto found = montecarlo::TwoPass(passes).answer(scene, asked, run.get()),
             known = montecarlo::BidirectionalTracer(paths).answer(scene, asked, run.get());
  const double limit = test::critical_z(test::alpha, asked.size() * 2);
  double squares = 0;
  for (std::size_t m = 0; m < asked.size(); ++m)
    for (int c = 0; c < 2; ++c) {
      const double noise = std::hypot(found[m].standard_error[c], known[m].standard_error[c]),
                   difference = found[m].value[c] - known[m].value[c];
      EXPECT_LE(std::abs(difference), limit * noise + found[m].error_bound[c]) << m << ", channel " << c;
      EXPECT_EQ(found[m].claim, Claim::estimated);
      squares += std::pow(difference / known[m].value[c], 2);
    }
  EXPECT_LT(std::sqrt(squares / (2 * static_cast<double>(asked.size()))), 2.5 * target);
}

TEST(TwoPasses, agree_with_paths_in_a_diffuse_room) { expect_two_passes_agree(room(1).finish(), 1, .16, .01); }

TEST(TwoPasses, agree_with_paths_beside_mirrors_and_glass) {
  for (const double scale : {1e-6, 1e6}) {
    scene::SceneBuilder builder = room(scale);
    add_smooth(builder, scale);
    expect_two_passes_agree(builder.finish(), scale, .2, .02);
  }
}

TEST(TwoPasses, agree_with_paths_beside_rough_metal_and_glass) {
  scene::SceneBuilder builder = room(1);
  add_smooth(builder, 1);
  add_rough(builder, 1);
  expect_two_passes_agree(builder.finish(), 1, .16, .015);
}

TEST(TwoPasses, same_bits_for_any_threads) {
  scene::SceneBuilder builder = room(1);
  add_smooth(builder, 1);
  add_rough(builder, 1);
  const scene::Scene scene = builder.finish();
  const auto by = [&](unsigned threads) {
    fem::RadiositySettings settings;
    settings.element_size = .5;
    settings.rough_is_black = true;
    core::LocalRun run(4, threads);
    const fem::RadiositySolution solution = fem::solve_radiosity(scene, settings, run.get());
    montecarlo::TwoPassSettings passes;
    passes.samples = 500;
    const auto rays = raycast::make_ray_caster("embree", scene);
    const fem::MirroredLight mirrored = fem::mirrored_light(scene, solution, *rays, run.get());
    passes.solution = fem::as_surface_solution(solution, mirrored);
    std::vector<double> bits;
    for (const Estimate& each : montecarlo::TwoPass(passes).answer(scene, all_of(scene, 1), run.get()))
      for (int c = 0; c < 2; ++c) bits.insert(bits.end(), {each.value[c], each.standard_error[c], each.error_bound[c]});
    return bits;
  };
  const auto one = by(1);
  for (const unsigned threads : {2u, 3u, 8u}) EXPECT_EQ(by(threads), one) << threads;
}

/// A floor that a screen hides from the lamp: all that it gets first is by the mirror, A S D.
scene::Scene lit_by_a_mirror() {
  scene::SceneBuilder builder({"a", "b"});
  const auto painted = [&](double a, double b, double lamp = 0) {
    scene::Material material = test::diffuse("painted", a, lamp);
    material.reflectance = both(a, b), material.exitance = both(lamp, 2 * lamp);
    return builder.add_material(material);
  };
  builder.add_polygon("floor", test::parallelogram(Vec3(0, -2, 0), 4 * x, 4 * y), painted(.6, .3));
  builder.add_polygon("screen", test::parallelogram(Vec3(1, -2, .6), 3 * x, 4 * y), painted(0, 0));
  builder.add_polygon("lamp", test::parallelogram(Vec3(1.2, -.4, .7), .8 * x, .8 * y), painted(0, 0, 20));
  builder.add_polygon("mirror", test::parallelogram(Vec3(-1, -3, 2), 6 * y, 6 * x),
                      of(builder, scene::Mirror{both(.9, .5)}));
  builder.scene().cameras.push_back(
      {"c", Vec3(.4, -.1, 1.5), Vec3(.4, 0, 0), x, scene::Projection(scene::Orthographic{.6}), 4, 4});
  return builder.finish();
}

/// Both passes over a scene, kept together.
struct Solved {
  Solved(const scene::Scene& scene, double element_size, std::uint64_t seed) {
    fem::RadiositySettings settings;
    settings.element_size = element_size;
    settings.rough_is_black = true;
    core::LocalRun run(seed, 2);
    radiosity = std::make_unique<fem::RadiositySolution>(fem::solve_radiosity(scene, settings, run.get()));
    const auto rays = raycast::make_ray_caster("embree", scene);
    mirrored = fem::mirrored_light(scene, *radiosity, *rays, run.get());
    solution = fem::as_surface_solution(*radiosity, mirrored);
  }
  std::unique_ptr<fem::RadiositySolution> radiosity;
  fem::MirroredLight mirrored;
  measure::SurfaceSolution solution;
};

// Light by a mirror is found once, and is all there is: a factor of two would show, in pixels without bounds.
TEST(TwoPasses, find_what_a_mirror_throws_once) {
  const scene::Scene scene = lit_by_a_mirror();
  const Solved solved(scene, .06, 3);
  montecarlo::TwoPassSettings passes;
  passes.samples = 4096;
  passes.solution = solved.solution;
  montecarlo::BidirectionalTracerSettings paths;
  paths.target = .03;
  std::vector<measure::Measurement> pixels;
  for (int k = 0; k < 16; ++k) pixels.emplace_back(measure::PixelRadiance{{0}, k % 4, k / 4});
  core::LocalRun run(5, 2);
  const auto found = montecarlo::TwoPass(passes).answer(scene, pixels, run.get()),
             known = montecarlo::BidirectionalTracer(paths).answer(scene, pixels, run.get());
  Spectrum all_found, all_known;
  for (std::size_t m = 0; m < pixels.size(); ++m) {
    all_found += found[m].value, all_known += known[m].value;
    for (int c = 0; c < 2; ++c) {
      EXPECT_NEAR(found[m].value[c], known[m].value[c], .1 * known[m].value[c]) << m;
      EXPECT_LE(std::abs(found[m].value[c] - known[m].value[c]),
                found[m].error_bound[c] + 4 * found[m].standard_error[c]);
    }
  }
  for (int c = 0; c < 2; ++c) EXPECT_NEAR(all_found[c], all_known[c], .02 * all_known[c]);
}

// A picture's pixels are the answers, by filters with negative lobes too; stopped and gone on with to the same bits.
TEST(TwoPasses, make_pictures_of_their_pixels) {
  scene::SceneBuilder builder = room(1);
  add_smooth(builder, 1);
  add_rough(builder, 1);
  const scene::Scene scene = builder.finish();
  const Solved solved(scene, .3, 3);
  const auto rays = raycast::make_ray_caster("embree", scene);
  montecarlo::TwoPassSettings passes;
  passes.samples = 40000;
  passes.solution = solved.solution;
  std::vector<measure::Measurement> pixels;
  for (int k = 0; k < 24; ++k) pixels.emplace_back(measure::PixelRadiance{{0}, k % 6, k / 6});
  core::LocalRun run(5, 2);
  const auto known = montecarlo::TwoPass(passes).answer(scene, pixels, run.get());
  montecarlo::RenderSettings settings;
  settings.integrator = "two-pass";
  settings.samples = 40000;
  settings.solution = solved.solution;
  const auto picture = montecarlo::render(scene, {0}, settings, run.get(), *rays);
  const double limit = test::critical_z(test::alpha, 48);
  Spectrum of_pixels, of_pictures;
  for (int k = 0; k < 24; ++k)
    for (int c = 0; c < 2; ++c) {
      const Estimate& pixel = known[static_cast<std::size_t>(k)];
      const double of_picture = picture.radiance.at(k % 6, k / 6, c),
                   error = picture.standard_error.at(k % 6, k / 6, c);
      // Both have the same solution: they differ by their own samples alone, less than either tells.
      EXPECT_NEAR(of_picture, pixel.value[c], limit * std::sqrt(2) * pixel.standard_error[c]) << k;
      of_pixels[c] += pixel.value[c], of_pictures[c] += of_picture;
      EXPECT_GT(error * normal_95, pixel.error_bound[c] / 2) << k;
    }
  for (int c = 0; c < 2; ++c) EXPECT_NEAR(of_pictures[c], of_pixels[c], .01 * of_pixels[c]);
  for (const char* filter : {"box", "mitchell"}) {
    settings.filter = filter, settings.samples = 64;
    const auto whole = montecarlo::render(scene, {0}, settings, run.get(), *rays);
    montecarlo::FilmState state;
    montecarlo::RenderCheckpoints checkpoints;
    settings.samples = 20;
    core::LocalRun three(5, 3);
    montecarlo::RenderCheckpoints keep;
    keep.seconds_between = 0, keep.at_end = true;
    keep.keep = [&](const montecarlo::FilmState& now) { state = now; };
    montecarlo::render(scene, {0}, settings, three.get(), *rays, keep);
    settings.samples = 64;
    checkpoints.from = &state;
    const auto resumed = montecarlo::render(scene, {0}, settings, three.get(), *rays, checkpoints);
    EXPECT_EQ(resumed.radiance.data, whole.radiance.data) << filter;
    EXPECT_EQ(resumed.standard_error.data, whole.standard_error.data) << filter;
  }
}

/// What a rectangle of sides a and b, E = 1, sends to what faces it from a unit above one of its corners.
double from_corner(double a, double b) {
  const double A = std::hypot(1, a), B = std::hypot(1, b);
  return inv_pi / 2 * (a / A * std::atan(b / A) + b / B * std::atan(a / B));
}

/// Of the two squares that face each other (docs/truths.md, V1), with what the solution has in it: all but what comes
/// straight from the lower one, or of pixels of what they see.
struct OfSquares : test::Question {
  double by_solution;
};
std::vector<OfSquares> questions_of_squares(const scene::Scene& scene) {
  const auto half = [&](const char* name) {  // what a diagonal mirrors is the same on either
    return measure::PatchIrradiance{
        measure::patches_of(scene, test::surface_named(scene, name), scene::Side::front)[0]};
  };
  const double bright = .100947189239 / .5, dark = .010218055060 / .5, at_quarter = .104998409669 / .5,
               straight = .199824895698,
               straight_at_quarter = from_corner(.25, .25) + 2 * from_corner(.25, .75) + from_corner(.75, .75);
  return {{test::whole(scene, "upper", bright), bright - straight},
          {test::whole(scene, "lower", dark), dark},
          {{half("upper"), test::grey(bright), "half of upper"}, bright - straight},
          {{half("lower"), test::grey(dark), "half of lower"}, dark},
          {test::at_point({.25, .25, 1}, -z, at_quarter, test::surface_named(scene, "upper")),
           at_quarter - straight_at_quarter},
          {{measure::PixelRadiance{{0}, 0, 0}, test::grey(.5 * bright * inv_pi), "pixel"},
           .5 * (bright - straight) * inv_pi}};
}

/// Of 200 seeds 95 % intervals hold a number in 181 .. 197: fewer with a probability of .0027, more with .0023.
constexpr int seeds = 200, fewest_held = 181, most_held = 197;

/// Answers to one question by many seeds.
struct Answers {
  std::vector<Estimate> all;
  core::ScalarMoments values, bounds;

  void add(const Estimate& each) {
    all.push_back(each);
    values.add(each.value[0]), bounds.add(each.error_bound[0]);
  }
  /// By how many intervals a number is held.
  int hold(double number, bool by_noise_alone) const {
    return static_cast<int>(std::ranges::count_if(all, [&](const Estimate& each) {
      return std::abs(each.value[0] - number) <=
             normal_95 * each.standard_error[0] + (by_noise_alone ? 0 : each.error_bound[0]);
    }));
  }
};

std::vector<Answers> answers_of_all_seeds(const scene::Scene& scene, const std::vector<OfSquares>& questions,
                                          double element_size) {
  const Solved solved(scene, element_size, 3);
  montecarlo::TwoPassSettings passes;
  passes.samples = 1000;
  passes.solution = solved.solution;
  std::vector<measure::Measurement> asked;
  for (const OfSquares& question : questions) asked.push_back(question.asked);
  std::vector<Answers> answers(asked.size());
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    core::LocalRun run(seed, 2);
    const auto found = montecarlo::TwoPass(passes).answer(scene, asked, run.get());
    for (std::size_t m = 0; m < asked.size(); ++m) answers[m].add(found[m]);
  }
  return answers;
}

// Noise and bound, each by itself and together.  The noise (here that of samples alone, since form factors are
// computed where nothing mirrors) holds the mean of all seeds as often as 95 % are, not less and not more; that mean
// has a two-hundredth of the variance.  The bound holds how far the mean is from the truth.  Intervals with both hold
// the truth in 181 at least, and may in all.
//
// Nor is the bound of any size.  It is what reflected light varies by inside elements, beside what elements are off by
// in the mean, of second order.  A point gets cos² / r² = 1 / r⁴ of each point of a square that it faces at the
// distance 1, the logarithm of which has a slope of 4 s / (1 + s²) <= 2, s: how far beside it that is.  So has all
// that it gets, and in a square of side a that varies, in the root of the mean square, by 2 a / sqrt(12) of itself at
// most.
TEST(TwoPasses, hold_the_truth_as_often_as_they_say) {
  constexpr double element_size = .15;
  const double varies = 2 * element_size / std::sqrt(12.);
  const scene::Scene scene = test::facing_squares();
  const std::vector<OfSquares> questions = questions_of_squares(scene);
  const std::vector<Answers> answers = answers_of_all_seeds(scene, questions, element_size);
  test::Family family(2 * questions.size());
  for (std::size_t m = 0; m < questions.size(); ++m) {
    const OfSquares& question = questions[m];
    const core::ScalarMoments &values = answers[m].values, &bounds = answers[m].bounds;
    EXPECT_GE(answers[m].hold(values.mean(), true), fewest_held) << question.name;
    EXPECT_LE(answers[m].hold(values.mean(), true), most_held) << question.name;
    EXPECT_GE(answers[m].hold(question.truth[0], false), fewest_held) << question.name;
    EXPECT_LE(std::abs(values.mean() - question.truth[0]), bounds.mean() + family.z() * values.standard_error())
        << question.name;
    EXPECT_LE(bounds.mean(), varies * question.by_solution) << question.name;
  }
}

TEST(TwoPasses, refuse_what_they_do_not_know) {
  scene::SceneBuilder builder = room(1);
  builder.add_box("plastic", {Vec3(1.1, 1.2, .05), Vec3(1.5, 1.5, .4)}, of(builder, scene::Plastic{1.5}));
  const scene::Scene scene = builder.finish();
  core::LocalRun run(1, 1);
  montecarlo::TwoPassSettings passes;
  const auto asked = all_of(scene, 1);
  EXPECT_THROW(montecarlo::TwoPass(passes).answer(scene, asked, run.get()), core::InputError);  // no solution
  static const measure::SurfaceSolution::Known nothing{};
  passes.solution.at = [](const scene::SurfacePoint&) -> const auto& { return nothing; };
  EXPECT_THROW(montecarlo::TwoPass(passes).answer(scene, asked, run.get()), core::InputError);  // plastic
  passes.paths = measure::PathClasses::of("LDE");
  const scene::Scene known = room(1).finish();
  EXPECT_THROW(montecarlo::TwoPass(passes).answer(known, all_of(known, 1), run.get()), core::InputError);
}

}  // namespace
}  // namespace interflect
