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
    EXPECT_LE(std::abs(found.emitted - effective * black), found.emitted_error + 6e-4 * black)
        << depth << " " << emissivity;
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

double black_at(double temperature) { return scene::stefan_boltzmann * std::pow(temperature, 4); }

/// The six faces of a cube about the origin, of an edge [m].
void add_cube(SceneBuilder& builder, const std::string& name, double edge, bool inwards, scene::MaterialId material) {
  const double h = edge / 2;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-h, h}) {
      Vec3 corner(-h, -h, -h), u = Vec3::Zero(), v = Vec3::Zero();
      corner[axis] = side;
      u[(axis + 1) % 3] = v[(axis + 2) % 3] = edge;  // u x v is along the axis
      if ((side > 0) == inwards) std::swap(u, v);
      builder.add_polygon(name, test::parallelogram(corner, u, v), material);
    }
}

/// How often a true value lay beyond the error that was stated.
struct Misses {
  double truth = 0;
  int misses = 0;
  double largest_error = 0;  ///< a part of the value

  void add(double value, double error) {
    misses += std::abs(value - truth) > error ? 1 : 0;
    largest_error = std::max(largest_error, error / std::abs(truth));
  }
};

/// A convex grey body in the middle of a black room at 300 K, whose six walls are alike.  Whatever its shape it gets
/// sigma T_2^4 from everywhere; the walls get A_1 / A_2 of what it sends and the rest of their own:
///
///   H_1 = sigma T_2^4,   B_1 = e sigma T_1^4 + (1 - e) H_1,   H_2 = H_1 + A_1 / A_2 (B_1 - H_1).
///
/// That is the closed form of two concentric spheres, of areas 6 and 24.  Half of the room is hidden by the body, and
/// visibility is sampled.  A 95 % interval may miss by noise with a probability of .05: more than 6 of 20 seeds with
/// one of 3.4e-5, of any of the numbers below with one of 2.4e-4.
void expect_errors_to_hold_about(const Thermal& body) {
  const double H = black_at(300), e = body.emissivity;
  const double black = body.temperature ? black_at(*body.temperature) : H + body.heat_flux / e;
  const double B = e * black + (1 - e) * H, of_wall = H + .25 * (B - H);
  SceneBuilder builder({"W"}, scene::Quantity::radiometric);
  add_cube(builder, "body", 1, false, grey(builder, body));
  add_cube(builder, "wall", 2, true, grey(builder, {1, 300.0}));
  const scene::Scene scene = builder.finish();
  Misses T{std::pow(black / scene::stefan_boltzmann, .25)}, q{B - H}, Q{B - H}, B_1{B}, H_1{H}, H_2{of_wall},
      Q_2{4 * (H - of_wall)};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    core::LocalRun run(seed, 2);
    const ThermalExchange found = solve_exchange(scene, settings_of(.5), 400, run.get());
    const ThermalSurface &of_body = found.surfaces[0], &wall = found.surfaces[6];
    T.add(of_body.temperature, of_body.temperature_error);
    q.add(of_body.heat_flux, of_body.heat_flux_error);
    Q.add(of_body.flux(), of_body.flux_error());
    B_1.add(of_body.radiosity, of_body.radiosity_error);
    H_1.add(of_body.irradiance, of_body.irradiance_error);
    H_2.add(wall.irradiance, wall.irradiance_error);
    Q_2.add(wall.flux(), wall.flux_error());
    EXPECT_EQ(wall.radiosity_error, 0) << "what is black sends what its temperature says";
    EXPECT_NEAR(wall.radiosity, H, 1e-9 * H);
    EXPECT_EQ(of_body.temperature_error == 0, !of_body.flux_given);
    EXPECT_EQ(of_body.flux_error() == 0, of_body.flux_given);
  }
  for (const auto& [what, of] :
       {std::pair{"T", T}, {"q", q}, {"Q", Q}, {"B_1", B_1}, {"H_1", H_1}, {"H_2", H_2}, {"Q_2", Q_2}}) {
    EXPECT_LE(of.misses, 6) << what << " of " << of.truth;
    EXPECT_LT(of.largest_error, .2) << what << ": it would hold anything";
  }
}

TEST(ThermalExchange, errors_hold_where_temperatures_are_given) { expect_errors_to_hold_about({.6, 500.0}); }
TEST(ThermalExchange, errors_hold_where_a_temperature_is_found) {
  expect_errors_to_hold_about({.6, std::nullopt, 900});
}

// The farther end of what H +- dH makes of T: both are within the error, and one is at it.
TEST(ThermalExchange, the_error_of_a_temperature_reaches_both_ends) {
  const ThermalExchange found = solve(cube({0.6, std::nullopt, -100}, {0.8, 300.0}), 0.5);
  const ThermalSurface& s = found.surfaces[0];
  const auto temperature = [&](double H) { return std::pow((H - 100 / .6) / scene::stefan_boltzmann, .25); };
  EXPECT_NEAR(temperature(s.irradiance), s.temperature, 1e-9);
  const double up = temperature(s.irradiance + s.irradiance_error) - s.temperature,
               down = s.temperature - temperature(s.irradiance - s.irradiance_error);
  EXPECT_GT(up, 0);
  EXPECT_NEAR(std::max(up, down) / s.temperature_error, 1, 1e-6);
}

