#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>
#include <type_traits>

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
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace interflect::results {

namespace {

/// A file in memory, as the decoder takes it.
struct Encoded {
  explicit Encoded(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
    if (!in.is_open() || in.bad()) throw core::InputError(file.string(), "the file cannot be read");
  }
  const unsigned char* data() const { return reinterpret_cast<const unsigned char*>(bytes.data()); }
  int size() const { return static_cast<int>(std::min<std::size_t>(bytes.size(), 0x7fffffff)); }

  std::string bytes;
};

/// Red, green and blue by `load`, each times `scale`.
template <class Load>
core::Image decoded(const std::filesystem::path& file, const Encoded& encoded, Load load, float scale) {
  int width = 0, height = 0, channels = 0;
  auto* const found = load(encoded.data(), encoded.size(), &width, &height, &channels, 3);
  const std::unique_ptr<std::remove_pointer_t<decltype(found)>, void (*)(void*)> pixels(found, stbi_image_free);
  if (!pixels) throw core::InputError(file.string(), stbi_failure_reason());
  core::Image image(width, height, {"R", "G", "B"});
  std::transform(pixels.get(), pixels.get() + image.data.size(), image.data.begin(),
                 [scale](auto value) { return scale * static_cast<float>(value); });
  return image;
}

}  // namespace

core::Image read_hdr(const std::filesystem::path& file) {
  const Encoded encoded(file);
  if (stbi_is_hdr_from_memory(encoded.data(), encoded.size()) == 0)
    throw core::InputError(file.string(), "this is not a picture in Radiance's format (#?RADIANCE)");
  return decoded(file, encoded, stbi_loadf_from_memory, 1);
}

core::Image read_png(const std::filesystem::path& file) {
  return decoded(file, Encoded(file), stbi_load_from_memory, 1 / 255.0F);
}

core::Image read_radiance(const std::filesystem::path& file) {
  const std::string extension = core::lower_case(file.extension().string());
  if (extension == ".exr") return read_exr(file);
  if (extension == ".hdr" || extension == ".pic") return read_hdr(file);
  throw core::InputError(file.string(), "a picture of radiance is expected: .exr, .hdr or .pic");
}

}  // namespace interflect::results
