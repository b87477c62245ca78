#include <gtest/gtest.h>

#include "core/error.h"
#include "montecarlo/film/splat_film.h"
#include "tests/montecarlo/statistics.h"
#include "tests/support/shapes.h"

namespace interflect::montecarlo {
namespace {

scene::Scene two_channels() {
  scene::SceneBuilder builder({"r", "g"});
  builder.add_polygon("floor", {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {}},
                      builder.add_material(test::diffuse("lamp", 0, 1)));
  return builder.finish();
}

Spectrum both(double r, double g) {
  Spectrum s;
  s[0] = r, s[1] = g;
  return s;
}

/// Up to three deposits of any size, some of them on top of each other, some beside the picture.
void scatter(std::uint64_t path, SplatFilm::Deposits& deposits) {
  core::RandomNumbers numbers(5, 0, path);
  const int count = static_cast<int>(4 * numbers.next());
  Vec2 at;
  for (int k = 0; k < count; ++k) {
    if (k == 0 || numbers.next() < 0.7) at = {24 * numbers.next() - 2, 14 * numbers.next() - 2};
    const double r = numbers.next();
    deposits.add(at, both(r, r * numbers.next()));
  }
}

void expect_same(const SplatFilm& a, const SplatFilm& b) {
  ASSERT_EQ(a.paths(), b.paths());
  EXPECT_EQ(a.state(), b.state());
}

TEST(SplatFilm, gives_the_same_bits_for_any_number_of_threads_and_any_cuts) {
  const scene::Scene scene = two_channels();
  const auto filter = make_filter("mitchell");
  SplatFilm whole(scene, 20, 10, *filter);
  core::LocalRun one(1, 1);
  whole.expose(30'000, one, scatter);
  for (unsigned threads : {2u, 7u}) {
    core::LocalRun run(1, threads);
    SplatFilm cut(scene, 20, 10, *filter);
    for (std::uint64_t end : {1u, 17u, 8192u, 9001u, 30'000u}) cut.expose(end, run, scatter);
    expect_same(cut, whole);
    SplatFilm before(scene, 20, 10, *filter), gone_on(scene, 20, 10, *filter);
    before.expose(12'345, run, scatter);
    gone_on.restore(before.state(), before.paths());
    gone_on.expose(30'000, run, scatter);
    expect_same(gone_on, whole);
  }
}

// A path leaves x (uniform, mean 1/2, variance 1/12) in a pixel with probability 1/10, in two halves that are one
// sample: mean 1/20, variance of a sample (1/3) / 10 - 1/400.
TEST(SplatFilm, counts_a_path_as_one_sample_and_paths_that_leave_nothing_too) {
  const scene::Scene scene = two_channels();
  const auto filter = make_filter("box");
  SplatFilm film(scene, 3, 2, *filter);
  core::LocalRun run;
  constexpr std::uint64_t paths = 100'000;
  film.expose(paths, run, [](std::uint64_t path, SplatFilm::Deposits& deposits) {
    core::RandomNumbers numbers(6, 0, path);
    if (numbers.next() >= 0.1) return;
    const double x = numbers.next();
    deposits.add({1.3, 0.2}, both(x / 2, x));
    deposits.add({1.9, 0.9}, both(x / 2, x));
  });
  const Estimate pixel = film.estimate(1, 0, both(1, 1));
  EXPECT_EQ(pixel.samples, paths);
  const double se = std::sqrt((1.0 / 30 - 1.0 / 400) / paths);
  EXPECT_NEAR(pixel.standard_error[0] / se, 1, 0.03);
  EXPECT_NEAR(pixel.standard_error[1] / se, 2, 0.06);
  EXPECT_LT(std::abs(pixel.value[0] - 0.05) / se, test::critical_z(test::alpha, 1));
  EXPECT_NEAR(pixel.weighed_standard_error, scene.weigh(pixel.standard_error), 1e-12);  // the channels are in step
  // Where nothing fell: the rule of three.
  const Estimate dark = film.estimate(0, 1, both(1, 1));
  EXPECT_EQ(dark.value[0], 0);
  EXPECT_DOUBLE_EQ(dark.standard_error[0], 3.0 / paths);
}

// What falls on the film is shared out by h of all pixels within reach: sums over the picture are sums over deposits
// where pixels' filters add up to 1.
TEST(SplatFilm, shares_a_deposit_out_by_the_filter) {
  const scene::Scene scene = two_channels();
  core::LocalRun run;
  for (const char* name : {"box", "triangle", "mitchell"}) {
    const auto filter = make_filter(name);
    SplatFilm film(scene, 9, 8, *filter);
    film.expose(1, run, [](std::uint64_t, SplatFilm::Deposits& deposits) { deposits.add({4.3, 3.8}, both(2, 3)); });
    Spectrum sum;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 9; ++x) {
        const Estimate pixel = film.estimate(x, y, Spectrum::zero());
        EXPECT_DOUBLE_EQ(pixel.value[0], 2 * filter->value(Vec2(4.3 - x - 0.5, 3.8 - y - 0.5))) << name;
        sum += pixel.value;
      }
    EXPECT_NEAR(sum[0], 2, 1e-14) << name;
    EXPECT_NEAR(sum[1], 3, 1e-14) << name;
  }
}

TEST(SplatFilm, stops_after_whole_paths_and_refuses_what_is_no_state) {
  const scene::Scene scene = two_channels();
  const auto filter = make_filter("box");
  SplatFilm film(scene, 4, 4, *filter);
  std::stop_source source;
  core::LocalRun run(1, 2);
  run.get().stop = source.get_token();
  film.expose(1'000'000, run, [&](std::uint64_t path, SplatFilm::Deposits& deposits) {
    if (path == 20'000) source.request_stop();
    deposits.add({0.5, 0.5}, both(1, 1));
  });
  EXPECT_GT(film.paths(), 20'000u);
  EXPECT_LT(film.paths(), 60'000u);
  EXPECT_DOUBLE_EQ(film.estimate(0, 0, Spectrum(1)).value[0], 1);
  FilmState state = film.state();
  EXPECT_THROW(film.restore(state.topRows(3), film.paths()), core::InputError);
  EXPECT_THROW(film.restore(state, 7), core::InputError);  // more scored than there were
  state(0, 0) = 0.5;
  EXPECT_THROW(film.restore(state, film.paths()), core::InputError);
}

}  // namespace
}  // namespace interflect::montecarlo
