#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/fresnel.h"
#include "montecarlo/bsdf/rough_conductor.h"
#include "montecarlo/bsdf/rough_dielectric.h"
#include "tests/montecarlo/bsdf_means.h"
#include "tests/support/family.h"

// Facets (GGX), and the metal and the glass that are made of them.
namespace interflect::montecarlo {
namespace {

using test::at;
using test::degrees;
using test::flux_to;
using test::mean_over_draws;
using test::mean_over_numbers;
using test::three_numbers;

// What facets that reflect everything reflect once [by quadrature on two grids that agree within 1e-11].
TEST(RoughConductor, reflects_once_what_is_known) {
  const double cosines[] = {1, .9, .7, .5, .3, .1};
  const struct {
    double alpha, albedo[6];
  } known[] = {{.05, {.997295868, .996949779, .995739546, .992715569, .981677689, .911346937}},
               {.1, {.988304057, .986743609, .981418596, .969204984, .936251762, .883455002}},
               {.2, {.947657779, .941507570, .923607489, .895234515, .861633435, .891265662}},
               {.3, {.877358416, .867498062, .844530731, .821711003, .818123302, .888803659}},
               {.5, {.687848515, .683961454, .682953233 + 1e-6, .698250697, .745271984, .860105073}},
               {.7, {.503717452, .513624977, .542639996, .589900895, .669238414, .820917388}},
               {1, {.306852819, .327507038, .378887763, .450693856, .560098879, .760210473}}};
  for (const auto& [alpha, of] : known) {
    const RoughConductor metal(alpha, MetalFresnel(Spectrum(1)), RoughConductor::Scattering::single);
    for (std::size_t k = 0; k < 6; ++k) {
      const double drawn = mean_over_draws(
          metal, at(cosines[k]), Walk::from_light, [](const Vec3&, double weight) { return weight; }, 1, 400);
      EXPECT_NEAR(drawn, of[k], 3e-5) << alpha << " " << cosines[k];
      if (alpha >= .3) {
        EXPECT_NEAR(flux_to(metal, at(cosines[k]), 1), of[k], 1e-4) << alpha << " " << cosines[k];
      }
    }
  }
}

TEST(Ggx, has_known_values) {
  const Ggx facets(.5);
  EXPECT_NEAR(facets.density(at(degrees(30))), .415751688077, 1e-12);
  EXPECT_NEAR(facets.visible(at(degrees(60))), .861001748086, 1e-12);
}

TEST(Ggx, draws_normals_there_and_back) {
  for (const double alpha : {.01, .2, 1.})
    for (const double cosine : {1., .7, .1, 1e-3}) {
      const Ggx facets(alpha);
      const Vec3 v = at(cosine, 2);
      for (std::uint64_t k = 0; k < 20'000; ++k) {
        const Vec3 u = three_numbers(8, k);
        const Vec2 back = facets.inverse(v, facets.sample(v, u[0], u[1]));
        ASSERT_NEAR(back.x(), u[0], 1e-12) << alpha << " " << cosine;
        ASSERT_NEAR(back.y(), u[1], 1e-12) << alpha << " " << cosine;
      }
    }
}

// In cells of m, h = (alpha m.x, alpha m.y, m.z) / |...|, which are uniform by solid angle: there are as many where
// facets are.  Solid angles of what parts of them become are exact.
TEST(Ggx, draws_normals_as_it_says) {
  constexpr int n = 200'000, side = 16, fine = 16;
  const std::array alphas{.05, .3, 1.};
  const std::array cosines{1., .7, .2, .03};
  test::Family family(test::tails_of_counts * alphas.size() * cosines.size());
  std::uint32_t stream = 100;
  for (const double alpha : alphas)
    for (const double cosine : cosines) {
      const Ggx facets(alpha);
      const Vec3 v = at(cosine, 2);
      const auto cosine_of_h = [&](double m) { return m / std::hypot(m, alpha * std::sqrt(1 - m * m)); };
      std::vector<double> expected(side * side), counts(side * side);
      for (int a = 0; a < side * fine; ++a)
        for (int b = 0; b < side * fine; ++b) {
          const double from = double(a) / (side * fine), to = double(a + 1) / (side * fine);
          const double solid_angle = (cosine_of_h(to) - cosine_of_h(from)) * 2 * pi / (side * fine);
          const Vec3 h = at(cosine_of_h((from + to) / 2), 2 * pi * (b + .5) / (side * fine));
          expected[static_cast<std::size_t>(a / fine * side + b / fine)] +=
              n * facets.pdf_solid_angle(v, h) * solid_angle;
        }
      ++stream;
      for (std::uint64_t k = 0; k < n; ++k) {
        const Vec3 u = three_numbers(stream, k), h = facets.sample(v, u[0], u[1]);
        const double m = alpha * h.z() / std::hypot(h.x(), h.y(), alpha * h.z());
        const int a = std::min(side - 1, static_cast<int>(m * side)),
                  b = std::min(side - 1, static_cast<int>(core::turns_about_z(h) * side));
        ++counts[static_cast<std::size_t>(a * side + b)];
      }
      test::expect_as_expected(counts, expected, family, std::to_string(alpha) + " at " + std::to_string(cosine));
    }
}

/// Points of 0 .. 1 and their weights, close together at both ends: t = s³ (10 - 15 s + 6 s²) of midpoints s, whose
/// first and second derivatives are 0 there.
struct Points {
  std::vector<double> at, weight;
  explicit Points(int n) {
    for (int k = 0; k < n; ++k) {
      const double s = (k + .5) / n;
      at.push_back(s * s * s * (10 - 15 * s + 6 * s * s));
      weight.push_back(30 * s * s * (1 - s) * (1 - s) / n);
    }
  }
};

// Facets that reflect everything, and whose reflected light nothing stops, lose nothing of what they are seen by (the
// weak white furnace) [Heitz 2014, eq. 75]:
//
//   int D(h) G1(i) / (4 cos_i) d sigma_o = 1,   h halfway between i and o
//
// over all o of facets that face upwards, o.z > -i.z.  The rule is of the fourth order: with 500 x 400 points it is off
// by 1e-8 at the sharpest, alpha = 0.05 and i.z = 0.03, and with twice as many of each by 6e-10.
TEST(Ggx, shows_all_of_what_is_seen) {
  const Points heights(500), turns(400);
  for (const double alpha : {.05, .1, .3, .6, 1.}) {
    const Ggx facets(alpha);
    for (const double cosine : {1., .9, .6, .3, .1, .03}) {
      const Vec3 i = at(cosine);
      double sum = 0;
      for (std::size_t a = 0; a < heights.at.size(); ++a)
        for (std::size_t b = 0; b < turns.at.size(); ++b) {
          const Vec3 o = at(1 - (1 + cosine) * heights.at[a], pi * turns.at[b]);  // and its mirror image
          sum += heights.weight[a] * turns.weight[b] * facets.density((i + o).normalized());
        }
      const double all = sum * (1 + cosine) * 2 * pi;
      EXPECT_NEAR(all * facets.visible(i) / (4 * cosine), 1, 2e-8) << alpha << " " << cosine;
    }
  }
}

// Reflected and transmitted flux of light that facets scatter once, from air and from glass.
TEST(RoughDielectric, scatters_once_what_is_known) {
  const double cosines[] = {1, .7, .3};
  const struct {
    double alpha;
    bool from_glass;
    double reflected[3], transmitted[3], tolerance;
  } known[] = {{.1, false, {.039637, .051412, .170239}, {.959198, .945291, .805132}, 3e-6},
               {.3, false, {.035597, .044111, .092755}, {.952793, .926952, .823574}, 3e-6},
               {.6, false, {.024310, .029749, .054044}, {.931078, .876363, .764749}, 3e-6},
               {.1, true, {.04254, .792835, .918003}, {.94642, .177427, .011193}, 3e-5},
               {.3, true, {.0487, .47962, .699286}, {.8507, .34323, .065521}, 2e-4},
               {.6, true, {.0425, .2436, .46247}, {.6340, .3903, .14756}, 1e-4}};
  for (const auto& [alpha, from_glass, reflected, transmitted, tolerance] : known) {
    const RoughDielectric glass(alpha, 1.5, RoughDielectric::Scattering::single);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 from = at(from_glass ? -cosines[k] : cosines[k]);
      // Of every facet both ways, which weigh G2 / G1 each, in the proportion F.
      const double eta = from_glass ? 1 / 1.5 : 1.5;
      const auto F = [&](const Vec3& h) { return core::fresnel(std::abs(from.dot(h.normalized())), eta).mean(); };
      const double back = mean_over_numbers(
          [&](const Vec3& u) {
            const auto s = glass.sample(from, {0, u[1], u[2]}, Walk::from_light);
            return s && same_side(s->way, from) ? F(from + s->way) * s->weight[0] : 0;
          },
          1, 800);
      const double on = mean_over_numbers(
          [&](const Vec3& u) {
            const auto s = glass.sample(from, {1 - 1e-12, u[1], u[2]}, Walk::from_light);
            return s && !same_side(s->way, from) ? (1 - F(from + eta * s->way)) * s->weight[0] : 0;
          },
          1, 800);
      EXPECT_NEAR(back, reflected[k], tolerance) << alpha << " " << from_glass << " " << cosines[k];
      EXPECT_NEAR(on, transmitted[k], tolerance) << alpha << " " << from_glass << " " << cosines[k];
      if (alpha >= .3) {
        EXPECT_NEAR(flux_to(glass, from, from.z() > 0 ? 1 : -1), reflected[k], 1e-4) << alpha << " " << cosines[k];
        EXPECT_NEAR(flux_to(glass, from, from.z() > 0 ? -1 : 1), transmitted[k], 1e-3) << alpha << " " << cosines[k];
      }
    }
  }
}

// Roughness that goes to 0 leaves a mirror and a smooth boundary; equal indices leave nothing.
TEST(RoughDielectric, has_smooth_glass_as_its_limit) {
  const RoughDielectric smooth(1e-3, 1.5), nothing(.3, 1 + 1e-9);
  const Vec3 known = at(.6, .5);
  int straight = 0;  // but for what facets lose, which comes back diffusely
  for (std::uint64_t k = 0; k < 200; ++k) {
    const auto s = smooth.sample(known, three_numbers(4, k), Walk::from_eye);
    ASSERT_TRUE(s);
    const Vec3 ideal =
        s->way.z() > 0 ? core::reflected(known, Vec3::UnitZ()) : *core::refracted(known, Vec3::UnitZ(), 1.5);
    EXPECT_NEAR((s->way - ideal).norm(), 0, .1);
    const auto on = nothing.sample(known, three_numbers(5, k), Walk::from_eye);
    straight += on && (on->way + known).norm() < 1e-6;
  }
  EXPECT_GT(straight, 150);
}

}  // namespace
}  // namespace interflect::montecarlo
