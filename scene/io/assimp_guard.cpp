#include "scene/io/assimp_guard.h"

#include <cctype>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/format.h"
#include "scene/io/text_file.h"

namespace interflect::scene::io {
namespace {

using Json = nlohmann::json;

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 4; k-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

/// Elements of a PLY file need a byte each, at the very least.
std::optional<std::size_t> require_honest_ply(std::string_view bytes, const std::string& shown) {
  if (!bytes.starts_with("ply")) throw core::InputError(shown, "this is not a PLY file: it does not begin with 'ply'");
  const std::size_t end = bytes.find("end_header");
  if (end == std::string_view::npos) throw core::InputError(shown, "the PLY header has no end");
  std::istringstream header{std::string(bytes.substr(0, end))};
  double promised = 0, faces = 0;
  for (std::string line; std::getline(header, line);) {
    std::istringstream words(line);
    std::string key, name;
    double count = 0;
    if (!(words >> key) || key != "element") continue;
    if (!(words >> name >> count) || !(count >= 0)) throw core::InputError(shown, "'" + shown_word(line) + "' has no count");
    promised += count;
    if (name == "face") faces += count;
  }
  if (promised > static_cast<double>(bytes.size() - end))
    throw core::InputError(shown, core::format("the header promises %.0f elements, in %zu bytes", promised, bytes.size() - end));
  return static_cast<std::size_t>(faces);
}

/// 80 bytes, a count, 50 bytes a triangle; or text that begins with "solid".
std::optional<std::size_t> require_honest_stl(std::string_view bytes, const std::string& shown) {
  constexpr std::size_t head = 84, each = 50;
  const bool text = bytes.substr(0, 5) == "solid";
  if (bytes.size() < head) {
    if (!text) throw core::InputError(shown, core::format("%zu bytes are too few for an STL file", bytes.size()));
    return std::nullopt;
  }
  const std::uint64_t triangles = little_endian(bytes, 80);
  if (text && bytes.find("facet") != std::string_view::npos) return std::nullopt;
  if (head + each * triangles <= bytes.size()) return static_cast<std::size_t>(triangles);
  throw core::InputError(shown, core::format("the header promises %.0f triangles, in %zu bytes", static_cast<double>(triangles),
                                             bytes.size()));
}

const Json& list_of(const Json& root, const char* key) {
  static const Json none = Json::array();
  if (!root.is_object()) return none;
  const auto at = root.find(key);
  return at != root.end() && at->is_array() ? *at : none;
}

/// No node may hold itself: each is entered once, from above.
void require_node_tree(const Json& root, const std::string& shown) {
  constexpr std::size_t deepest = 500;
  const Json& nodes = list_of(root, "nodes");
  std::vector<std::size_t> parents(nodes.size(), 0);
  const auto children_of = [&](std::size_t n) {
    std::vector<std::size_t> out;
    if (!nodes[n].is_object()) return out;
    for (const Json& child : list_of(nodes[n], "children")) {
      if (!child.is_number_unsigned() || child.get<std::uint64_t>() >= nodes.size())
        throw core::InputError(shown, core::format("node %zu has a child that does not exist", n));
      out.push_back(child.get<std::size_t>());
    }
    return out;
  };
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (const std::size_t child : children_of(n))
      if (++parents[child] > 1) throw core::InputError(shown, core::format("node %zu is held by two others", child));
  std::vector<std::size_t> level, next;
  std::size_t reached = 0, depth = 0;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (parents[n] == 0) level.push_back(n);
  for (; !level.empty(); level.swap(next), next.clear()) {
    if (++depth > deepest) throw core::InputError(shown, core::format("nodes are nested deeper than %zu", deepest));
    reached += level.size();
    for (const std::size_t n : level)
      for (const std::size_t child : children_of(n)) next.push_back(child);
  }
  if (reached != nodes.size()) throw core::InputError(shown, "nodes hold each other in a ring");
}

/// Sizes that glTF states must be numbers, and accessors no longer than the buffers they lie in.
void require_honest_sizes(const Json& root, std::uint64_t held, const std::string& shown) {
  std::uint64_t buffers = 0;
  for (const Json& buffer : list_of(root, "buffers"))
    if (buffer.is_object() && buffer.contains("byteLength") && buffer["byteLength"].is_number_unsigned()) {
      const auto length = buffer["byteLength"].get<std::uint64_t>();
      if (length > held) throw core::InputError(shown, "a buffer promises more bytes than the files hold");
      buffers += length;
    }
  for (const char* list : {"accessors", "bufferViews"})
    for (const Json& entry : list_of(root, list))
      for (const char* key : {"count", "byteLength", "byteOffset"}) {
        if (!entry.is_object() || !entry.contains(key)) continue;
        const Json& value = entry[key];
        if (!value.is_number_unsigned())
          throw core::InputError(shown, core::format("'%s' in '%s' is not a whole number", key, list));
        const bool blank = std::strcmp(list, "accessors") == 0 && !entry.contains("bufferView");  // zeros, held nowhere
        if (value.get<std::uint64_t>() > (blank ? std::uint64_t{10'000'000} : buffers))
          throw core::InputError(shown, core::format("'%s' in '%s' exceeds the buffers", key, list));
      }
}

/// Triangles of all primitives; nothing where one is no plain list of them.
std::optional<std::size_t> promised_triangles(const Json& root) {
  constexpr int triangle_list = 4;
  const Json& accessors = list_of(root, "accessors");
  const auto count_of = [&](const Json& index) -> std::optional<std::size_t> {
    if (!index.is_number_unsigned() || index.get<std::size_t>() >= accessors.size()) return std::nullopt;
    const Json& accessor = accessors[index.get<std::size_t>()];
    if (!accessor.is_object() || !accessor.contains("count")) return std::nullopt;
    return accessor["count"].get<std::size_t>();
  };
  std::size_t sum = 0;
  for (const Json& mesh : list_of(root, "meshes"))
    for (const Json& primitive : list_of(mesh, "primitives")) {
      if (!primitive.is_object() || (primitive.contains("mode") && primitive["mode"] != triangle_list)) return std::nullopt;
      std::optional<std::size_t> corners;
      if (primitive.contains("indices"))
        corners = count_of(primitive["indices"]);
      else if (primitive.contains("attributes") && primitive["attributes"].is_object() && primitive["attributes"].contains("POSITION"))
        corners = count_of(primitive["attributes"]["POSITION"]);
      if (!corners) return std::nullopt;
      sum += *corners / 3;
    }
  return sum;
}

/// Bytes in the files that a glTF text may draw on: its own (data URIs) and those that it names.
std::uint64_t bytes_held(const Json& root, const std::filesystem::path& file, std::size_t own, const std::string& shown) {
  std::uint64_t held = own;
  for (const Json& buffer : list_of(root, "buffers")) {
    if (!buffer.is_object() || !buffer.contains("uri") || !buffer["uri"].is_string()) continue;
    const auto uri = buffer["uri"].get<std::string>();
    if (uri.starts_with("data:")) continue;
    std::error_code error;
    const auto size = std::filesystem::file_size(file.parent_path() / uri, error);
    if (error) throw core::InputError(shown, "the buffer '" + shown_word(uri) + "' cannot be read");
    held += size;
  }
  return held;
}

std::optional<std::size_t> require_honest_gltf(std::string_view bytes, const std::filesystem::path& file, const std::string& shown) {
  std::string_view text = bytes;
  if (bytes.starts_with("glTF")) {
    constexpr std::size_t head = 20;
    if (bytes.size() < head || little_endian(bytes, 8) > bytes.size() || little_endian(bytes, 12) > bytes.size() - head)
      throw core::InputError(shown, "the file is shorter than its header says");
    text = bytes.substr(head, little_endian(bytes, 12));
    if (text.find_first_not_of(std::string_view(" \t\r\n\0", 5)) == std::string_view::npos)
      throw core::InputError(shown, "the file has no JSON part");
    while (!text.empty() && text.back() == '\0') text.remove_suffix(1);
  }
  require_text(text, shown);
  const int deepest = 200;
  const auto shallow = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > deepest) throw core::InputError(shown, core::format("nested deeper than %d levels", deepest));
    return true;
  };
  Json root;
  try {
    root = Json::parse(text, shallow);
  } catch (const Json::exception& e) {
    throw core::InputError(shown, core::single_line(e.what()));
  }
  if (!root.is_object()) throw core::InputError(shown, "a JSON object is expected");
  require_honest_sizes(root, bytes_held(root, file, bytes.size(), shown), shown);
  require_node_tree(root, shown);
  return promised_triangles(root);
}

}  // namespace

std::optional<std::size_t> require_honest(const std::filesystem::path& file, const std::string& shown) {
  const std::string bytes = read_bytes(file, shown);
  if (bytes.empty()) throw core::InputError(shown, "the file is empty");
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension == ".ply") return require_honest_ply(bytes, shown);
  if (extension == ".stl") return require_honest_stl(bytes, shown);
  return require_honest_gltf(bytes, file, shown);
}

}  // namespace interflect::scene::io
