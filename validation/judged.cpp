#include "validation/judged.h"

#include <cmath>

namespace interflect::validation {

double Reading::value(const Spectrum& s) const {
  double sum = 0;
  for (int c = 0; c < Spectrum::capacity; ++c)
    if (weights[c] != 0) sum += weights[c] * s[c];
  return sum;
}

double Reading::error(const Spectrum& s) const {
  double sum = 0;
  for (int c = 0; c < Spectrum::capacity; ++c)
    if (weights[c] != 0) sum += std::abs(weights[c]) * s[c];
  return sum;
}

Noise Reading::noise(const Estimate& e) const {
  int channels = 0;
  for (int c = 0; c < Spectrum::capacity; ++c) channels += weights[c] != 0 ? 1 : 0;
  const bool something = value(e.value) != 0;
  if (channels > 1 && of_scene && std::isfinite(e.weighed_standard_error)) return {e.weighed_standard_error, something};
  return {error(e.standard_error), channels <= 1 && something};
}

std::vector<Reading> readings_of(const scene::Scene& scene) {
  const bool photometric = scene.quantity == scene::Quantity::photometric;
  std::vector<Reading> readings{{photometric ? "illuminance" : "irradiance", scene.weights, true}};
  if (scene.channel_count() > 1)
    for (int c = 0; c < scene.channel_count(); ++c) {
      Spectrum one;
      one[c] = 1;
      readings.push_back({scene.channels[static_cast<std::size_t>(c)], one});
    }
  return readings;
}

const char* describe(Judged::Kind kind) {
  switch (kind) {
    case Judged::Kind::surface:
      return "surface";
    case Judged::Kind::element:
      return "element";
    case Judged::Kind::sensor:
      return "sensor";
  }
  return "";
}

}  // namespace interflect::validation
