#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "fem/bounds/enclosure.h"
#include "fem/point_view_factors.h"
#include "tests/fem/rooms.h"

/// Random rooms, and what an enclosure of their light is held against.
namespace interflect::fem::test {

/// A closed room on a trapezoid, its walls of their own colours, with a body in it; some walls shine.
inline scene::Scene random_room(std::mt19937& random, double scale = 1) {
  std::uniform_real_distribution<double> part(0, 1);
  const auto reflectance = [&] { return .2 + .6 * part(random); };
  const double w = 1.5 + part(random), d = 1.2 + part(random), h = 1 + .5 * part(random);
  const double from = .4 * part(random), to = w - .4 * part(random);
  std::vector<Vec3> floor{{0, 0, 0}, {w, 0, 0}, {to, d, 0}, {from, d, 0}};
  for (Vec3& x : floor) x *= scale;
  const Vec3 up(0, 0, h * scale);
  scene::SceneBuilder builder({"y"}, scene::Quantity::radiometric);
  const auto add = [&](const char* name, geometry::Ring ring, double exitance) {
    builder.add_polygon(name, {std::move(ring), {}}, builder.add_material(diffuse(reflectance(), exitance)));
  };
  add("floor", floor, 0);
  add("ceiling", {floor[0] + up, floor[3] + up, floor[2] + up, floor[1] + up}, part(random) < .5 ? 1 : 0);
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 &a = floor[k], &b = floor[(k + 1) % 4];
    add("wall", {a, a + up, b + up, b}, k == 0 ? .3 : k == 1 ? part(random) : 0);
  }
  // In braces: drawn in this order by every compiler.
  const Vec3 low{.55 + .2 * part(random), .2 * d + .2 * part(random), .15 + .1 * part(random)};
  const Vec3 size{.3 + .2 * part(random), .3 + .2 * part(random), .3 + .2 * part(random)};
  const auto body = builder.add_material(diffuse(reflectance()));
  builder.add_box("body", geometry::Box(scale * low, scale * (low + size)), body, scene::SceneBuilder::Facing::outward,
                  [](const Vec3& x) { return x; });
  return builder.finish();
}

inline RadiositySolution solved(const scene::Scene& scene, double element_size, int order, Run& run) {
  RadiositySettings settings;
  settings.form_factors = "analytic";
  settings.order = order;
  settings.element_size = element_size;
  settings.quadrature_tolerance = 1e-4;
  settings.stopping.tolerance = 1e-12;
  return solve_radiosity(scene, settings, run);
}

/// The iterated solution of quadratic elements: far nearer to the truth than constants are.
class NearlyTrue {
 public:
  NearlyTrue(const scene::Scene& scene, double element_size, Run& run)
      : solution_(solved(scene, element_size, 2, run)), factors_(scene, solution_.mesh.patches(), 2, 1e-6) {}

  double irradiance(const measure::PointIrradiance& at) const {
    std::vector<double> F(static_cast<std::size_t>(factors_.elements() * factors_.functions())),
        error(solution_.mesh.patches().size());
    factors_(at, F, error);
    return Eigen::Map<const Eigen::VectorXd>(F.data(), std::ssize(F)).dot(solution_.field->radiosity.col(0));
  }

 private:
  RadiositySolution solution_;
  PointViewFactors factors_;
};

/// Places near the corners of an element, where errors are largest, in the middle, and anywhere.
inline std::vector<Vec3> places_in(const scene::SurfacePatch& patch, int anywhere, std::mt19937& random) {
  std::vector<Vec3> places{patch.centroid()};
  for (std::size_t k = 0; k < patch.corners; ++k) places.push_back(places[0] + .98 * (patch.corner[k] - places[0]));
  std::uniform_real_distribution<double> part(0, 1);
  for (int k = 0; k < anywhere; ++k) {
    double u = part(random), v = part(random);
    if (patch.corners == 3 && u + v > 1) u = 1 - u, v = 1 - v;
    places.push_back(point_on(patch.ring(), u, v));
  }
  return places;
}

/// What an enclosure of constants is like at such places.
struct Held {
  int points = 0, outside = 0;  ///< of H, B or B - B_h
  double width = 0;             ///< mean of B's over the elements that were looked at, by area
  double largest_error = 0;     ///< mean of the largest |B - B_h| there
  double all_width = 0;         ///< mean of all elements'
};
/// @param anywhere  random places an element
inline Held held_against(const Enclosure& enclosure, const RadiositySolution& s, const NearlyTrue& truth,
                         double doubt_of_truth, std::size_t every, int anywhere = 0, unsigned seed = 1) {
  Held held;
  std::mt19937 random(seed);
  double area = 0, all_area = 0;
  const auto within = [&](double x, const Interval& bounds) {
    return x > bounds.lower[0] - doubt_of_truth && x < bounds.upper[0] + doubt_of_truth;
  };
  for (std::size_t i = 0; i < s.mesh.patches().size(); ++i) {
    const scene::SurfacePatch& patch = s.mesh.patches()[i];
    const Interval& B = enclosure.radiosity()[i];
    held.all_width += patch.area * (B.upper[0] - B.lower[0]);
    all_area += patch.area;
    if (i % every != 0) continue;
    double largest = 0;
    for (const Vec3& x : places_in(patch, anywhere, random)) {
      const double H = truth.irradiance({x, patch.normal(), patch.surface});
      const double b = s.exitance[i][0] + s.reflectance[i][0] * H,
                   e = b - (s.field ? s.field->at(i, x) : s.radiosity[i])[0];
      ++held.points;
      if (!within(H, enclosure.irradiance()[i]) || !within(b, B) || !within(e, enclosure.error()[i])) ++held.outside;
      largest = std::max(largest, std::abs(e));
    }
    held.width += patch.area * (B.upper[0] - B.lower[0]);
    held.largest_error += patch.area * largest;
    area += patch.area;
  }
  held.width /= area;
  held.largest_error /= area;
  held.all_width /= all_area;
  return held;
}

}  // namespace interflect::fem::test
