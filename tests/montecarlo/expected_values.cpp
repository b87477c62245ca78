#include <array>
#include <cmath>

#include "montecarlo/bidirectional/bidirectional_tracer.h"
#include "montecarlo/roulette.h"
#include "tests/montecarlo/rooms.h"
#include "tests/montecarlo/statistics.h"

// What expected values are worth, and that next-event estimation is no such thing: mean and variance, as they are by
// theory, of the direct light of a unit square lamp at a point h above its middle, through a net that lets the part t
// pass.
//
// What is scored in the mean has the mean of what is scored by chance, and no more variance [Rao 1945; Blackwell 1947]:
//
//   Var X = Var E[X | Y] + E Var[X | Y].
//
// So it is with what a net lets pass.  A point y of the lamp, drawn with the density p, scores g / p, where g is the
// density of places that cosine-distributed rays hit.  Only if that is 1 at most, for every y, is it the chance of a
// hit, and next-event estimation E[hit | y]: far from the lamp.  Beside it the score has more variance than hits have,
// and the balance heuristic of both, g / (g + p) [Veach and Guibas 1995], less than either.
namespace interflect::montecarlo {
namespace {

/// Mean, variance and fourth central moment of a score.
struct Moments {
  double mean, variance, fourth;
};

/// Of the sum of two that are independent.
Moments operator+(const Moments& a, const Moments& b) {
  return {a.mean + b.mean, a.variance + b.variance, a.fourth + 6 * a.variance * b.variance + b.fourth};
}

/// The lamp as a point sees it, of E = 1.
struct Lamp {
  double h;  ///< of the point above its middle

  /// Densities at a place of the lamp, by area: of hits, and of the points that are drawn (docs/lights.md).
  struct Densities {
    double hits, drawn;
  };
  Densities at(double u, double v) const {
    const double square = u * u + v * v + h * h, omega = h / std::pow(square, 1.5);
    const bool near = h < std::sqrt(2.) / 2;  // half its diameter
    return {h * h * inv_pi / (square * square), near ? omega / solid_angle() : 1};
  }
  double solid_angle() const { return 4 * std::asin(1 / (1 + 4 * h * h)); }
  /// All hits, F: docs/truths.md, V1 at h = 1.
  double form_factor() const {
    const double k = 1 / std::sqrt(1 + 4 * h * h);
    return 4 * inv_pi * k * std::atan(k);
  }

  /// Of a score at places of that density, 0 elsewhere, by midpoints over the lamp: their error is what slopes are at
  /// its edge, over 24 x 400², 4e-7 of the mean at h = .1.
  template <class Density, class Score>
  Moments moments(const Density& density, const Score& score) const {
    constexpr int n = 400;
    std::array<double, 5> power{};
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const Densities here = at((i + .5) / n - .5, (j + .5) / n - .5);
        double term = density(here) / (n * n);
        for (std::size_t k = 1; k < power.size(); ++k) power[k] += term *= score(here);
      }
    const double m = power[1], m2 = m * m;
    return {m, power[2] - m2, power[4] - 4 * m * power[3] + 6 * m2 * power[2] - 3 * m2 * m2};
  }
};

double drawn_points(const Lamp::Densities& here) { return here.drawn; }

/// Of a ray that goes on from the point, and again from the net: roulette ends one in a thousand each time.
const double survives = going_on(1) * going_on(1);

/// A ray of cosine distribution that passes the net by chance, and then finds the lamp or not.
Moments by_hits(const Lamp& lamp, double t) {
  return lamp.moments([t](const Lamp::Densities& here) { return survives * t * here.hits; },
                      [](const Lamp::Densities&) { return 1 / survives; });
}

/// A point drawn on the lamp, at which what the net lets pass is scored in the mean.
Moments by_points(const Lamp& lamp, double t) {
  return lamp.moments(drawn_points, [t](const Lamp::Densities& here) { return t * here.hits / here.drawn; });
}
/// The same where chance says whether the net lets it pass.
Moments by_points_that_pass(const Lamp& lamp, double t) {
  return lamp.moments([t](const Lamp::Densities& here) { return t * here.drawn; },
                      [](const Lamp::Densities& here) { return here.hits / here.drawn; });
}

/// A ray and a point, by the balance heuristic.
Moments by_both(const Lamp& lamp) {
  const auto weighed = [](const Lamp::Densities& here) { return here.hits / (here.hits + here.drawn); };
  return lamp.moments([](const Lamp::Densities& here) { return survives * here.hits; },
                      [&](const Lamp::Densities& here) { return weighed(here) / survives; }) +
         lamp.moments(drawn_points, weighed);
}

scene::Scene lamp_behind_a_net(double h, double t) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();
  scene::SceneBuilder builder({"grey"});
  scene::Material net = test::diffuse("net", 0, 0, scene::Sides::both);
  net.opacity = 1 - t;
  builder.add_polygon("lamp", test::parallelogram(Vec3::Zero(), x, y),
                      builder.add_material(test::diffuse("lamp", 0, 1)));
  builder.add_polygon("net", test::parallelogram(Vec3(-5, -5, h / 2), 11 * x, 11 * y), builder.add_material(net));
  return builder.finish();
}

