#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/inspection.h"

namespace interflect::apps {

/// Whether a scene without light is odd, or its surfaces exchange something else.
enum class SceneUse { light, exchange };

/// Reads the scene and prints what was noted about it; nothing is written yet.
scene::Scene read_and_note(const std::filesystem::path& file, SceneUse use = SceneUse::light);

/// The same of a scene that is to be solved; what may be there twice is warned of.
/// @throws core::InputError  where what may not be is there twice (scene::require_each_place_once): before any work
scene::Scene read_to_solve(const std::filesystem::path& file, SceneUse use = SceneUse::light,
                           scene::Twice may_be = scene::Twice::parts_of_a_surface);

/// "room.obj: 12 degenerate faces dropped", a note a line.
std::vector<std::string> lines_of(const std::vector<scene::Note>& notes);

/// "5 x 4 x 3 m, from (0, 0, 0) to (5, 4, 3)": where a wrong unit shows.
std::string box_text(const scene::Scene& scene);

}  // namespace interflect::apps
