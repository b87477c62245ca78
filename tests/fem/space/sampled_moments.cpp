#include "fem/form_factor/sampled_moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "core/error.h"
#include "fem/assembly.h"
#include "fem/radiosity_method.h"
#include "tests/fem/rooms.h"

// Polynomials whose visibility is sampled.
namespace interflect::fem {
namespace {

using test::Room;

/// Entries and their standard errors.
struct Sampled final : ExchangeSink {
  explicit Sampled(std::size_t n) : K(Eigen::MatrixXd::Zero(Index(n), Index(n))), errors(K) {}
  void add(Index a, Index b, const ExchangeEntry& entry) override {
    K(a, b) = K(b, a) = entry.K;
    errors(a, b) = errors(b, a) = entry.standard_error;
  }
  Eigen::MatrixXd K, errors;
};

/// A room with a body in it, unequal walls.
scene::Scene furnished(std::vector<scene::SurfacePatch>& patches) {
  Room room;
  room.box({0, 0, 0}, {2, 3, 1.2}, 1, true, .6);
  room.wall({.5, .5, 1.1}, {0, .5, 0}, {.5, 0, 0}, 1, 0, 5);
  room.box({.7, .6, .3}, {.5, .8, .4}, 1, false, .3);
  patches = room.patches;
  return room.finish();
}

Eigen::MatrixXd assembled(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches,
                          const std::string& method, int order, int rays, std::uint64_t seed,
                          Eigen::MatrixXd* errors = nullptr) {
  const auto caster = raycast::make_ray_caster("embree", scene);
  FormFactorContext context{scene, patches, *caster, seed, 1e-5, rays};
  context.order = order;
  Sampled sink(patches.size() * std::size_t(plane_functions(order)));
  core::LocalRun run(1, 2);
  assemble(*make_form_factor_method(method, context), patches, sink, run.get());
  if (errors != nullptr) *errors = sink.errors;
  return sink.K;
}

// The mean over seeds is the exact block, up to the 1/n of a ratio; standard errors are those that are stated, or less.
TEST(SampledMoments, are_right_in_the_mean) {
  std::vector<scene::SurfacePatch> patches;
  const scene::Scene scene = furnished(patches);
  constexpr int rays = 64;
  for (const auto& [order, seeds] : {std::pair(1, 60), std::pair(2, 30)}) {
    const Eigen::MatrixXd exact = assembled(scene, patches, "analytic", order, rays, 1);
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(exact.rows(), exact.cols()), squares = sum, stated = sum;
    for (int seed = 0; seed < seeds; ++seed) {
      Eigen::MatrixXd errors;
      const Eigen::MatrixXd K =
          assembled(scene, patches, "gauss-lambert", order, rays, std::uint64_t(seed) + 1, &errors) - exact;
      sum += K;
      squares += K.cwiseAbs2();
      stated += errors.cwiseAbs2();
    }
    const Index f = plane_functions(order);
    // two-sided normal tests of all entries, alpha 1e-4 together
    const double z = order == 1 ? 6.5 : 7.5;  // and of a variance from so many values
    double found = 0, said = 0;
    for (Index a = 0; a < exact.rows(); ++a)
      for (Index b = 0; b < exact.cols(); ++b) {
        const double K_00 = exact(a / f * f, b / f * f), mean = sum(a, b) / seeds;
        const double variance = squares(a, b) / seeds - mean * mean;
        EXPECT_LT(std::abs(mean), z * std::sqrt(variance / seeds) + K_00 / rays + 1e-5)
            << order << ' ' << a << ' ' << b;
        if (stated(a, b) == 0) continue;
        found += squares(a, b);
        said += stated(a, b);
      }
    EXPECT_LT(found, said) << order;
    EXPECT_GT(found, .1 * said) << order;
  }
}

// Where rays are not needed nothing is sampled, and constants are those of constants.
TEST(SampledMoments, have_what_constants_and_closed_forms_have) {
  std::vector<scene::SurfacePatch> patches;
  const scene::Scene scene = furnished(patches);
  Eigen::MatrixXd errors;
  const Eigen::MatrixXd exact = assembled(scene, patches, "analytic", 2, 16, 1),
                        sampled = assembled(scene, patches, "gauss-lambert", 2, 16, 1, &errors),
                        constants = assembled(scene, patches, "gauss-lambert", 0, 16, 1);
  int clear = 0, doubtful = 0;
  for (Index i = 0; i < constants.rows(); ++i)
    for (Index j = 0; j < constants.cols(); ++j) {
      EXPECT_NEAR(sampled(6 * i, 6 * j), constants(i, j), 2e-5);
      const bool by_rays = errors(6 * i, 6 * j) > 0;
      (by_rays ? doubtful : clear) += constants(i, j) > 0;
      if (by_rays) continue;
      EXPECT_EQ((sampled.block(6 * i, 6 * j, 6, 6) - exact.block(6 * i, 6 * j, 6, 6)).norm(), 0);
    }
  EXPECT_GT(clear, 50);
  EXPECT_GT(doubtful, 20);
}

// The solution is that of exact visibility within its noise, which grows with what is sampled.
TEST(SampledMoments, solve_within_their_noise) {
  std::vector<scene::SurfacePatch> patches;
  const scene::Scene scene = furnished(patches);
  RadiositySettings settings;
  settings.order = 1;
  settings.element_size = 1.1;
  settings.form_factors = "analytic";
  settings.quadrature_tolerance = 1e-4;
  core::LocalRun run(1, 2);
  const RadiositySolution exact = solve_radiosity(scene, settings, run.get());
  settings.form_factors = "gauss-lambert";
  const auto rays = raycast::make_ray_caster("embree", scene);
  std::vector<measure::Measurement> points;
  for (const std::size_t i : {std::size_t{0}, patches.size() / 2}) {
    const scene::SurfacePatch& patch = exact.mesh.patches()[i];
    points.emplace_back(measure::PointIrradiance{patch.centroid(), patch.normal(), patch.surface});
  }
  const std::vector<Estimate> exact_points = RadiosityMethod(exact, *rays).answer(scene, points, run.get());
  double squares = 0, count = 0, far_off = 0, squares_at_points = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    core::LocalRun seeded(seed, 2);
    const RadiositySolution s = solve_radiosity(scene, settings, seeded.get());
    const std::vector<Estimate> at_points = RadiosityMethod(s, *rays).answer(scene, points, seeded.get());
    for (std::size_t p = 0; p < points.size(); ++p) {
      ASSERT_GT(at_points[p].standard_error[0], 0) << "its noise is that of what it gathers";
      const double z = (at_points[p].value[0] - exact_points[p].value[0]) / at_points[p].standard_error[0];
      squares_at_points += z * z / (40.0 * static_cast<double>(points.size()));
    }
    for (std::size_t i = 0; i < s.irradiance.size(); ++i) {
      EXPECT_GT(s.irradiance_noise[i][0], 0);
      const double z = (s.irradiance[i][0] - exact.irradiance[i][0]) / s.irradiance_noise[i][0];
      far_off += std::abs(z) > 4;
      squares += z * z;
      ++count;
    }
  }
  EXPECT_LT(far_off, .002 * count);
  EXPECT_LT(squares / count, 1);
  EXPECT_GT(squares / count, .1);
  EXPECT_LT(squares_at_points, 1.5);  // of 80, few of which are independent
  EXPECT_GT(squares_at_points, .02);
}

TEST(SampledMoments, make_no_elements_for_a_goal) {
  RadiositySettings settings;
  settings.order = 1;
  settings.form_factors = "gauss-lambert";
  settings.adaptive = AdaptiveSettings{{"nothing", Goal::AtPoints{}}};
  EXPECT_THROW(require_compatible(settings), core::InputError);
}

}  // namespace
}  // namespace interflect::fem
