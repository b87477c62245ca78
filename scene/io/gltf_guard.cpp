#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/error.h"
#include "core/format.h"
#include "scene/io/assimp_guard.h"
#include "scene/io/glb.h"
#include "scene/io/text_file.h"

namespace interflect::scene::io {
namespace {

using Json = nlohmann::json;

constexpr int deepest_text = 200;           // levels of JSON
constexpr std::size_t deepest_nodes = 500;  // levels of nodes
constexpr double most_zeros = 1e7;          // of an accessor that lies in no buffer: they cost memory and no file

/// An array among an object's members; empty where there is none.
std::vector<const Json*> list_of(const Json& object, const char* key) {
  std::vector<const Json*> out;
  if (!object.is_object()) return out;
  const auto at = object.find(key);
  if (at == object.end() || !at->is_array()) return out;
  for (const Json& entry : *at) out.push_back(&entry);
  return out;
}

/// Those of an object's members that have these keys.
Json only(const Json& object, std::initializer_list<const char*> keys) {
  Json out = Json::object();
  if (!object.is_object()) return out;
  for (const char* key : keys)
    if (const auto at = object.find(key); at != object.end()) out[key] = *at;
  return out;
}

/// The text without all that is no shape: skins, animations, textures, lights, which assimp trips over and nobody here
/// needs.
Json shapes_of(const Json& root) {
  Json out = only(root, {"asset", "scene", "scenes", "accessors", "bufferViews", "buffers"});
  for (const Json* node : list_of(root, "nodes"))
    out["nodes"].push_back(only(*node, {"name", "children", "mesh", "matrix", "translation", "rotation", "scale"}));
  for (const Json* material : list_of(root, "materials")) out["materials"].push_back(only(*material, {"name"}));
  for (const Json* mesh : list_of(root, "meshes")) {
    Json kept = only(*mesh, {"name"});
    for (const Json* primitive : list_of(*mesh, "primitives")) {
      Json part = only(*primitive, {"indices", "mode", "material"});
      part["attributes"] =
          primitive->contains("attributes") ? only((*primitive)["attributes"], {"POSITION"}) : Json::object();
      kept["primitives"].push_back(std::move(part));
    }
    out["meshes"].push_back(std::move(kept));
  }
  return out;
}

/// A glTF text whose sizes are held against each other: buffers against files, views against buffers, accessors against
/// views.
class GltfGuard {
 public:
  GltfGuard(const Json& root, std::size_t binary, std::filesystem::path folder, const std::string& shown)
      : root_(root), binary_(binary), folder_(std::move(folder)), shown_(shown) {}

  std::optional<std::size_t> run() {
    for (const Json* buffer : list_of(root_, "buffers")) add_buffer(*buffer);
    for (const Json* view : list_of(root_, "bufferViews")) add_view(*view);
    for (const Json* accessor : list_of(root_, "accessors")) check_accessor(*accessor);
    for (const Json* mesh : list_of(root_, "meshes"))
      for (const Json* primitive : list_of(*mesh, "primitives")) check_primitive(*primitive);
    require_node_tree();
    return promised_triangles();
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw core::InputError(shown_, message); }

  /// A member that is a whole number; `absent` where it is not there.
  double whole(const Json& object, const char* key, double absent, const char* list) const {
    if (!object.is_object() || !object.contains(key)) return absent;
    if (!object[key].is_number_unsigned()) fail(core::format("'%s' in '%s' is not a whole number", key, list));
    return object[key].get<double>();
  }

  void add_buffer(const Json& buffer) {
    const double length = whole(buffer, "byteLength", 0, "buffers");
    if (length > bytes_behind(buffer)) fail("a buffer promises more bytes than the files hold");
    buffers_.push_back(length);
  }

  /// In the file that a buffer names, in the text that it holds, or in the binary part of a GLB.
  double bytes_behind(const Json& buffer) const {
    if (!buffer.is_object() || !buffer.contains("uri") || !buffer["uri"].is_string())
      return static_cast<double>(binary_);
    const auto uri = buffer["uri"].get<std::string>();
    if (uri.starts_with("data:")) {
      const std::size_t comma = std::min(uri.find(','), uri.size() - 1);
      const double letters = static_cast<double>(uri.size() - comma - 1);
      return uri.substr(0, comma).ends_with("base64") ? 3 * letters / 4 : letters;
    }
    std::error_code error;
    const auto size = std::filesystem::file_size(folder_ / uri, error);
    if (error) fail("the buffer '" + shown_word(uri) + "' cannot be read");
    return static_cast<double>(size);
  }

