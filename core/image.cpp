#include "core/image.h"

#include <algorithm>

#include "core/error.h"

namespace interflect::core {

Image::Image(int w, int h, std::vector<std::string> names) : width(w), height(h), channels(std::move(names)) {
  if (w < 1 || h < 1 || channels.empty()) throw PreconditionError("an image has at least one pixel and one channel");
  data.assign(offset(0, h), 0.0F);
}

Spectrum Image::pixel(int x, int y) const {
  Spectrum values;
  for (int c = 0; c < static_cast<int>(channels.size()); ++c) values[c] = static_cast<double>(at(x, y, c));
  return values;
}

Image side_by_side(const std::vector<Image>& images, int gap) {
  if (images.empty()) throw PreconditionError("side_by_side: at least one image expected");
  int width = -gap;
  for (const Image& image : images) {
    if (image.height != images[0].height || image.channels.size() != images[0].channels.size())
      throw PreconditionError("side_by_side: images of one height and number of channels expected");
    width += image.width + gap;
  }
  Image all(width, images[0].height, images[0].channels);
  std::fill(all.data.begin(), all.data.end(), 1.0F);
  int left = 0;
  for (const Image& image : images) {
    for (int y = 0; y < image.height; ++y)
      std::copy_n(image.data.begin() + static_cast<std::ptrdiff_t>(image.offset(0, y)), image.offset(image.width, 0),
                  all.data.begin() + static_cast<std::ptrdiff_t>(all.offset(left, y)));
    left += image.width + gap;
  }
  return all;
}

}  // namespace interflect::core
