#include "results/difference_layers.h"

#include <cmath>

#include "core/error.h"

namespace interflect::results {
namespace {

bool are_alike(const core::Image& a, const core::Image& b) {
  return a.width == b.width && a.height == b.height && a.channels.size() == b.channels.size();
}

std::vector<std::string> layered(const std::vector<std::string>& channels) {
  std::vector<std::string> names;
  for (const char* layer : {"", ".error", ".z"})
    for (const std::string& channel : channels) names.push_back(channel + layer);
  return names;
}

}  // namespace

core::Image difference_layers(const PictureWithError& a, const PictureWithError& b) {
  if (!are_alike(a.values, b.values) || !are_alike(a.values, a.standard_error) ||
      !are_alike(b.values, b.standard_error) || a.values.channels != b.values.channels)
    throw core::PreconditionError("difference_layers: pictures of one size and the same channels expected");
  core::Image layers(a.values.width, a.values.height, layered(a.values.channels));
  const int channels = static_cast<int>(a.values.channels.size());
  for (int y = 0; y < layers.height; ++y)
    for (int x = 0; x < layers.width; ++x)
      for (int c = 0; c < channels; ++c) {
        const double difference = double{a.values.at(x, y, c)} - double{b.values.at(x, y, c)};
        const double error = std::hypot(a.standard_error.at(x, y, c), b.standard_error.at(x, y, c));
        layers.at(x, y, c) = static_cast<float>(difference);
        layers.at(x, y, channels + c) = static_cast<float>(error);
        layers.at(x, y, 2 * channels + c) = difference == 0 ? 0.0F : static_cast<float>(difference / error);
      }
  return layers;
}

}  // namespace interflect::results