  void add_view(const Json& view) {
    const double buffer = whole(view, "buffer", 0, "bufferViews");
    const double offset = whole(view, "byteOffset", 0, "bufferViews"),
                 length = whole(view, "byteLength", 0, "bufferViews");
    if (!(buffer < static_cast<double>(buffers_.size())) ||
        offset + length > buffers_[static_cast<std::size_t>(buffer)])
      fail("a buffer view reaches beyond its buffer");
    views_.push_back({length, whole(view, "byteStride", 0, "bufferViews")});
  }

  void check_accessor(const Json& accessor) const {
    const double count = whole(accessor, "count", 0, "accessors");
    const bool held = accessor.is_object() && accessor.contains("bufferView");
    if (!held && count > most_zeros) fail("'count' in 'accessors' exceeds the buffers");
    const double component = size_of_component(accessor, "accessors");
    const double size = component * components(accessor);
    if (held) check_reach(accessor, count, size);
    if (!accessor.is_object() || !accessor.contains("sparse") || !accessor["sparse"].is_object()) return;
    const Json& sparse = accessor["sparse"];
    const double changed = whole(sparse, "count", 0, "sparse");
    if (changed > count) fail("a sparse accessor changes more than it has");
    if (!sparse.contains("indices") || !sparse.contains("values"))
      fail("a sparse accessor lacks its indices or values");
    check_reach(sparse["indices"], changed, size_of_component(sparse["indices"], "sparse"));
    check_reach(sparse["values"], changed, size);
  }

  /// Positions are floats in threes, indices whole numbers, and all of it is plain to read.
  void check_primitive(const Json& primitive) const {
    if (!primitive.is_object()) fail("a primitive is no object");
    if (primitive.contains("extensions") && primitive["extensions"].is_object() &&
        primitive["extensions"].contains("KHR_draco_mesh_compression"))
      fail("its meshes are compressed by Draco: save them without");
    if (primitive.contains("attributes") && primitive["attributes"].is_object() &&
        primitive["attributes"].contains("POSITION"))
      require_type(primitive["attributes"]["POSITION"], "VEC3", {5126}, "positions are not floats in threes");
    if (primitive.contains("indices"))
      require_type(primitive["indices"], "SCALAR", {5121, 5123, 5125}, "indices are not whole numbers");
  }

  void require_type(const Json& index, const char* type, const std::vector<int>& components,
                    const char* complaint) const {
    const auto accessors = list_of(root_, "accessors");
    if (!index.is_number_unsigned() || index.get<std::uint64_t>() >= accessors.size())
      fail("a primitive names an accessor that does not exist");
    const Json& accessor = *accessors[index.get<std::size_t>()];
    const int component = accessor["componentType"].get<int>();  // known: every accessor has been checked
    if (accessor["type"] != type || std::find(components.begin(), components.end(), component) == components.end())
      fail(complaint);
  }

  void check_reach(const Json& place, double count, double size) const {
    const double view = whole(place, "bufferView", 0, "accessors"), offset = whole(place, "byteOffset", 0, "accessors");
    if (!(view < static_cast<double>(views_.size()))) fail("an accessor names a buffer view that does not exist");
    const View& v = views_[static_cast<std::size_t>(view)];
    const double stride = v.stride > 0 ? v.stride : size;
    if (count > 0 && offset + (count - 1) * stride + size > v.length)
      fail("an accessor reaches beyond its buffer view");
  }

  double size_of_component(const Json& accessor, const char* list) const {
    static const std::map<double, double> sizes{{5120, 1}, {5121, 1}, {5122, 2}, {5123, 2}, {5125, 4}, {5126, 4}};
    const auto at = sizes.find(whole(accessor, "componentType", 0, list));
    if (at == sizes.end()) fail("an accessor has no known 'componentType'");
    return at->second;
  }

