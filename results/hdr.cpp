#include <fstream>
#include <iterator>

#include "core/error.h"
#include "core/format.h"
#include "results/image_file.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace interflect::results {

core::Image read_hdr(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in.is_open() || in.bad()) throw core::InputError(file.string(), "the file cannot be read");
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  const auto size = static_cast<int>(std::min<std::size_t>(bytes.size(), 0x7fffffff));
  int width = 0, height = 0, channels = 0;
  if (stbi_is_hdr_from_memory(data, size) == 0)
    throw core::InputError(file.string(), "this is not a picture in Radiance's format (#?RADIANCE)");
  const std::unique_ptr<float, void (*)(void*)> pixels(
      stbi_loadf_from_memory(data, size, &width, &height, &channels, 3), stbi_image_free);
  if (!pixels) throw core::InputError(file.string(), stbi_failure_reason());
  core::Image image(width, height, {"R", "G", "B"});
  std::copy_n(pixels.get(), image.data.size(), image.data.begin());
  return image;
}

core::Image read_radiance(const std::filesystem::path& file) {
  const std::string extension = core::lower_case(file.extension().string());
  if (extension == ".exr") return read_exr(file);
  if (extension == ".hdr" || extension == ".pic") return read_hdr(file);
  throw core::InputError(file.string(), "a picture of radiance is expected: .exr, .hdr or .pic");
}

}  // namespace interflect::results
