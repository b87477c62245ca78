#pragma once

#include <string>
#include <vector>

#include "core/spectrum.h"

namespace interflect::core {

/// A raster of `channels` floats a pixel, row by row from the top left.
struct Image {
  int width = 0, height = 0;
  std::vector<std::string> channels;  ///< their names: "R", "G", "B", or a scene's own
  std::vector<float> data;            ///< [(y * width + x) * channels.size() + c]

  Image() = default;
  Image(int width, int height, std::vector<std::string> channels);

  float& at(int x, int y, int channel) { return data[offset(x, y) + static_cast<std::size_t>(channel)]; }
  float at(int x, int y, int channel) const { return data[offset(x, y) + static_cast<std::size_t>(channel)]; }
  /// The channels of a pixel, of which there are at most Spectrum::capacity.
  Spectrum pixel(int x, int y) const;
  std::size_t offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
           channels.size();
  }
};

/// The images beside each other, `gap` white pixels apart.  All have the same height and channels.
Image side_by_side(const std::vector<Image>& images, int gap);

}  // namespace interflect::core
