#pragma once

#include <string>

#include "core/error.h"
#include "scene/reader.h"
#include "tests/support/temporary_folder.h"

namespace interflect::scene::test {

using Folder = interflect::test::TemporaryFolder;

/// A scene of one white square, with more keys, and other materials or geometry where they are given.
struct Text {
  std::string more;
  std::string materials = R"("white": {"reflectance": 0.5})";
  std::string geometry = R"({"polygon": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]], "material": "white"})";
  std::string units = "m";

  std::string str() const {  // the line of each key is part of what tests check
    return "{\n"
           "\"format\": \"interflect/scene/1\",\n"
           "\"units\": \"" +
           units + "\",\n" + (more.empty() ? "" : more + ",\n") + "\"materials\": {" + materials +
           "},\n"
           "\"geometry\": [" +
           geometry +
           "]\n"
           "}\n";
  }
};

inline Scene parsed(const Text& text, const std::filesystem::path& folder = ".") {
  return parse_scene(text.str(), "s.json", folder);
}

/// What is said of a bad scene; "read" of a good one.  More than one line is said so.
inline std::string complaint(const std::string& text, const std::filesystem::path& folder = ".") {
  try {
    parse_scene(text, "s.json", folder);
    return "read";
  } catch (const core::InputError& error) {
    const std::string what = error.what();
    return what.find('\n') == std::string::npos ? what : "MORE THAN ONE LINE: " + what;
  }
}
inline std::string complaint(const Text& text, const std::filesystem::path& folder = ".") {
  return complaint(text.str(), folder);
}

}  // namespace interflect::scene::test
