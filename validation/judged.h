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

/// One number from a spectrum, sum_c weights[c] value[c]: what is compared.
///
/// Errors follow by the triangle inequality, sum_c |weights[c]| error[c]: exact for one channel and for channels that
/// are fully correlated (paths carry all channels at once), else an upper bound.
struct Reading {
  std::string name;
  Spectrum weights;

  double value(const Spectrum& s) const;
  double error(const Spectrum& s) const;  ///< a channel of weight 0 counts nothing, even if it is infinite
};

/// The weighted value ("illuminance" or "irradiance"), and each channel where there is more than one.
std::vector<Reading> readings_of(const scene::Scene& scene);

const char* describe(Judged::Kind kind);

}  // namespace interflect::validation