constexpr std::uint64_t samples = 200'000;
constexpr std::size_t tails_of_scores = 4;

/// Mean and variance of single samples.  The variance of a sample variance is (mu_4 - sigma⁴) / n.
void expect_scores(const measure::Method& method, double h, double t, const Moments& truth, test::Family& family) {
  const measure::Measurement point = measure::PointIrradiance{Vec3(.5, .5, h), -Vec3::UnitZ(), {}};
  const scene::Scene scene = lamp_behind_a_net(h, t);
  core::LocalRun run(5, 2);
  const Estimate found = method.answer(scene, {&point, 1}, run.get())[0];
  const double n = samples, variance = n * found.standard_error[0] * found.standard_error[0];
  EXPECT_NEAR(found.value[0], truth.mean, family.z() * std::sqrt(truth.variance / n)) << h << ", " << t;
  EXPECT_NEAR(variance, truth.variance, family.z() * std::sqrt((truth.fourth - truth.variance * truth.variance) / n))
      << h << ", " << t;
}

BidirectionalTracer only(BidirectionalStrategy strategy) {
  return BidirectionalTracer({.samples = samples, .only = strategy});
}
const BidirectionalStrategy hit{0, 2}, drawn{1, 1};

TEST(ExpectedValues, of_nets_have_the_mean_of_chance_and_less_variance) {
  test::Family family(2 * 2 * tails_of_scores);
  constexpr double t = .6;
  for (const double h : {1., .1}) {
    const Moments mean = by_points({h}, t), chance = by_points_that_pass({h}, t);
    EXPECT_NEAR(mean.mean, chance.mean, 1e-12);
    EXPECT_LT(mean.variance, t * chance.variance);
    expect_scores(only(drawn), h, t, mean, family);
    expect_scores(only(hit), h, t, by_hits({h}, t), family);
  }
}

TEST(NextEventEstimation, has_less_variance_than_hits_far_from_a_lamp_and_more_beside_it) {
  test::Family family(3 * 3 * tails_of_scores);
  for (const double h : {1., .2, .1}) {
    const Moments hits = by_hits({h}, 1), points = by_points({h}, 1), both = by_both({h});
    for (const Moments& each : {hits, points, both}) EXPECT_NEAR(each.mean, Lamp{h}.form_factor(), 1e-6);
    if (h == 1) {
      EXPECT_GT(hits.variance, 90 * points.variance);
    } else if (h == .1) {
      EXPECT_LT(4 * hits.variance, points.variance);
    }
    EXPECT_LT(both.variance, hits.variance);
    if (h < 1) {
      EXPECT_LT(both.variance, points.variance);
    }
    expect_scores(only(hit), h, 1, hits, family);
    expect_scores(only(drawn), h, 1, points, family);
    expect_scores(PathTracer({.samples = samples}), h, 1, both, family);
  }
}

}  // namespace
}  // namespace interflect::montecarlo
