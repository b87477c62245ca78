#include "validation/judged.h"

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

std::vector<Reading> readings_of(const scene::Scene& scene) {
  const bool photometric = scene.quantity == scene::Quantity::photometric;
  std::vector<Reading> readings{{photometric ? "illuminance" : "irradiance", scene.weights}};
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
