#pragma once

#include <filesystem>
#include <string>

#include "core/image.h"
#include "results/tone_mapping.h"

namespace interflect::results {

/// OpenEXR file contents: every channel under its name (r, g, b become R, G, B, which viewers expect), 32-bit floats as
/// they are, ZIP.
/// @pre  no two channels have one name, R and r being one: of such channels the file would hold one
std::string exr_bytes(const core::Image& image);
/// Channels in the order in which they were written, where exr_bytes wrote them.
/// @throws core::InputError  naming the file
core::Image read_exr(const std::filesystem::path& file);

/// Radiance's RGBE pictures (.hdr, .pic): channels R, G, B, with 8 bits and a common exponent.
/// @throws core::InputError  naming the file
core::Image read_hdr(const std::filesystem::path& file);
/// Channels R, G, B of a PNG for display: [0, 1], encoded as they are there.
/// @throws core::InputError  naming the file
core::Image read_png(const std::filesystem::path& file);
/// A picture of radiance: .exr, .hdr or .pic.
/// @throws core::InputError  for another extension, or if the file cannot be read
core::Image read_radiance(const std::filesystem::path& file);

/// PNG file contents, 8 bits a channel, of an image of 1, 3 or 4 channels for display: [0, 1], already encoded;
/// clipped.
std::string png_bytes(const core::Image& display);

/// By the extension: .exr keeps the radiance; .png is tone mapped for looking.
/// @throws core::InputError  for another extension, or if the file cannot be written
void write_image(const std::filesystem::path& file, const core::Image& image, const ToneMapping& tone = {});

/// For images that are already meant for display.
void write_png(const std::filesystem::path& file, const core::Image& display);

/// Refuses a name that write_image would refuse, before the work is done.
void require_image_extension(const std::filesystem::path& file);
/// And one of whose two files, .exr and .png, cannot be: where a directory has the name.
void require_both_images(const std::filesystem::path& file);

}  // namespace interflect::results
