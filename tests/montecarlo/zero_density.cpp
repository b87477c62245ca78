#include <array>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "core/random.h"
#include "montecarlo/bidirectional/walk.h"
#include "montecarlo/bsdf/lambert.h"
#include "montecarlo/bsdf/mask.h"
#include "montecarlo/bsdf/plastic.h"
#include "montecarlo/bsdf/rough_conductor.h"
#include "montecarlo/bsdf/rough_dielectric.h"
#include "montecarlo/bsdf/smooth.h"
#include "montecarlo/integrators.h"
#include "montecarlo/light/emission_picker.h"
#include "montecarlo/light/light_set.h"
#include "montecarlo/sample_report.h"
#include "tests/montecarlo/known_rooms.h"
#include "tests/montecarlo/rooms.h"

// Nothing counts that has no density: where a density is zero there is nothing to be found, or it shows.
namespace interflect::montecarlo {
namespace {

const double least = 0, next_to_one = 1 - std::numeric_limits<double>::epsilon() / 2;
constexpr double roughest = .8;  // alpha of a rough surface
constexpr int draws = 5'000;

/// Numbers in [0, 1), every eighth one of them at an end.
double number(core::RandomNumbers& numbers) {
  const double u = numbers.next(), which = numbers.next();
  return which < 1. / 16 ? least : which < 1. / 8 ? next_to_one : u;
}

/// Directions about z and -z, every fourth one within 1e-4 .. 1e-16 of the plane.
Vec3 direction(core::RandomNumbers& numbers) {
  const double u = numbers.next(), turn = 2 * pi * numbers.next(), which = numbers.next();
  const double cosine = which < .25 ? std::pow(10., -4 - 12 * u) : u, side = numbers.next() < .5 ? -1 : 1,
               sine = std::sqrt(1 - cosine * cosine);
  return {sine * std::cos(turn), sine * std::sin(turn), side * cosine};
}

/// Whether it scatters what arrives from behind.
struct Kind {
  std::unique_ptr<Bsdf> bsdf;
  bool on_back = true;
};

std::vector<Kind> make_all_bsdfs() {
  Spectrum colour(.7);
  colour[1] = .4;
  using Metal = RoughConductor::Scattering;
  using Glass = RoughDielectric::Scattering;
  std::vector<Kind> all;
  const auto add = [&](std::unique_ptr<Bsdf> bsdf, bool on_back = true) { all.push_back({std::move(bsdf), on_back}); };
  add(std::make_unique<Lambert>(colour));
  add(std::make_unique<Lambert>(colour, Lambert::On::front), false);
  add(std::make_unique<Mirror>(colour));
  add(std::make_unique<Dielectric>(1.5));
  add(std::make_unique<ThinPane>(1.5, Spectrum(.9)));
  add(std::make_unique<Plastic>(1.5, colour));
  for (const double alpha : {.05, .3, roughest}) {
    add(std::make_unique<RoughConductor>(alpha, MetalFresnel(colour)));
    add(std::make_unique<RoughConductor>(alpha, MetalFresnel(colour), Metal::single));
    for (const double eta : {1.5, 1 / 1.5}) {
      add(std::make_unique<RoughDielectric>(alpha, eta));
      add(std::make_unique<RoughDielectric>(alpha, eta, Glass::single));
    }
  }
  add(std::make_unique<Mask>(.6, std::make_unique<RoughConductor>(.5, MetalFresnel(colour))));
  add(std::make_unique<FrontOnly>(std::make_unique<RoughConductor>(.5, MetalFresnel(colour))), false);
  return all;
}

/// Once: rough ones make tables.
const std::vector<Kind>& all_bsdfs() {
  static const std::vector<Kind> all = make_all_bsdfs();
  return all;
}

// So that a direction that is refused for its density (scattered, bsdf.h) would have brought nothing.
TEST(ZeroDensity, of_a_direction_is_where_nothing_is_scattered) {
  std::uint32_t stream = 0;
  for (const auto& [bsdf, on_back] : all_bsdfs()) {
    core::RandomNumbers numbers(5, stream++, 0);
    for (int k = 0; k < draws; ++k) {
      const Vec3 known = direction(numbers), drawn = direction(numbers);
      const double p = bsdf->pdf_solid_angle(known, drawn);
      EXPECT_TRUE(std::isfinite(p) && p >= 0) << stream;
      for (const Walk walk : {Walk::from_eye, Walk::from_light}) {
        const Spectrum f = f_of(*bsdf, known, drawn, walk);
        EXPECT_TRUE(f.is_finite()) << stream;
        if (p == 0) {
          EXPECT_TRUE(f.is_zero()) << stream << ": " << f[0] << " from " << known.transpose() << " to "
                                   << drawn.transpose();
        }
      }
    }
  }
}

// Nearly always a direction is drawn, and of smooth and diffuse surfaces always.  A rough one refuses ways that its
// facets send through it.  From straight above a way stays above if the facet leans by less than an eighth of a turn,
// of which the chance is 1 / (1 + alpha²): .61 of the roughest here, which sends more back of what comes from aside,
// since facets that are seen from there face it.  Of the numbers one in sixteen is next to 1, and asks for a facet on
// edge.  So .57 are drawn at least: half, and ten standard deviations.
TEST(ZeroDensity, is_not_that_of_any_direction_drawn) {
  std::uint32_t stream = 0;
  for (const auto& [bsdf, on_back] : all_bsdfs()) {
    core::RandomNumbers numbers(6, stream++, 0);
    int asked = 0, found = 0;
    for (int k = 0; k < draws; ++k) {
      const Vec3 known = direction(numbers);
      const double lobe = number(numbers), u = number(numbers), v = number(numbers);
      const bool scatters = on_back || known.z() > 0;
      asked += scatters;
      for (const Walk walk : {Walk::from_eye, Walk::from_light}) {
        const auto on = bsdf->sample(known, {lobe, u, v}, walk);
        EXPECT_TRUE(scatters || !on) << stream;
        if (!on) continue;
        found += walk == Walk::from_eye;
        EXPECT_TRUE(on->weight.is_finite()) << stream;
        EXPECT_TRUE(on->delta || on->pdf_solid_angle > 0) << stream;
      }
    }
    EXPECT_GE(found, asked / 2) << stream;
  }
}

// Each light is found somewhere: the spot, whose cone few places are in and which is picked least, at some thirty.
// All of them at half the places and more: where there is a sun, a sky and lamps nearby, which are picked alike, the
// sun always and the sky at every other place, since places are turned in all ways; where there are lamps alone, at
// nine of ten places, those that are before them.
TEST(ZeroDensity, is_not_that_of_any_light_drawn) {
  for (const scene::Scene& scene : {test::lit_by_all(), test::shiny(), test::furnished(1e-6), test::furnished(1e6)}) {
    const double scale = scene.box().max().x() / 3;
    const LightSet lights(scene);
    const EmissionPicker emissions(lights);
    core::RandomNumbers numbers(7, 0, 0);
    std::vector<int> finds(lights.size());
    for (int k = 0; k < draws; ++k) {
      const auto [leaving, part] = emissions.pick(numbers.next());
      const Emission emission =
          lights[leaving].sample_emission({number(numbers), number(numbers), number(numbers), number(numbers)});
      EXPECT_TRUE(part > 0 && emission.pdf_area > 0 && emission.pdf_solid_angle > 0) << leaving;
      EXPECT_TRUE(emission.weight.is_finite()) << leaving;
      const Vec3 normal = direction(numbers);
      const Place place{scale * Vec3(numbers.next(), numbers.next(), numbers.next()),
                        k % 4 == 0 ? Vec3(Vec3::Zero()) : normal};
      const auto [light, probability] = lights.pick(place, number(numbers));
      EXPECT_GT(probability, 0) << light;
      const auto found = lights[light].sample_arriving(place, number(numbers), number(numbers));
      if (!found) continue;
      ++finds[light];
      EXPECT_TRUE(found->light.is_finite()) << light;
      EXPECT_TRUE(lights[light].is_delta() ? found->pdf_solid_angle == 0
                                           : found->pdf_solid_angle > 0 && std::isfinite(found->pdf_solid_angle))
          << light << ": " << found->pdf_solid_angle;
    }
    for (std::size_t l = 0; l < finds.size(); ++l) EXPECT_GT(finds[l], 0) << l;
    EXPECT_GT(std::accumulate(finds.begin(), finds.end(), 0), draws / 2);
  }
}

TEST(ZeroDensity, makes_what_a_walk_carries_no_number) {
  const Spectrum carried = test::grey(.5);
  EXPECT_EQ(carried_to(carried, 1e-300), carried);
  EXPECT_FALSE(carried_to(carried, 0).is_finite());
  EXPECT_FALSE(carried_to(carried, std::numeric_limits<double>::quiet_NaN()).is_finite());
}

// In a room of lamps that is turned ways lead, to rounding, from a wall to itself, and see it edge-on.
TEST(ZeroDensity, of_a_lamp_that_is_seen_edge_on_is_left_out) {
  const scene::Scene scene = test::random_room(test::furnace_wall(std::array{.2, .6}), {"a", "b"}, {});
  const measure::Measurement all = test::all_fronts(scene);
  core::LocalRun run(1, 2);
  SampleReport report;
  IntegratorSettings settings;
  settings.samples = 40'000, settings.report = &report;
  make_integrator("bidirectional", settings)->answer(scene, {&all, 1}, run.get());
  EXPECT_EQ(report.not_finite, 0u);
}

}  // namespace
}  // namespace interflect::montecarlo
