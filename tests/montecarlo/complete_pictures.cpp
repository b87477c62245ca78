#include <gtest/gtest.h>

#include "montecarlo/render.h"
#include "tests/montecarlo/rooms.h"

// Whether a picture has all that was asked for, whenever a stop comes.
namespace interflect::montecarlo {
namespace {

/// Stopped when its state is kept for the nth time.
Rendering stopped_at(int nth, const RenderSettings& settings) {
  const scene::Scene scene = test::floor_below_a_sky();
  std::stop_source source;
  core::LocalRun run(1, 1);
  run.get().stop = source.get_token();
  RenderCheckpoints checkpoints;
  checkpoints.seconds_between = nth == 0 ? 1e9 : 0, checkpoints.at_end = true;
  int kept = 0;
  checkpoints.keep = [&](const FilmState&) {
    if (++kept >= nth) source.request_stop();
  };
  return render(scene, {0}, settings, run, *raycast::make_ray_caster("embree", scene), checkpoints);
}

RenderSettings settings_of(std::uint64_t samples, double target) {
  RenderSettings settings;
  settings.samples = samples, settings.target = target;
  return settings;
}

TEST(CompletePictures, are_told_by_what_they_have_and_not_by_a_stop_that_came_too_late) {
  const Rendering late = stopped_at(0, settings_of(100, 0));  // its last act is to keep its state
  EXPECT_EQ(late.samples, 100u);
  EXPECT_TRUE(late.complete);
  const Rendering early = stopped_at(2, settings_of(1'000'000, 0));
  EXPECT_LT(early.samples, 1'000'000u);
  EXPECT_FALSE(early.complete);
}

TEST(CompletePictures, are_those_too_that_are_as_good_as_was_asked_for) {
  const Rendering good = stopped_at(0, settings_of(1'000'000, .5));
  EXPECT_LT(good.samples, 1'000'000u);
  EXPECT_TRUE(good.complete);
}

}  // namespace
}  // namespace interflect::montecarlo
