#pragma once

#include "tests/fem/bounds/random_room.h"

/// Bounds about any functions, of what is 0: since all is linear, those of B_h = b_f + d about a manufactured solution b_f.
namespace interflect::fem::test {

/// B_h at the corners of an element.
inline std::vector<double> at_corners(const RadiositySolution& s, std::size_t i) {
  const scene::SurfacePatch& patch = s.mesh.patches()[i];
  std::vector<double> values;
  for (std::size_t k = 0; k < patch.corners; ++k)
    values.push_back(s.field ? s.field->at(i, patch.corner[k])[0] : s.radiosity[i][0]);
  return values;
}

/// Numbers in -1 .. 1, or linear functions about as large, in place of a solution, and nothing that shines.
inline void set_anything(RadiositySolution& s, std::mt19937& random) {
  std::uniform_real_distribution<double> part(-1, 1);
  for (std::size_t i = 0; i < s.radiosity.size(); ++i) {
    s.radiosity[i] = Spectrum(part(random));
    s.exitance[i] = Spectrum();
    if (!s.field) continue;
    const Index first = static_cast<Index>(i) * s.field->functions;
    s.field->radiosity(first, 0) = s.radiosity[i][0];
    for (Index a = 1; a < s.field->functions; ++a) s.field->radiosity(first + a, 0) = .5 * part(random);
  }
}

/// Of a manufactured solution in a random room.
struct Manufactured {
  Index elements = 0, outside = 0;
  double size = 0, width = 0;  ///< over the area: of the largest |d| on elements, of upper bounds of B
};
inline Manufactured manufactured(unsigned seed, int order, double memory, Run& run) {
  std::mt19937 random(seed);
  const scene::Scene scene = random_room(random);
  RadiositySolution s = solved(scene, 1.2, order, run);
  set_anything(s, random);
  const Enclosure enclosure(scene, s, memory, run);
  Manufactured found{s.mesh.size()};
  for (std::size_t i = 0; i < s.radiosity.size(); ++i) {
    double largest = 0;
    const Interval& error = enclosure.error()[i];
    for (const double B_h : at_corners(s, i)) {
      largest = std::max(largest, std::abs(B_h));
      found.outside += -B_h > error.upper[0] || -B_h < error.lower[0];
    }
    found.outside += enclosure.radiosity()[i].upper[0] < 0 || enclosure.radiosity()[i].lower[0] > 0;
    found.outside += enclosure.mean_irradiance()[i].upper[0] < 0 || enclosure.mean_irradiance()[i].lower[0] > 0;
    found.size += s.mesh.patches()[i].area * largest;
    found.width += s.mesh.patches()[i].area * enclosure.radiosity()[i].upper[0];
  }
  return found;
}

}  // namespace interflect::fem::test
