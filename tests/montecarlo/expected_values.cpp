#include <array>
#include <cmath>

#include "montecarlo/bidirectional/bidirectional_tracer.h"
#include "tests/montecarlo/rooms.h"
#include "tests/montecarlo/statistics.h"

// What is scored in the mean has the same mean as what is scored by chance, and less variance [Rao 1945; Blackwell
// 1947]:
//
//   Var X = Var E[X | Y] + E Var[X | Y],
//
// here of the direct light of a square lamp at a point, through a net that lets the part t pass.
namespace interflect::montecarlo {
namespace {

/// Mean, variance and fourth central moment of a score.
struct Moments {
  double mean, variance, fourth;
};

/// A ray of cosine distribution that passes the net by chance, and then finds the lamp or not: E = 1 with p = t F.
Moments by_chance(double F, double t) {
  const double p = t * F, variance = p * (1 - p);
  return {p, variance, variance * (1 - 3 * variance)};
}

/// A point on the lamp drawn by area, at which what the net lets pass in the mean is scored, and the share of all rays
/// that the place takes: t g, g = A cos² / (pi r²), by midpoints over the lamp, a unit square at distance 1 whose
/// middle is above the point.  The first of them is t F again.
Moments in_the_mean(double t) {
  constexpr int n = 400;
  std::array<double, 5> power{};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double u = (i + .5) / n - .5, v = (j + .5) / n - .5, square = 1 + u * u + v * v;
      const double score = t * inv_pi / (square * square);
      for (std::size_t k = 1; k < power.size(); ++k) power[k] += std::pow(score, static_cast<double>(k)) / (n * n);
    }
  const double m = power[1];
  return {m, power[2] - m * m, power[4] - 4 * m * power[3] + 6 * m * m * power[2] - 3 * m * m * m * m};
}

/// The two squares that face each other (rooms.h), with a net in between.
scene::Scene lamp_behind_a_net(double t) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();
  scene::SceneBuilder builder({"grey"});
  scene::Material net = test::diffuse("net", 0, 0, scene::Sides::both);
  net.opacity = 1 - t;
  builder.add_polygon("lamp", test::parallelogram(Vec3::Zero(), x, y),
                      builder.add_material(test::diffuse("lamp", 0, 1)));
  builder.add_polygon("net", test::parallelogram(Vec3(-5, -5, .5), 11 * x, 11 * y), builder.add_material(net));
  return builder.finish();
}

// Mean and variance of both as they are by theory, which is that one takes 90 times the samples of the other, or more
// where there is chance in the net, too.  The variance of a sample variance is (mu_4 - sigma⁴) / n.
TEST(ExpectedValues, have_the_mean_of_chance_hits_and_the_variance_that_theory_gives) {
  constexpr double n = 200'000, F = .2394564705;  // docs/truths.md, V1
  const double limit = test::critical_z(test::alpha, 8);
  for (const double t : {1., .6}) {
    const scene::Scene scene = lamp_behind_a_net(t);
    const measure::Measurement point = measure::PointIrradiance{Vec3(.5, .5, 1), -Vec3::UnitZ(), {}};
    const Moments hits = by_chance(F, t), mean = in_the_mean(t);
    EXPECT_NEAR(mean.mean, hits.mean, 1e-6);
    EXPECT_GT(hits.variance, 90 / t * mean.variance);
    for (const auto& [strategy, truth] : {std::pair(BidirectionalStrategy{0, 2}, hits), {{1, 1}, mean}}) {
      core::LocalRun run(5, 2);
      const Estimate found = BidirectionalTracer({.samples = static_cast<std::uint64_t>(n), .only = strategy})
                                 .answer(scene, {&point, 1}, run.get())[0];
      const double variance = n * found.standard_error[0] * found.standard_error[0];
      EXPECT_NEAR(found.value[0], truth.mean, limit * std::sqrt(truth.variance / n))
          << t << ": " << strategy.from_light;
      EXPECT_NEAR(variance, truth.variance, limit * std::sqrt((truth.fourth - truth.variance * truth.variance) / n))
          << t << ": " << strategy.from_light;
    }
  }
}

}  // namespace
}  // namespace interflect::montecarlo
