#include "results/light_groups.h"

#include <cmath>

#include "core/error.h"
#include "core/format.h"
#include "results/hdf5_file.h"

namespace interflect::results {
namespace {

constexpr const char* format_name = "interflect light groups 1";
constexpr std::uint64_t most_elements = 1ull << 32;

using Sizes = Hdf5File::Sizes;

/// Spectra of one list, as a matrix.
void write_spectra(Hdf5File& file, const std::string& name, std::span<const Spectrum> values, int channels) {
  std::vector<double> numbers;
  for (const Spectrum& value : values)
    for (int c = 0; c < channels; ++c) numbers.push_back(value[c]);
  const Sizes sizes{values.size(), static_cast<std::uint64_t>(channels)};
  file.make_doubles(name, sizes);
  if (!values.empty()) file.write(name, {0, 0}, sizes, numbers.data());
}

std::vector<double> read_numbers(const Hdf5File& file, const std::string& name, const Sizes& sizes) {
  if (!file.has(name) || file.sizes_of(name) != sizes)
    throw DamagedFile(file.path().string(), "'" + name + "' is missing, or does not have the size of the rest");
  std::vector<double> numbers(sizes[0] * sizes[1]);
  if (!numbers.empty()) file.read(name, {0, 0}, sizes, numbers.data());
  for (const double number : numbers)
    if (std::isnan(number)) throw DamagedFile(file.path().string(), "'" + name + "' holds what is not a number");
  return numbers;
}

std::vector<Spectrum> read_spectra(const Hdf5File& file, const std::string& name, std::uint64_t count,
                                   std::uint64_t channels) {
  const std::vector<double> numbers = read_numbers(file, name, {count, channels});
  std::vector<Spectrum> values(count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < channels; ++c) values[i][static_cast<int>(c)] = numbers[i * channels + c];
  return values;
}

/// Corners, 12 numbers an element, and what they belong to: surface, side, number of corners.
void write_patches(Hdf5File& file, std::span<const scene::SurfacePatch> patches) {
  std::vector<double> corners;
  std::vector<std::uint64_t> about;
  for (const scene::SurfacePatch& patch : patches) {
    for (const Vec3& x : patch.corner) corners.insert(corners.end(), {x.x(), x.y(), x.z()});
    about.insert(about.end(),
                 {patch.surface.value, patch.side == scene::Side::back ? 1ull : 0ull, std::uint64_t{patch.corners}});
  }
  const std::uint64_t n = patches.size();
  file.make_doubles("corners", {n, 12});
  file.write("corners", {0, 0}, {n, 12}, corners.data());
  file.make_counts("elements", {n, 3});
  file.write("elements", {0, 0}, {n, 3}, about.data());
}

std::vector<scene::SurfacePatch> read_patches(const Hdf5File& file, std::uint64_t n) {
  const std::vector<double> corners = read_numbers(file, "corners", {n, 12});
  std::vector<std::uint64_t> about(3 * n);
  file.read("elements", {0, 0}, {n, 3}, about.data());
  std::vector<scene::SurfacePatch> patches;
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint64_t surface = about[3 * i], side = about[3 * i + 1], count = about[3 * i + 2];
    if (side > 1 || (count != 3 && count != 4) || surface >= most_elements)
      throw DamagedFile(file.path().string(), core::format("element %zu is none", i));
    std::array<Vec3, 4> ring;
    for (std::size_t k = 0; k < 4; ++k)
      ring[k] = Vec3(corners[12 * i + 3 * k], corners[12 * i + 3 * k + 1], corners[12 * i + 3 * k + 2]);
    patches.push_back(scene::make_patch(scene::SurfaceId{static_cast<std::uint32_t>(surface)},
                                        side == 1 ? scene::Side::back : scene::Side::front,
                                        std::span(ring).first(static_cast<std::size_t>(count))));
  }
  return patches;
}

std::string part(std::size_t group, const char* what) { return core::format("group_%zu_%s", group, what); }

void write_points(Hdf5File& file, std::size_t g, std::span<const Estimate> at_points, int channels) {
  std::vector<Spectrum> value, standard_error, error_bound;
  for (const Estimate& e : at_points) {
    value.push_back(e.value);
    standard_error.push_back(e.standard_error);
    error_bound.push_back(e.error_bound);
  }
  write_spectra(file, part(g, "point_irradiance"), value, channels);
  write_spectra(file, part(g, "point_noise"), standard_error, channels);
  write_spectra(file, part(g, "point_error"), error_bound, channels);
}

std::vector<Estimate> read_points(const Hdf5File& file, std::size_t g, std::uint64_t points, std::uint64_t channels) {
  const auto value = read_spectra(file, part(g, "point_irradiance"), points, channels),
             noise = read_spectra(file, part(g, "point_noise"), points, channels),
             bound = read_spectra(file, part(g, "point_error"), points, channels);
  std::vector<Estimate> out;
  for (std::size_t k = 0; k < points; ++k) out.push_back({value[k], noise[k], bound[k], Claim::estimated, 0});
  return out;
}

}  // namespace