/// Two squares that face each other at a distance of 1.
scene::Scene squares(double lower_edge, const Thermal& lower, double upper_edge, const Thermal& upper) {
  SceneBuilder builder({"W"}, scene::Quantity::radiometric);
  const double a = lower_edge / 2, b = upper_edge / 2;
  builder.add_polygon("lower", test::parallelogram({-a, -a, 0}, {lower_edge, 0, 0}, {0, lower_edge, 0}),
                      grey(builder, lower));
  builder.add_polygon("upper", test::parallelogram({-b, -b, 1}, {0, upper_edge, 0}, {upper_edge, 0, 0}),
                      grey(builder, upper));
  return builder.finish();
}

// Black squares with edges of 1 and 2, middle above middle: F_12 = .5176530795155335 (the sum of sixteen terms of
// parallel rectangles; of unit squares it gives .1998248957), F_21 a quarter of it.  Both are colder than what they see
// beside each other: an error is no less for that.
TEST(ThermalExchange, errors_hold_of_unequal_plates_colder_than_their_surroundings) {
  const double F = .5176530795155335, cold = black_at(100), mild = black_at(200), around = black_at(300);
  const ThermalExchange found = solve(squares(1, {1, 100.0}, 2, {1, 200.0}), .5, 300);
  const double lower = cold - F * mild - (1 - F) * around, upper = 4 * (mild - F / 4 * cold - (1 - F / 4) * around);
  EXPECT_NEAR(found.surfaces[0].flux(), lower, found.surfaces[0].flux_error());
  EXPECT_NEAR(found.surfaces[1].flux(), upper, found.surfaces[1].flux_error());
  EXPECT_NEAR(found.emitted, lower + upper, found.emitted_error);
  for (const ThermalSurface& s : found.surfaces) {
    EXPECT_GT(s.flux_error(), 0);
    EXPECT_LT(s.flux_error(), .01 * std::abs(s.flux()));
  }
}

// docs/truths.md 2.4: the lower unit square emits 1 in surroundings that emit nothing, and the mean radiosities are
// known.  What is colder than its surroundings takes as much as it would give if it were that much warmer, and the
// error is the same.
TEST(ThermalExchange, errors_hold_of_grey_plates_and_know_no_sign) {
  const double around = black_at(300);
  for (const auto& [e_lower, e_upper, B_lower, B_upper] :
       {std::tuple(.5, .5, 1.010218055060, .100947189239), {.7, .3, 1.008568960685, .141092268875}}) {
    std::vector<ThermalExchange> signs;
    for (const double E : {200.0, -200.0}) {  // e (sigma T^4 - sigma T_0^4)
      const double temperature = std::pow((around + E / e_lower) / scene::stefan_boltzmann, .25);
      signs.push_back(solve(squares(1, {e_lower, temperature}, 1, {e_upper, 300.0}), .25, 300));
      const std::vector<ThermalSurface>& found = signs.back().surfaces;
      const double H_lower = E * (B_lower - 1) / (1 - e_lower), H_upper = E * B_upper / (1 - e_upper);
      EXPECT_NEAR(found[0].irradiance, around + H_lower, found[0].irradiance_error);
      EXPECT_NEAR(found[1].irradiance, around + H_upper, found[1].irradiance_error);
      EXPECT_NEAR(found[0].radiosity, around + E * B_lower, found[0].radiosity_error);
      EXPECT_NEAR(found[1].radiosity, around + E * B_upper, found[1].radiosity_error);
      EXPECT_NEAR(found[0].flux(), E - e_lower * H_lower, found[0].flux_error());
      EXPECT_NEAR(found[1].flux(), -e_upper * H_upper, found[1].flux_error());
      EXPECT_LT(found[1].flux_error(), .1 * std::abs(found[1].flux()));
    }
    for (std::size_t k = 0; k < 2; ++k) {
      const ThermalSurface &warm = signs[0].surfaces[k], &cold = signs[1].surfaces[k];
      EXPECT_NEAR(cold.flux(), -warm.flux(), 1e-6 * std::abs(warm.flux()));
      EXPECT_NEAR(cold.flux_error(), warm.flux_error(), 1e-6 * warm.flux_error());
    }
    // Rays: 2.2 half widths are 4.3 standard errors, which one of these four exceeds with a probability of 7e-5.
    for (const ThermalExchange& sign : signs)
      EXPECT_NEAR(sign.to_environment, sign.emitted, 2.2 * sign.to_environment_error + sign.emitted_error);
  }
}

TEST(ThermalExchange, without_an_answer_is_refused_in_one_sentence) {
  EXPECT_THROW(solve(cube({0.5, std::nullopt, 10}, {0.5, std::nullopt, -2}), 0.5), core::InputError);
  scene::Scene lit = cube({0.5, 300.0}, {0.5, 300.0});
  lit.materials[1].thermal.reset();
  EXPECT_THROW(solve(lit, 0.5), core::InputError);
}

}  // namespace
}  // namespace interflect::fem
