#include "results/image_file.h"

#include "core/error.h"
#include "core/format.h"
#include "results/atomic_file.h"

namespace interflect::results {

namespace {

std::string extension_of(const std::filesystem::path& file) { return core::lower_case(file.extension().string()); }

}  // namespace

void require_image_extension(const std::filesystem::path& file) {
  if (const std::string extension = extension_of(file); extension != ".exr" && extension != ".png")
    throw core::InputError(file.string(), "an image's name ends in .exr (radiance) or .png (for looking)");
}

void require_both_images(const std::filesystem::path& file) {
  require_image_extension(file);
  for (const char* extension : {".exr", ".png"}) {
    auto one = file;
    one.replace_extension(extension);
    std::error_code error;
    if (std::filesystem::is_directory(one, error)) throw core::InputError(one.string(), "is a directory");
  }
}

void write_image(const std::filesystem::path& file, const core::Image& image, const ToneMapping& tone) {
  require_image_extension(file);
  if (extension_of(file) == ".exr")
    write_atomically(file, exr_bytes(image));
  else
    write_png(file, tone_mapped(image, tone));
}

}  // namespace interflect::results
