#pragma once

#include <string>

#include "core/error.h"
#include "scene/geometry_file.h"
#include "tests/support/temporary_folder.h"

namespace interflect::scene::test {

/// What is said of a file of geometry, without the folder before its name; "read" of a good one.
inline std::string said_of_geometry(const std::string& name, const std::string& bytes,
                                    const GeometryOptions& options = {}) {
  const interflect::test::TemporaryFolder folder;
  try {
    read_geometry_as_scene(folder.write(name, bytes), options);
    return "read";
  } catch (const core::InputError& error) {
    std::string what = error.what();
    if (what.find('\n') != std::string::npos) return "MORE THAN ONE LINE: " + what;
    const std::string prefix = folder.path().string() + "/";
    if (what.starts_with(prefix)) what.erase(0, prefix.size());
    return what;
  }
}

inline ExchangeScene geometry_of(const std::string& name, const std::string& bytes,
                                 const GeometryOptions& options = {}) {
  const interflect::test::TemporaryFolder folder;
  return read_geometry_as_scene(folder.write(name, bytes), options);
}

inline std::vector<std::string> names_of(const ExchangeScene& read) {
  std::vector<std::string> out;
  for (const Surface& surface : read.scene.surfaces) out.push_back(surface.name);
  return out;
}

inline std::vector<std::string> groups_of(const ExchangeScene& read) {
  std::vector<std::string> out;
  for (const ExchangeSurface& surface : read.surfaces) out.push_back(surface.group);
  return out;
}

}  // namespace interflect::scene::test
