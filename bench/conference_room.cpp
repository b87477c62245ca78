#include "bench/conference_room.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "scene/reader.h"

namespace interflect::bench {
namespace {

namespace fs = std::filesystem;

/// Two materials of the file reflect all light, or say two things: ours for them.
constexpr const char* description = R"({
  "format": "interflect/scene/1", "units": "cm", "up": "y", "channels": ["r", "g", "b"],
  "materials": {
    "lamp": { "type": "diffuse", "reflectance": 0.8, "exitance": 10000 },
    "white": { "type": "diffuse", "reflectance": 0.8, "sides": "both" }
  },
  "geometry": [
    { "file": "conference.obj", "materials": { "mesh16_SG": "white", "mesh29_SG": "white" }, "unmapped": "mtl",
      "repair": { "drop_degenerate": true } },
)";

std::string lamp(int number, double x, double z) {
  constexpr double side = 120, height = 640;
  const auto corner = [&](double a, double b) {
    return "[" + std::to_string(x + a) + ", " + std::to_string(height) + ", " + std::to_string(z + b) + "]";
  };
  return "    { \"name\": \"lamp/" + std::to_string(number) + "\", \"material\": \"lamp\", \"polygon\": [" +
         corner(0, 0) + ", " + corner(side, 0) + ", " + corner(side, side) + ", " + corner(0, side) + "] }";
}

void describe(const fs::path& file) {
  std::ofstream out(file);
  out << description;
  int number = 0;
  for (const double x : {-400., 200., 800.})
    for (const double z : {-600., 100.}) {
      if (number > 0) out << ",\n";
      out << lamp(++number, x, z);
    }
  out << R"(
  ],
  "cameras": [ { "name": "table", "eye": [1400, 300, 350], "target": [300, 120, -250], "fov_y_deg": 60, "size": [24, 24] } ]
})";
}

/// A folder that goes away with what is in it.
class Scratch {
 public:
  Scratch() {
    std::string name = (fs::temp_directory_path() / "interflect-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw fs::filesystem_error("mkdtemp", name, std::error_code());
    path_ = name;
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

bool unpack(const fs::path& archive, const fs::path& into) {
  const std::string command = "cd '" + into.string() + "' && cmake -E tar xf '" + archive.string() + "'";
  return std::system(command.c_str()) == 0;  // NOLINT(concurrency-mt-unsafe): nothing else runs yet
}

}  // namespace

std::optional<scene::Scene> conference_room() {
  const char* corpus = std::getenv("INTERFLECT_CORPUS");  // NOLINT(concurrency-mt-unsafe)
  if (corpus == nullptr) return std::nullopt;
  const fs::path archive = fs::absolute(fs::path(corpus) / "conference" / "conference.zip");
  const Scratch scratch;
  if (!fs::exists(archive) || !unpack(archive, scratch.path())) return std::nullopt;
  const fs::path file = scratch.path() / "conference.json";
  describe(file);
  return scene::read_scene(file);
}

}  // namespace interflect::bench
