#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "apps/solved_scene.h"
#include "results/light_groups.h"

namespace interflect::apps {

/// What `solve --light-groups` leaves for `dim`, in the folder of a solution.
std::filesystem::path light_group_file(const std::filesystem::path& folder);

/// Solutions of all groups, and what they bring to the sensors.
void write_light_groups(const SolvedScene& solved, const std::filesystem::path& folder, Run& run);

/// Of every group's part that is wanted, 1 where nothing is said: "ceiling=0.4".
/// @throws core::InputError  naming the option: none of that name (with those known), twice the same, no number >= 0
std::vector<double> dimming_of(const std::vector<std::string>& texts, const results::LightGroups& all);

/// For below a picture: "window side 40 %, door side 0 %; same scale as at full output", a few by name; or "all lights
/// at full output".
std::string dimming_text(const results::LightGroups& all, const std::vector<double>& factors);

/// sum_g f_g of everything: irradiance and radiosity are linear in the light.  Errors add up, since what elements and
/// form factors do to one group they do to all: |sum f b_g| <= sum f |b_g|, and so of noise.
fem::RadiositySolution dimmed(const results::LightGroups& all, const std::vector<double>& factors);
std::vector<Estimate> dimmed_points(const results::LightGroups& all, const std::vector<double>& factors);

}  // namespace interflect::apps