  double components(const Json& accessor) const {
    static const std::map<std::string, double> counts{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                                                      {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
    if (accessor.contains("type") && accessor["type"].is_string())
      if (const auto at = counts.find(accessor["type"].get<std::string>()); at != counts.end()) return at->second;
    fail("an accessor has no known 'type'");
  }

  std::vector<std::size_t> children_of(const std::vector<const Json*>& nodes, std::size_t n) const {
    std::vector<std::size_t> out;
    for (const Json* child : list_of(*nodes[n], "children")) {
      if (!child->is_number_unsigned() || child->get<std::uint64_t>() >= nodes.size())
        fail(core::format("node %zu has a child that does not exist", n));
      out.push_back(child->get<std::size_t>());
    }
    return out;
  }

  /// No node may hold itself: each is entered once, from above.
  void require_node_tree() const {
    const auto nodes = list_of(root_, "nodes");
    std::vector<std::size_t> parents(nodes.size(), 0), level, next;
    for (std::size_t n = 0; n < nodes.size(); ++n)
      for (const std::size_t child : children_of(nodes, n))
        if (++parents[child] > 1) fail(core::format("node %zu is held by two others", child));
    for (std::size_t n = 0; n < nodes.size(); ++n)
      if (parents[n] == 0) level.push_back(n);
    std::size_t reached = 0, depth = 0;
    for (; !level.empty(); level.swap(next), next.clear()) {
      if (++depth > deepest_nodes) fail(core::format("nodes are nested deeper than %zu", deepest_nodes));
      reached += level.size();
      for (const std::size_t n : level)
        for (const std::size_t child : children_of(nodes, n)) next.push_back(child);
    }
    if (reached != nodes.size()) fail("nodes hold each other in a ring");
  }

  /// Triangles of all primitives; nothing where one is no plain list of them.
  std::optional<std::size_t> promised_triangles() const {
    constexpr int triangle_list = 4;
    const auto accessors = list_of(root_, "accessors");
    const auto corners_of = [&](const Json& object, const char* key) -> std::optional<std::size_t> {
      if (!object.is_object() || !object.contains(key) || !object[key].is_number_unsigned()) return std::nullopt;
      const auto index = object[key].get<std::size_t>();
      if (index >= accessors.size()) return std::nullopt;
      return static_cast<std::size_t>(whole(*accessors[index], "count", 0, "accessors"));
    };
    std::size_t sum = 0;
    for (const Json* mesh : list_of(root_, "meshes"))
      for (const Json* primitive : list_of(*mesh, "primitives")) {
        const Json& p = *primitive;
        if (!p.is_object() || (p.contains("mode") && p["mode"] != triangle_list)) return std::nullopt;
        const auto corners = p.contains("indices")      ? corners_of(p, "indices")
                             : p.contains("attributes") ? corners_of(p["attributes"], "POSITION")
                                                        : std::nullopt;
        if (!corners) return std::nullopt;
        sum += *corners / 3;
      }
    return sum;
  }

  struct View {
    double length, stride;  ///< [bytes]; stride 0: packed
  };

  const Json& root_;
  std::size_t binary_;
  std::filesystem::path folder_;
  const std::string& shown_;
  std::vector<double> buffers_;
  std::vector<View> views_;
};

Json parse(std::string_view text, const std::string& shown) {
  const auto shallow = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > deepest_text) throw core::InputError(shown, core::format("nested deeper than %d levels", deepest_text));
    return true;
  };
  try {
    return Json::parse(text, shallow);
  } catch (const Json::exception& e) {
    throw core::InputError(shown, core::single_line(e.what()).substr(0, 200));
  }
}

}  // namespace

GuardedFile guarded_gltf(const std::string& bytes, const std::filesystem::path& file, const std::string& shown) {
  const bool is_glb = bytes.starts_with("glTF");
  const auto [text, binary] = is_glb ? glb_parts(bytes, shown) : GlbParts{bytes, {}};
  require_text(text, shown);
  const Json root = parse(text, shown);
  if (!root.is_object()) throw core::InputError(shown, "a JSON object is expected");
  const auto faces = GltfGuard(root, binary.size(), file.parent_path(), shown).run();
  const std::string kept = shapes_of(root).dump(-1, ' ', true, Json::error_handler_t::replace);
  return {is_glb ? glb_bytes(kept, binary) : kept, faces};
}

}  // namespace interflect::scene::io
