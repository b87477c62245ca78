#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/estimate.h"
#include "scene/scene.h"

namespace interflect::validation {

/// One measurement that both methods answered: an irradiance H [W/m² | lx].
struct Judged {
  enum class Kind : std::uint8_t { surface, element, sensor };

  std::string name;  ///< "ceiling", "desk/back", "element 17", "workplane[3]"
  Kind kind = Kind::surface;
  std::int64_t element = -1;  ///< its number in the mesh, if it is one
  double area = 0;            ///< [m²]; 0 for a point of a sensor
  bool emitting = false;
  Estimate fem, mc;
  std::string group;  ///< the side of a surface ("desk/back") or the sensor ("workplane") that it belongs to
  double weight = 0;  ///< area that it stands for where elements were chosen [m²]; 0: its own

  double represented_area() const { return weight > 0 ? weight : area; }
};

/// Of a number read from an estimate.
struct Noise {
  double standard_error;
  bool exact;  ///< it is the standard error; else only an upper bound of it, which must not be subtracted from anything
};

/// One number from a spectrum, sum_c weights[c] value[c]: what is compared.
struct Reading {
  std::string name;
  Spectrum weights;
  bool of_scene = false;  ///< the weights are the scene's: Estimate::weighed_standard_error is of this reading

  double value(const Spectrum& s) const;
  /// By the triangle inequality sum_c |weights[c]| error[c], an upper bound; a channel of weight 0 counts nothing, even
  /// if it is infinite.
  double error(const Spectrum& s) const;
  /// Exact for a single channel, and for the scene's weighted value where the method measured its noise; else the upper
  /// bound.  Where nothing was found (value 0) the "standard error" is a bound too, by the rule of three.
  Noise noise(const Estimate& e) const;
};

/// The weighted value ("illuminance" or "irradiance"), and each channel where there is more than one.
std::vector<Reading> readings_of(const scene::Scene& scene);

const char* describe(Judged::Kind kind);

}  // namespace interflect::validation
