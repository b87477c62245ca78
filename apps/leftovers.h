#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace interflect::apps {

/// Removes from a folder what an earlier run left there under names that this one does not write: it would look like a
/// part of it.  Of a stem "bounds": bounds.png, bounds_2.png, .., and the same with the other endings that this program
/// has.
void remove_leftovers(const std::filesystem::path& folder, const std::vector<std::string>& stems);

}  // namespace interflect::apps
