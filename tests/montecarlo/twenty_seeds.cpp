#include <gtest/gtest.h>

#include <cmath>
#include <deque>

#include "core/moments.h"
#include "core/student_t.h"
#include "montecarlo/integrators.h"
#include "montecarlo/scene_paths.h"
#include "scene/reader.h"
#include "tests/montecarlo/rooms.h"
#include "tests/montecarlo/solution_rooms.h"

/// Unbiased integrators on what two of them find, over 20 seeds: whatever their own errors are worth, the means of
/// their differences are 0, within what seeds scatter.
namespace interflect::montecarlo {
namespace {

using measure::Measurement;
using measure::PathClasses;

constexpr int seeds = 20;
constexpr double alpha = 1e-3;  ///< of a list of measurements, all pairs together

struct Asked {
  std::string name;
  std::uint64_t samples;  ///< a measurement, or of all together where paths are shared
};

/// How well the means of the differences are known: their standard errors, relative to what is measured.
struct Resolution {
  double of_first;  ///< of what is asked
  double of_every;
};

/// What integrators find of a list of measurements in a scene, seed by seed.
class Runs {
 public:
  using Values = std::vector<std::vector<Spectrum>>;  ///< [seed][measurement]

  Runs(const scene::Scene& scene, const std::vector<Measurement>& asked, double reflected)
      : scene_(scene), asked_(asked), solution_(test::says_everywhere(Spectrum(reflected))) {}

  /// Of the scene's paths those that it finds to all that is asked.
  PathClasses paths_of(const Asked& by) const {
    const measure::Capabilities finds = make_integrator(by.name, {})->capabilities();
    PathClasses paths = paths_in(scene_);
    for (const Measurement& each : asked_) {
      const PathClasses& to = finds.paths_to(each);
      if (!(paths - to).empty()) paths = paths & to;
    }
    return paths;
  }
  /// Once for the same paths, whichever integrators they are compared with.
  const Values& values(const Asked& by, const PathClasses& paths) {
    for (const Known& each : known_) {
      if (each.by == by.name && each.paths == paths) return each.values;
    }
    IntegratorSettings settings;
    settings.paths = paths, settings.samples = by.samples, settings.solution = solution_;
    const auto method = make_integrator(by.name, settings);
    Values& values = known_.emplace_back(by.name, paths).values;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      core::LocalRun run(seed, 2);
      auto& of_seed = values.emplace_back();
      for (const Estimate& each : method->answer(scene_, asked_, run.get())) of_seed.push_back(each.value);
    }
    return values;
  }

 private:
  struct Known {
    Known(std::string name, PathClasses of) : by(std::move(name)), paths(std::move(of)) {}
    std::string by;
    PathClasses paths;
    Values values;
  };

  const scene::Scene& scene_;
  const std::vector<Measurement>& asked_;
  measure::SurfaceSolution solution_;
  std::deque<Known> known_;
};

/// Which of them are held against which.
struct Contest {
  std::vector<Asked> each_with_each, with_the_first;

