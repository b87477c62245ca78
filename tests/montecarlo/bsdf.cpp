#include "montecarlo/bsdf/bsdf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "montecarlo/bsdf/lambert.h"
#include "montecarlo/bsdf/mask.h"
#include "montecarlo/bsdf/plastic.h"
#include "montecarlo/bsdf/rough_conductor.h"
#include "montecarlo/bsdf/rough_dielectric.h"
#include "montecarlo/bsdf/smooth.h"
#include "tests/montecarlo/bsdf_means.h"
#include "tests/support/family.h"

namespace interflect::montecarlo {
namespace {

using test::albedo;
using test::at;
using test::degrees;
using test::flux_to;
using test::mean_over_draws;
using test::three_numbers;

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
      const Vec3 u = three_numbers(1, k), v = three_numbers(2, k);
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
  for (std::uint64_t k = 0; k < 500; ++k) cosines.push_back(three_numbers(9, k)[0]);
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
        const Vec3 u = k == 0 ? Vec3(0, 0, 0) : k == 1 ? Vec3(end, end, end) : three_numbers(10, k);
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
        const auto s = of.bsdf->sample(known, three_numbers(3, k), Walk::from_eye);
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
        const auto light = of.bsdf->sample(known, three_numbers(3, k), Walk::from_light);
        EXPECT_EQ(light->way, s->way);
        EXPECT_NEAR(light->weight[0], of.bsdf->f(known, s->way)[0] * c / p, 1e-9 * light->weight[0]) << of.name;
      }
      EXPECT_TRUE(!of.bsdf->only_delta() || all == 0) << of.name;
      counts.pop_back();
      test::expect_as_expected(counts, expected, family, of.name + " at " + std::to_string(cosine));
    }
}

// Of which walk is asked shows in refraction alone: radiance in glass is n² times that outside.
TEST(Dielectric, changes_radiance_as_the_square_of_the_index) {
  const Dielectric glass(1.5);
  for (std::uint64_t k = 0; k < 100; ++k) {
    const Vec3 inside = at(-.9, 2), u = three_numbers(6, k);
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
