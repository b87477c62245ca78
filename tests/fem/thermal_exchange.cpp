#include "fem/thermal_exchange.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "tests/fem/rooms.h"
#include "tests/support/shapes.h"

namespace interflect::fem {
namespace {

using scene::SceneBuilder;
using scene::Thermal;

scene::MaterialId grey(SceneBuilder& builder, const Thermal& thermal) {
  scene::Material material{"grey", Spectrum(1 - thermal.emissivity), Spectrum(), scene::Sides::front, thermal};
  return builder.add_material(material);
}

RadiositySettings settings_of(double size) {
  RadiositySettings settings;
  settings.element_size = size;
  settings.form_factors = "analytic";
  settings.quadrature_tolerance = 1e-5;
  return settings;
}

/// The unit cube from inside, its floor made of one material and the rest of another.
scene::Scene cube(const Thermal& floor, const Thermal& rest) {
  SceneBuilder builder({"W"}, scene::Quantity::radiometric);
  const auto of_floor = grey(builder, floor), of_rest = grey(builder, rest);
  const auto wall = [&](const Vec3& corner, const Vec3& u, const Vec3& v, scene::MaterialId m) {
    builder.add_polygon("wall", test::parallelogram(corner, u, v), m);
  };
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  wall(Vec3::Zero(), x, y, of_floor);
  wall(z, y, x, of_rest);
  wall(Vec3::Zero(), y, z, of_rest);
  wall(x, z, y, of_rest);
  wall(Vec3::Zero(), z, x, of_rest);
  wall(y, x, z, of_rest);
  return builder.finish();
}

ThermalExchange solve(const scene::Scene& scene, double size, double environment = 0) {
  core::LocalRun run(1, 2);
  return solve_exchange(scene, settings_of(size), environment, run.get());
}

TEST(ThermalExchange, an_enclosure_at_one_temperature_exchanges_nothing) {
  const ThermalExchange found = solve(cube({0.3, 500.0}, {0.9, 500.0}), 0.3);
  const double black = scene::stefan_boltzmann * std::pow(500.0, 4);
  for (const ThermalSurface& s : found.surfaces) {
    EXPECT_NEAR(s.irradiance / black, 1, 1e-4);
    EXPECT_NEAR(s.heat_flux / black, 0, 1e-4);
    EXPECT_LE(std::abs(s.heat_flux), s.heat_flux_error + 1e-9 * black);
  }
}

// An environment shifts the field: bodies at its temperature exchange nothing with it, however open they are.
TEST(ThermalExchange, an_open_body_at_the_temperature_of_the_environment_exchanges_nothing) {
  SceneBuilder builder({"W"}, scene::Quantity::radiometric);
  const auto m = grey(builder, {0.4, 350.0});
  builder.add_polygon("a", test::parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), m);
  builder.add_polygon("b", test::parallelogram({0, 0, 0}, {0, 1, 0}, {0, 0, 1}), m);
  const ThermalExchange found = solve(builder.finish(), 0.5, 350);
  const double black = scene::stefan_boltzmann * std::pow(350.0, 4);
  for (const ThermalSurface& s : found.surfaces) {
    EXPECT_NEAR(s.heat_flux / black, 0, 1e-12);
    EXPECT_NEAR(s.radiosity / black, 1, 1e-12);
  }
}

// The floor's quarters are alike by symmetry: the flux that is found, given in place of the temperature, gives that
// back.
TEST(ThermalExchange, a_heat_flux_gives_back_the_temperature_that_it_was_found_from) {
  const Thermal cold{0.8, 300.0};
  const ThermalExchange found = solve(cube({0.6, 700.0}, cold), 0.5);
  EXPECT_GT(found.surfaces[0].heat_flux, 0);
  EXPECT_NEAR(found.emitted / (found.surfaces[0].heat_flux * found.surfaces[0].area), 0,
              1e-4);  // what leaves the floor arrives
  const ThermalExchange back = solve(cube({0.6, std::nullopt, found.surfaces[0].heat_flux}, cold), 0.5);
  EXPECT_TRUE(back.surfaces[0].flux_given);
  EXPECT_NEAR(back.surfaces[0].temperature, 700, 1e-4);
}

/// Cylinder of radius 1 and a depth, closed below, open above, of n facets.
scene::Scene cavity(double depth, double emissivity, int sides, double temperature) {
  SceneBuilder builder({"W"}, scene::Quantity::radiometric);
  const auto m = grey(builder, {emissivity, temperature});
  const auto at = [&](int k, double z) {
    const double angle = 2 * pi * k / sides;
    return Vec3(std::cos(angle), std::sin(angle), z);
  };
  geometry::Ring base;
  for (int k = 0; k < sides; ++k) {
    base.push_back(at(k, 0));
    builder.add_polygon("wall", {{at(k + 1, 0), at(k, 0), at(k, depth), at(k + 1, depth)}, {}}, m);
  }
  builder.add_polygon("base", {base, {}}, m);
  return builder.finish();
}

// docs/truths.md 2.7: effective emissivity of the aperture of isothermal cavities.  96 sides in place of a circle and
// constants on elements are worth 6e-4 at most.  What leaves by the aperture is counted by 100 000 rays, with standard
// errors of .0033 to .0052.
TEST(ThermalExchange, cavities_have_their_known_effective_emissivities) {
  constexpr int sides = 96;
  const double aperture = 0.5 * sides * std::sin(2 * pi / sides), temperature = 1000;
  for (const auto& [depth, emissivity, effective] :
       {std::tuple(1.0, 0.5, 0.7423863490), {1.0, 0.9, 0.9618701681}, {2.0, 0.5, 0.8082990303}}) {
    const ThermalExchange found = solve(cavity(depth, emissivity, sides, temperature), 0.3);
    const double black = scene::stefan_boltzmann * std::pow(temperature, 4) * aperture;
    EXPECT_NEAR(found.emitted / black, effective, 1e-3) << depth << " " << emissivity;
    EXPECT_NEAR(found.to_environment / black, effective, 0.01) << depth << " " << emissivity;
  }
}

// Inside a sphere H is the mean of B, whatever the temperatures: two halves, exact but for the facets.
TEST(ThermalExchange, two_halves_of_a_sphere_exchange_as_the_closed_form_says) {
  SceneBuilder builder({"W"}, scene::Quantity::radiometric);
  const auto hot = grey(builder, {0.7, 800.0}), cold = grey(builder, {0.4, 400.0});
  std::vector<geometry::TriangleCorners> above, below;
  for (const auto& t : interflect::test::icosphere(2, 1, true))
    ((t[0] + t[1] + t[2]).z() > 0 ? above : below).push_back(t);
  builder.add_facets("hot", above, hot);
  builder.add_facets("cold", below, cold);
  const scene::Scene scene = builder.finish();
  const double a = scene.area({0}) / (scene.area({0}) + scene.area({1}));
  const double hot_black = scene::stefan_boltzmann * std::pow(800.0, 4),
               cold_black = scene::stefan_boltzmann * std::pow(400.0, 4);
  const double H = (a * 0.7 * hot_black + (1 - a) * 0.4 * cold_black) / (1 - a * 0.3 - (1 - a) * 0.6);
  const ThermalExchange found = solve(scene, 0.4);
  EXPECT_NEAR(found.surfaces[0].heat_flux / (0.7 * (hot_black - H)), 1, 0.01);
  EXPECT_NEAR(found.surfaces[1].heat_flux / (0.4 * (cold_black - H)), 1, 0.01);
}

TEST(ThermalExchange, without_an_answer_is_refused_in_one_sentence) {
  EXPECT_THROW(solve(cube({0.5, std::nullopt, 10}, {0.5, std::nullopt, -2}), 0.5), core::InputError);
  scene::Scene lit = cube({0.5, 300.0}, {0.5, 300.0});
  lit.materials[1].thermal.reset();
  EXPECT_THROW(solve(lit, 0.5), core::InputError);
}

}  // namespace
}  // namespace interflect::fem