  std::vector<std::pair<Asked, Asked>> pairs() const {
    std::vector<std::pair<Asked, Asked>> all;
    for (std::size_t a = 0; a < each_with_each.size(); ++a)
      for (std::size_t b = a + 1; b < each_with_each.size(); ++b)
        all.emplace_back(each_with_each[a], each_with_each[b]);
    for (const Asked& other : with_the_first) all.emplace_back(each_with_each.front(), other);
    return all;
  }
};

/// Two of them, seed by seed: the mean of their differences is 0 within what they scatter, and well known beside the
/// mean of both.  That is one number, of all seeds: what a seed found would divide each difference by its own noise.
void expect_no_difference(const Runs::Values& of_a, const Runs::Values& of_b, int channels, double t,
                          const Resolution& resolution) {
  for (std::size_t m = 0; m < of_a.front().size(); ++m)
    for (int c = 0; c < channels; ++c) {
      core::ScalarMoments difference, both;
      for (std::size_t seed = 0; seed < of_a.size(); ++seed) {
        difference.add(of_a[seed][m][c] - of_b[seed][m][c]);
        both.add((of_a[seed][m][c] + of_b[seed][m][c]) / 2);
      }
      const double resolved = m == 0 ? resolution.of_first : resolution.of_every;
      EXPECT_LE(std::abs(difference.mean()), t * difference.standard_error()) << m << ", channel " << c;
      EXPECT_LT(difference.standard_error(), resolved * both.mean()) << m << ", channel " << c;
    }
}

/// @param reflected  rho H of the walls, about, as controlled paths are told: they are unbiased, however wrong that is
void expect_agreement(const scene::Scene& scene, const std::vector<Measurement>& asked, const Contest& contest,
                      const Resolution& resolution, double reflected = .2) {
  const auto pairs = contest.pairs();
  const auto comparisons =
      static_cast<double>(pairs.size() * asked.size() * static_cast<std::size_t>(scene.channel_count()));
  const double t = core::student_t(std::pow(1 - alpha, 1 / comparisons), seeds - 1);
  Runs runs(scene, asked, reflected);
  for (const auto& [a, b] : pairs) {
    SCOPED_TRACE(a.name + " - " + b.name);
    const PathClasses common = runs.paths_of(a) & runs.paths_of(b);
    expect_no_difference(runs.values(a, common), runs.values(b, common), scene.channel_count(), t, resolution);
  }
}

Measurement flux(const scene::Scene& scene, scene::SurfaceId id) {
  return measure::Flux{measure::patches_of(scene, id, scene::Side::front)};
}

/// All fronts together, and each of a few surfaces.
std::vector<Measurement> fluxes(const scene::Scene& scene, std::size_t every) {
  std::vector<Measurement> asked{test::all_fronts(scene)};
  const auto ids = scene.surface_ids();
  for (std::size_t k = 0; k < ids.size(); k += every) asked.push_back(flux(scene, ids[k]));
  return asked;
}
std::vector<Measurement> fluxes(const scene::Scene& scene, const std::vector<std::string>& names) {
  std::vector<Measurement> asked{test::all_fronts(scene)};
  for (const std::string& name : names) asked.push_back(flux(scene, test::surface_named(scene, name)));
  return asked;
}

/// All pixels of one camera.
std::vector<Measurement> pixels(const scene::Scene& scene, scene::CameraId camera) {
  std::vector<Measurement> asked;
  for (int y = 0; y < scene.camera(camera).height; ++y)
    for (int x = 0; x < scene.camera(camera).width; ++x) asked.push_back(measure::PixelRadiance{camera, x, y});
  return asked;
}

std::vector<Measurement> points(const std::vector<std::pair<Vec3, Vec3>>& at) {
  std::vector<Measurement> asked;
  for (const auto& [position, normal] : at) asked.push_back(measure::PointIrradiance{position, normal, {}});
  return asked;
}

std::vector<Measurement> joined(std::vector<Measurement> some, const std::vector<Measurement>& more) {
  some.insert(some.end(), more.begin(), more.end());
  return some;
}

/// With cameras of few pixels in either room: "dark" and "lit".
scene::Scene two_rooms() {
  scene::Scene scene = scene::read_scene(INTERFLECT_SOURCE_DIR "/data/scenes/two_rooms.json");
  for (scene::Camera& camera : scene.cameras) camera.width = 2, camera.height = 2;
  return scene;
}

const Vec3 x = Vec3::UnitX(), z = Vec3::UnitZ();

// Paths as they are, and from lamps, and from both ends; and those that a solution, however wrong, shortens.
TEST(TwentySeeds, of_a_room_with_every_material_and_small_lamps) {
  const scene::Scene scene = test::shiny();
  const Contest all{{{"path", 4000}, {"bidirectional", 1500}, {"light", 20000}}, {{"controlled", 4000}}};
  expect_agreement(scene, fluxes(scene, 5), all, {.02, .1});
}

TEST(TwentySeeds, of_points_and_pixels_of_that_room) {
  const scene::Scene scene = test::shiny();
  const Contest all{{{"path", 2000}, {"bidirectional", 700}, {"light", 20000}}, {{"controlled", 2000}}};
  const auto at = points({{Vec3(.3, 1, .4), Vec3(.6, 0, .8)}, {Vec3(1.7, .5, .5), z}, {Vec3(2.7, 1, .3), -x}});
  expect_agreement(scene, joined(at, pixels(scene, {0})), all, {.2, .2});
}

// Trees of rays find what is seen of surfaces that the lamps light at once.
TEST(TwentySeeds, of_trees_of_rays_in_that_room) {
  const scene::Scene scene = test::shiny();
  const Contest both{{{"path", 3000}}, {{"distributed", 3000}}};
  expect_agreement(scene, pixels(scene, {0}), both, {.1, .1});
}

TEST(TwentySeeds, of_every_kind_of_light) {
  const scene::Scene scene = test::lit_by_all();
  const Contest all{{{"path", 8000}, {"bidirectional", 4000}, {"light", 80000}},
                    {{"controlled", 8000}, {"distributed", 8000}}};
  expect_agreement(scene, test::all_of_lit(scene), all, {.01, .05});
}

TEST(TwentySeeds, of_two_rooms_with_a_door_ajar) {
  const scene::Scene scene = two_rooms();
  const double reflected = 50;
  const Contest all{{{"path", 8000}, {"bidirectional", 4000}, {"light", 80000}}, {{"controlled", 4000}}};
  expect_agreement(scene, fluxes(scene, 4), all, {.005, .1}, reflected);
  const auto at = points({{Vec3(2, 1, .8), z}, {Vec3(5.5, 2, .1), z}, {Vec3(6, .5, .8), -x}});
  expect_agreement(scene, joined(joined(at, pixels(scene, {0})), pixels(scene, {1})), all, {.1, .1}, reflected);
}

// And what the lamp sends to surfaces and points at once, where that is something.
TEST(TwentySeeds, of_trees_of_rays_in_these_rooms) {
  const scene::Scene scene = two_rooms();
  const Contest both{{{"path", 4000}}, {{"distributed", 4000}}};
  const auto lit = fluxes(scene, {"lit/floor", "lit/wall_west", "leaf/lit_side", "dark/floor", "dark/wall_east"});
  const auto at = points({{Vec3(2, 1, .8), z}, {Vec3(5.5, 2, .1), z}});
  expect_agreement(scene, joined(lit, at), both, {.01, .1});
  expect_agreement(scene, pixels(scene, {1}), both, {.1, .1});
}

}  // namespace
}  // namespace interflect::montecarlo
