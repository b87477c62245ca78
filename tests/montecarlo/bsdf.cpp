#include "montecarlo/bsdf/bsdf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/random.h"
#include "montecarlo/bsdf/lambert.h"
#include "montecarlo/bsdf/mask.h"
#include "montecarlo/bsdf/plastic.h"
#include "montecarlo/bsdf/rough_conductor.h"
#include "montecarlo/bsdf/rough_dielectric.h"
#include "montecarlo/bsdf/smooth.h"
#include "tests/support/family.h"

namespace interflect::montecarlo {
namespace {

Vec3 at(double cosine, double azimuth = 0) {
  const double sine = std::sqrt(1 - cosine * cosine);
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}
double degrees(double angle) { return std::cos(angle * pi / 180); }

Vec3 numbers_of(std::uint32_t stream, std::uint64_t k) {
  core::RandomNumbers numbers(7, stream, k);
  const double a = numbers.next(), b = numbers.next(), c = numbers.next();
  return {a, b, c};
}

struct Named {
  std::string name;
  std::unique_ptr<Bsdf> bsdf;
  double eta = 1;  ///< behind the front over before it
  bool lossless = false;
};
std::vector<Named> all_kinds() {
  const Spectrum colour = [] {
    Spectrum s(.7);
    s[1] = .4;
    return s;
  }();
  using Once = RoughConductor::Scattering;
  std::vector<Named> kinds;
  const auto add = [&](std::string name, std::unique_ptr<Bsdf> bsdf, double eta = 1, bool lossless = false) {
    kinds.push_back({std::move(name), std::move(bsdf), eta, lossless});
  };
  add("lambert", std::make_unique<Lambert>(colour));
  add("white lambert", std::make_unique<Lambert>(Spectrum(1)), 1, true);
  add("mirror", std::make_unique<Mirror>(Spectrum(1)), 1, true);
  add("glass", std::make_unique<Dielectric>(1.5), 1.5, true);
  add("air in water", std::make_unique<Dielectric>(1 / 1.33), 1 / 1.33, true);
  add("pane", std::make_unique<ThinPane>(1.5, Spectrum(.96 / 1.04)), 1, true);
  add("tinted pane", std::make_unique<ThinPane>(1.5, colour));
  add("gold",
      std::make_unique<RoughConductor>(.3, MetalFresnel(MetalFresnel::ComplexIndex{Spectrum(.2), Spectrum(3)})));
  add("rough metal", std::make_unique<RoughConductor>(.8, MetalFresnel(colour)));
  add("white metal", std::make_unique<RoughConductor>(.4, MetalFresnel(Spectrum(1))), 1, true);
  add("metal once", std::make_unique<RoughConductor>(.5, MetalFresnel(Spectrum(1)), Once::single));
  add("frosted", std::make_unique<RoughDielectric>(.3, 1.5), 1.5, true);
  add("frosted from within", std::make_unique<RoughDielectric>(.6, 1 / 1.5), 1 / 1.5, true);
  add("frosted once", std::make_unique<RoughDielectric>(.5, 1.5, RoughDielectric::Scattering::single), 1.5);
  add("plastic", std::make_unique<Plastic>(1.5, colour));
  add("white plastic", std::make_unique<Plastic>(1.5, Spectrum(1)), 1, true);
  add("masked", std::make_unique<Mask>(.6, std::make_unique<RoughConductor>(.5, MetalFresnel(Spectrum(1)))), 1, true);
  add("front", std::make_unique<FrontOnly>(std::make_unique<Lambert>(colour)));
  return kinds;
}

/// The mean of a function of the numbers that a direction is drawn by over midpoints of them, which are closer together
/// where facets are steepest.
template <class Score>
double mean_over_numbers(const Score& score, int lobes, int n) {
  double sum = 0;
  for (int a = 0; a < n; ++a) {
    const double left = 1 - (a + .5) / n;
    for (int b = 0; b < n; ++b)
      for (int l = 0; l < lobes; ++l)
        sum += 3 * left * left * score(Vec3((l + .5) / lobes, 1 - left * left * left, (b + .5) / n));
  }
  return sum / lobes / n / n;
}
/// The same of the direction and weight, 0 where none is drawn.
template <class Score>
double mean_over_draws(const Bsdf& bsdf, const Vec3& known, Walk walk, const Score& score, int lobes = 64, int n = 48) {
  return mean_over_numbers(
      [&](const Vec3& u) {
        const auto s = bsdf.sample(known, u, walk);
        return s ? score(s->way, s->weight[0]) : 0;
      },
      lobes, n);
}
double albedo(const Bsdf& bsdf, const Vec3& known, Walk walk = Walk::from_light) {
  return mean_over_draws(bsdf, known, walk, [](const Vec3&, double weight) { return weight; });
}

/// int f(known -> o) |cos_o| over a side, by midpoints in azimuth and sqrt(1 - cosine), which see a peak at the normal.
double flux_to(const Bsdf& bsdf, const Vec3& known, double side) {
  constexpr int n = 500;
  double sum = 0;
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      const double x = (a + .5) / n, c = 1 - x * x;
      sum += bsdf.f(known, at(side * c, pi * (b + .5) / n))[0] * c * 2 * x;  // symmetric about the plane of incidence
    }
  return sum * 2 * pi / n / n;
}

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
        const Vec3 u = numbers_of(8, k);
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
        const Vec3 u = numbers_of(stream, k), h = facets.sample(v, u[0], u[1]);
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

TEST(Plastic, reflects_what_is_known) {
  const double angles[] = {0, 60, 80};
  const struct {
    double rho, albedo[3];
  } known[] = {
      {.5, {.3160708867, .3511127876, .5637845648}}, {.8, {.6328334076, .6516456136, .7658182233}}, {1, {1, 1, 1}}};
  for (const auto& [rho, of] : known)
    for (std::size_t k = 0; k < 3; ++k) {
      const Plastic plastic(1.5, Spectrum(rho));
      const double coat = core::fresnel(degrees(angles[k]), 1.5).mean();
      EXPECT_NEAR(coat + flux_to(plastic, at(degrees(angles[k])), 1), of[k], 2e-6);
      EXPECT_NEAR(albedo(plastic, at(degrees(angles[k]))), of[k], 5e-3);  // which part is drawn, in 64 steps
    }
}

// f(a -> b) eta_a² = f(b -> a) eta_b².
TEST(Bsdfs, are_reciprocal) {
  for (const Named& of : all_kinds()) {
    for (std::uint64_t k = 0; k < 2000; ++k) {
      const Vec3 u = numbers_of(1, k), v = numbers_of(2, k);
      const Vec3 a = at(2 * u[0] - 1, 2 * pi * u[1]), b = at(2 * v[0] - 1, 2 * pi * v[1]);
      const double eta_a = a.z() > 0 ? 1 : of.eta, eta_b = b.z() > 0 ? 1 : of.eta;
      const double there = of.bsdf->f(a, b)[0] * eta_a * eta_a, back = of.bsdf->f(b, a)[0] * eta_b * eta_b;
      EXPECT_NEAR(there, back, 1e-9 * there + 1e-12) << of.name;
      EXPECT_GE(there, 0) << of.name;
    }
  }
}

// In a furnace whose radiance is as the square of the index, what is lossless cannot be seen, by either walk.
TEST(Bsdfs, that_lose_nothing_are_invisible_in_a_furnace) {
  for (const Named& of : all_kinds())
    for (const double cosine : {1.0, .8, .5, .2, -.3, -.7, -.95}) {
      const auto index = [&](const Vec3& way) { return way.z() > 0 ? 1 : of.eta * of.eta; };
      const Vec3 known = at(cosine, .3);
      const double flux = albedo(*of.bsdf, known),
                   radiance = mean_over_draws(*of.bsdf, known, Walk::from_eye, [&](const Vec3&way, double weight) {
                     return weight * index(way) / index(known);
                   });
      if (of.lossless) {
        EXPECT_NEAR(flux, 1, 3e-3) << of.name << " " << cosine;
        EXPECT_NEAR(radiance, 1, 3e-3) << of.name << " " << cosine;
      } else {
        EXPECT_LT(flux, 1 - 1e-2) << of.name << " " << cosine;
      }
    }
}

/// Cosines of incidence from both sides, grazing to 1e-12, and by the critical angle of what is behind.
std::vector<double> all_incidences(double eta) {
  std::vector<double> cosines{1};
  for (int k = 1; k <= 12; ++k) cosines.push_back(std::pow(.1, k));
  for (std::uint64_t k = 0; k < 500; ++k) cosines.push_back(numbers_of(9, k)[0]);
  const double least = std::min(eta, 1 / eta), critical = std::sqrt(1 - least * least);
  for (const double off : {-1e-6, -1e-15, 0., 1e-15, 1e-6})
    if (critical + off > 0) cosines.push_back(critical + off);
  const std::size_t from_before = cosines.size();
  for (std::size_t k = 0; k < from_before; ++k) cosines.push_back(-cosines[k]);
  return cosines;
}

/// How far any channel's weight, times a ratio, is from 1.
double off_one(const Scattered& drawn, double ratio) {
  double off = 0;
  for (int c = 0; c < Spectrum::capacity; ++c) off = std::max(off, std::abs(drawn.weight[c] * ratio - 1));
  return off;
}

// What loses nothing and has no table says so to rounding, from both sides and at grazing light: parts are 1 together,
// and every draw weighs 1, of any channel and by either walk.  16 units in the last place of 1 are thirty roundings of
// half a unit.
TEST(Bsdfs, that_lose_nothing_and_are_exact_weigh_one_always) {
  constexpr double rounding = 16 * 0x1p-52, end = 1 - 0x1p-53;
  const double F = core::fresnel(1, 1.5).mean();
  std::vector<Named> kinds;
  kinds.push_back({"lambert", std::make_unique<Lambert>(Spectrum(1)), 1});
  kinds.push_back({"mirror", std::make_unique<Mirror>(Spectrum(1)), 1});
  for (const double eta : {1.5, 1 / 1.33, 2.4, 1.})
    kinds.push_back({"dielectric " + std::to_string(eta), std::make_unique<Dielectric>(eta), eta});
  kinds.push_back({"pane", std::make_unique<ThinPane>(1.5, Spectrum((1 - F) / (1 + F))), 1});
  for (const Named& of : kinds)
    for (const double cosine : all_incidences(of.eta)) {
      const Vec3 known = at(cosine, .3);
      const auto index2 = [&](const Vec3& way) { return way.z() > 0 ? 1 : of.eta * of.eta; };
      for (std::uint64_t k = 0; k < 16; ++k) {
        const Vec3 u = k == 0 ? Vec3(0, 0, 0) : k == 1 ? Vec3(end, end, end) : numbers_of(10, k);
        const auto light = of.bsdf->sample(known, u, Walk::from_light), eye = of.bsdf->sample(known, u, Walk::from_eye);
        ASSERT_TRUE(light && eye) << of.name << " " << cosine;
        ASSERT_LE(off_one(*light, 1), rounding) << of.name << " " << cosine;
        ASSERT_LE(off_one(*eye, index2(eye->way) / index2(known)), rounding) << of.name << " " << cosine;
        if (light->delta) continue;
        const double p = of.bsdf->pdf_solid_angle(known, light->way);
        ASSERT_NEAR(of.bsdf->f(known, light->way)[0] * std::abs(light->way.z()) / p, 1, rounding) << cosine;
      }
      DeltaParts parts;
      of.bsdf->delta_parts(known, Walk::from_light, parts);
      double sum = of.bsdf->only_delta() ? 0 : 1;
      for (const Scattered& part : parts) sum += part.weight[0];
      ASSERT_NEAR(sum, 1, rounding) << of.name << " " << cosine;
    }
}

// 200 000 directions fall where the pdf says, each weighs f |cos| / p of either walk, and nothing is drawn that has no
// pdf.
TEST(Bsdfs, draw_as_they_say) {
  constexpr int n = 200'000, rows = 24, columns = 24, fine = 24;
  const std::vector<Named> kinds = all_kinds();
  const std::array cosines{.95, .4, -.6};
  test::Family family(test::tails_of_counts * kinds.size() * cosines.size());
  for (const Named& of : kinds)
    for (const double cosine : cosines) {
      const Vec3 known = at(cosine, 1);
      std::vector<double> expected(rows * columns), counts(rows * columns + 1);
      double all = 0;
      for (int a = 0; a < rows * fine; ++a)
        for (int b = 0; b < columns * fine; ++b) {
          const Vec3 way = at(2 * (a + .5) / (rows * fine) - 1, 2 * pi * (b + .5) / (columns * fine));
          const double p = of.bsdf->pdf_solid_angle(known, way) * 4 * pi / (rows * fine * columns * fine);
          expected[static_cast<std::size_t>(a / fine * columns + b / fine)] += n * p;
          all += p;
        }
      double delta = 0;
      for (std::uint64_t k = 0; k < n; ++k) {
        const auto s = of.bsdf->sample(known, numbers_of(3, k), Walk::from_eye);
        if (!s) continue;
        EXPECT_NEAR(s->way.norm(), 1, 1e-12);
        if (s->delta) {
          ++delta;
          continue;
        }
        ASSERT_GT(s->pdf_solid_angle, 0) << of.name;
        const double azimuth = std::atan2(s->way.y(), s->way.x()) / (2 * pi);
        const int a = std::min(rows - 1, static_cast<int>((s->way.z() + 1) / 2 * rows)),
                  b = std::min(columns - 1, static_cast<int>((azimuth < 0 ? azimuth + 1 : azimuth) * columns));
        ++counts[static_cast<std::size_t>(a * columns + b)];
        if (k % 64 != 0) continue;
        const double p = of.bsdf->pdf_solid_angle(known, s->way), c = std::abs(s->way.z());
        EXPECT_NEAR(s->pdf_solid_angle, p, 1e-9 * p) << of.name;
        EXPECT_NEAR(s->weight[0], of.bsdf->f(s->way, known)[0] * c / p, 1e-9 * s->weight[0]) << of.name;
        const auto light = of.bsdf->sample(known, numbers_of(3, k), Walk::from_light);
        EXPECT_EQ(light->way, s->way);
        EXPECT_NEAR(light->weight[0], of.bsdf->f(known, s->way)[0] * c / p, 1e-9 * light->weight[0]) << of.name;
      }
      EXPECT_TRUE(!of.bsdf->only_delta() || all == 0) << of.name;
      counts.pop_back();
      test::expect_as_expected(counts, expected, family, of.name + " at " + std::to_string(cosine));
    }
}

// Roughness that goes to 0 leaves a mirror and a smooth boundary; equal indices leave nothing.
TEST(RoughDielectric, has_smooth_glass_as_its_limit) {
  const RoughDielectric smooth(1e-3, 1.5), nothing(.3, 1 + 1e-9);
  const Vec3 known = at(.6, .5);
  int straight = 0;  // but for what facets lose, which comes back diffusely
  for (std::uint64_t k = 0; k < 200; ++k) {
    const auto s = smooth.sample(known, numbers_of(4, k), Walk::from_eye);
    ASSERT_TRUE(s);
    const Vec3 ideal =
        s->way.z() > 0 ? core::reflected(known, Vec3::UnitZ()) : *core::refracted(known, Vec3::UnitZ(), 1.5);
    EXPECT_NEAR((s->way - ideal).norm(), 0, .1);
    const auto on = nothing.sample(known, numbers_of(5, k), Walk::from_eye);
    straight += on && (on->way + known).norm() < 1e-6;
  }
  EXPECT_GT(straight, 150);
}

// Of which walk is asked shows in refraction alone: radiance in glass is n² times that outside.
TEST(Dielectric, changes_radiance_as_the_square_of_the_index) {
  const Dielectric glass(1.5);
  for (std::uint64_t k = 0; k < 100; ++k) {
    const Vec3 inside = at(-.9, 2), u = numbers_of(6, k);
    const auto eye = glass.sample(inside, u, Walk::from_eye), light = glass.sample(inside, u, Walk::from_light);
    EXPECT_EQ(light->weight[0], 1);
    EXPECT_NEAR(eye->weight[0], eye->way.z() > 0 ? 1.5 * 1.5 : 1, 1e-14);
  }
}

// What a tree follows of delta parts is what paths draw of them on average, way by way.
TEST(DeltaParts, are_the_means_of_what_is_drawn) {
  for (const Named& kind : all_kinds())
    for (const Walk walk : {Walk::from_eye, Walk::from_light})
      for (const Vec3& known : {Vec3(.6, 0, .8), Vec3(.48, .6, .64), Vec3(0, .96, .28), Vec3(.6, 0, -.8)}) {
        DeltaParts parts;
        kind.bsdf->delta_parts(known, walk, parts);
        std::vector<Spectrum> drawn(static_cast<std::size_t>(parts.end() - parts.begin()));
        constexpr int n = 20'000;
        for (int k = 0; k < n; ++k) {
          const auto on = kind.bsdf->sample(known, {(k + .5) / n, .3, .4}, walk);
          if (!on || !on->delta) continue;
          const auto* part = std::find_if(parts.begin(), parts.end(), [&](const Scattered& each) {
            return (each.way - on->way).norm() < 1e-12 && each.straight == on->straight;
          });
          ASSERT_NE(part, parts.end()) << kind.name;
          drawn[static_cast<std::size_t>(part - parts.begin())] += on->weight / n;
        }
        std::size_t p = 0;
        for (const Scattered& part : parts) {
          for (int c = 0; c < 2; ++c) EXPECT_NEAR(drawn[p][c], part.weight[c], 2e-4) << kind.name << " part " << p;
          ++p;
        }
      }
}

}  // namespace
}  // namespace interflect::montecarlo