void write_light_groups(const std::filesystem::path& file, const LightGroups& all, int channels) {
  const std::uint64_t n = all.patches.size(), of_group = 6 * n * static_cast<std::uint64_t>(channels);
  Hdf5File::Room room;
  room.apparent += sizeof(double) * (n * 15 + all.groups.size() * of_group);
  room.at_once = room.apparent;
  write_whole(file, room, [&](Hdf5File& stored) {
    stored.write_note("format", format_name);
    stored.write_note("scene", all.scene_file);
    stored.write_note("digest", all.digest);
    std::vector<std::string> names;
    for (const GroupLight& group : all.groups) names.push_back(group.name);
    stored.write_texts("groups", names);
    stored.write_count("points", all.groups.empty() ? 0 : all.groups.front().at_points.size());
    write_patches(stored, all.patches);
    write_spectra(stored, "reflectance", all.reflectance, channels);
    for (std::size_t g = 0; g < all.groups.size(); ++g) {
      const GroupLight& group = all.groups[g];
      write_spectra(stored, part(g, "exitance"), group.exitance, channels);
      write_spectra(stored, part(g, "radiosity"), group.radiosity, channels);
      write_spectra(stored, part(g, "irradiance"), group.irradiance, channels);
      write_spectra(stored, part(g, "error"), group.irradiance_error, channels);
      write_spectra(stored, part(g, "noise"), group.irradiance_noise, channels);
      write_spectra(stored, part(g, "field_error"), group.field_error, channels);
      write_spectra(stored, part(g, "shared_noise"), {&group.shared_noise, 1}, channels);
      write_points(stored, g, group.at_points, channels);
    }
  });
}

LightGroups read_light_groups(const std::filesystem::path& file) {
  const Hdf5File stored = Hdf5File::open(file, Hdf5File::Access::read);
  if (!stored.has("format") || stored.note("format") != format_name)
    throw core::InputError(file.string(), "this HDF5 file holds no light groups");
  LightGroups all{stored.note("scene"), stored.note("digest"), {}, {}, {}};
  const Sizes elements = stored.sizes_of("elements"), reflectance = stored.sizes_of("reflectance");
  std::error_code error;
  if (elements.size() != 2 || elements[1] != 3 || reflectance.size() != 2 || reflectance[1] > Spectrum::capacity ||
      elements[0] > std::filesystem::file_size(file, error) / sizeof(double))
    throw DamagedFile(file.string(), "its elements promise more than the file holds");
  const std::uint64_t n = elements[0], channels = reflectance[1], points = stored.count("points");
  if (points > std::filesystem::file_size(file, error) / sizeof(double))
    throw DamagedFile(file.string(), "its points promise more than the file holds");
  all.patches = read_patches(stored, n);
  all.reflectance = read_spectra(stored, "reflectance", n, channels);
  const std::vector<std::string> names = stored.texts("groups");
  for (std::size_t g = 0; g < names.size(); ++g) {
    const auto of = [&](const char* what) { return read_spectra(stored, part(g, what), n, channels); };
    all.groups.push_back({names[g], of("exitance"), of("radiosity"), of("irradiance"), of("error"), of("noise"),
                          of("field_error"), read_spectra(stored, part(g, "shared_noise"), 1, channels).front(),
                          read_points(stored, g, points, channels)});
  }
  return all;
}

}  // namespace interflect::results
