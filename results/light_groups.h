#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/estimate.h"
#include "core/spectrum.h"
#include "scene/place.h"

namespace interflect::results {

/// What one group of lights does alone, at full output; lists are per element, or per point of a sensor.
struct GroupLight {
  std::string name;
  std::vector<Spectrum> exitance, radiosity, irradiance;
  std::vector<Spectrum> irradiance_error, irradiance_noise, field_error;  ///< as RadiositySolution has them
  Spectrum shared_noise;
  std::vector<Estimate> at_points;
};

/// Solutions of light groups: what any dimming of them is made of, without a solve.
struct LightGroups {
  std::string scene_file;  ///< absolute
  std::string digest;      ///< geometry_digest of scene and elements
  std::vector<scene::SurfacePatch> patches;
  std::vector<Spectrum> reflectance;
  std::vector<GroupLight> groups;
};

/// An HDF5 file, written under another name and renamed.  @throws core::InputError  it cannot be written
void write_light_groups(const std::filesystem::path& file, const LightGroups& all, int channels);
/// To the bit.  @throws core::InputError  in one line: there is none; none of ours, or damaged
LightGroups read_light_groups(const std::filesystem::path& file);

}  // namespace interflect::results
