#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "results/atomic_file.h"
#include "results/image_file.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace interflect::results {

std::string png_bytes(const core::Image& display) {
  const auto channels = static_cast<int>(display.channels.size());
  if (channels != 1 && channels != 3 && channels != 4)
    throw core::PreconditionError("png: 1, 3 or 4 channels expected");
  std::vector<unsigned char> bytes(display.data.size());
  std::transform(display.data.begin(), display.data.end(), bytes.begin(), [](float v) {
    return static_cast<unsigned char>(std::lround(255.0F * (v > 0 ? std::min(v, 1.0F) : 0.0F)));  // NaN is black
  });
  std::string file;
  const auto append = [](void* out, void* data, int size) {
    static_cast<std::string*>(out)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  if (stbi_write_png_to_func(append, &file, display.width, display.height, channels, bytes.data(),
                             display.width * channels) == 0)
    throw std::bad_alloc();
  return file;
}

void write_png(const std::filesystem::path& file, const core::Image& display) {
  write_atomically(file, png_bytes(display));
}

}  // namespace interflect::results
