// Wavefront OBJ through tinyobjloader, which knows the grammar.  Numbers and indices are checked here: the library
// takes what it cannot read for 0, and its decimals are not rounded correctly.
#define TINYOBJLOADER_USE_DOUBLE
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <span>
#include <streambuf>

#include "core/error.h"
#include "core/format.h"
#include "scene/io/mesh_reader.h"
#include "scene/io/text_file.h"

namespace interflect::scene::io {
namespace {

/// A stream over text that tells where it is.
class TextBuffer : public std::streambuf {
 public:
  explicit TextBuffer(std::string& text) { setg(text.data(), text.data(), text.data() + text.size()); }
  std::size_t position() const { return static_cast<std::size_t>(gptr() - eback()); }
};

/// The text with nothing in it that the library stumbles over, byte for byte in place: lone carriage returns end lines,
/// a backslash before a line's end continues it, and comments behind vertices and faces are blanks.
std::string plain_lines(std::string text) {
  for (std::size_t k = 0; k < text.size(); ++k)
    if (text[k] == '\r') text[k] = k + 1 < text.size() && text[k + 1] == '\n' ? ' ' : '\n';
  for (std::size_t at = text.find('\\'); at != std::string::npos; at = text.find('\\', at + 1)) {
    const std::size_t next = text.find_first_not_of(' ', at + 1);
    if (next == std::string::npos || text[next] != '\n') continue;
    text[at] = text[next] = ' ';
  }
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::size_t first = text.find_first_not_of(" \t", start);
    if (first < end && (text[first] == 'v' || text[first] == 'f'))
      if (const std::size_t comment = text.find('#', first); comment < end)
        std::fill(text.begin() + static_cast<std::ptrdiff_t>(comment), text.begin() + static_cast<std::ptrdiff_t>(end),
                  ' ');
    start = end + 1;
  }
  return text;
}

/// Where the first line is that has the key of a face and nothing behind it: the library passes it over.
std::size_t lone_face_key(std::string_view text) {
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::string_view line = text.substr(start, end - start);
    const std::size_t key = line.find_first_not_of(" \t");
    if (key != std::string_view::npos && line[key] == 'f' &&
        line.find_first_not_of(" \t", key + 1) == std::string_view::npos)
      return start;
    start = end + 1;
  }
  return std::string_view::npos;
}

/// What each line that begins with "mtllib" says behind that.
std::vector<std::string> material_files(std::string_view text) {
  constexpr std::string_view key = "mtllib";
  std::vector<std::string> out;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::string_view line = trimmed(text.substr(start, end - start));
    start = end + 1;
    if (line.size() <= key.size() || !line.starts_with(key)) continue;
    if (line[key.size()] == ' ' || line[key.size()] == '\t') out.emplace_back(trimmed(line.substr(key.size())));
  }
  return out;
}

std::string too_few(std::size_t corners) { return core::format("a face has three corners or more, not %zu", corners); }

class ObjBuilder {
 public:
  ObjBuilder(std::string text, std::string shown)
      : original_(std::move(text)), text_(plain_lines(original_)), shown_(std::move(shown)), buffer_(text_) {}

  MeshFile build() {
    const std::size_t lone = lone_face_key(text_);
    std::istream stream(&buffer_);
    tinyobj::callback_t callbacks;
    callbacks.vertex_cb = [](void* self, double, double, double, double) { static_cast<ObjBuilder*>(self)->vertex(); };
    callbacks.index_cb = [](void* self, tinyobj::index_t* corner, int count) {
      static_cast<ObjBuilder*>(self)->face({corner, static_cast<std::size_t>(count)});
    };
    callbacks.usemtl_cb = [](void* self, const char* name, int) {
      static_cast<ObjBuilder*>(self)->material_ = core::single_line(name);
    };
    callbacks.object_cb = [](void* self, const char* name) {
      static_cast<ObjBuilder*>(self)->group_ = core::single_line(name);
    };
    callbacks.group_cb = [](void* self, const char** names, int count) {
      static_cast<ObjBuilder*>(self)->group({names, static_cast<std::size_t>(count)});
    };
    tinyobj::LoadObjWithCallback(stream, callbacks, this);
    if (lone != std::string::npos) fail_at(lone, too_few(0));
    mesh_.groups = groups_.names();
    mesh_.materials = materials_.names();
    mesh_.material_files = material_files(text_);
    return std::move(mesh_);
  }

 private:
  /// The line that the library has just read, without its key.
  std::string_view line() const {
    const std::string_view text(text_);
    std::size_t end = buffer_.position();
    if (end > 0 && text[end - 1] == '\n') --end;
    const std::size_t before = end == 0 ? std::string_view::npos : text.rfind('\n', end - 1);
    return text.substr(before + 1, end - before - 1);  // npos + 1 is 0
  }

  [[noreturn]] void fail_at(std::size_t start, const std::string& message) const {
    const auto before = original_.begin() + static_cast<std::ptrdiff_t>(start);
    const auto number = 1 + std::count(original_.begin(), before, '\n');
    throw core::InputError(core::format("%s:%td", shown_.c_str(), number), message);
  }
  [[noreturn]] void fail(const std::string& message) const {
    fail_at(static_cast<std::size_t>(line().data() - text_.data()), message);
  }

  double coordinate(std::string_view& rest) const {
    const std::size_t start = rest.find_first_not_of(" \t");
    if (start == std::string_view::npos) fail("a vertex has three coordinates");
    const std::size_t end = std::min(rest.find_first_of(" \t", start), rest.size());
    std::string_view word = rest.substr(start, end - start);
    rest.remove_prefix(end);
    const std::optional<double> value = number_of(word);
    if (!value) fail("'" + shown_word(word) + "' is not a coordinate");
    if (!std::isfinite(*value)) fail("the coordinate '" + shown_word(word) + "' is not finite");
    return *value;
  }

  void vertex() {
    std::string_view rest = line();
    rest.remove_prefix(rest.find('v') + 1);
    const double x = coordinate(rest), y = coordinate(rest), z = coordinate(rest);
    mesh_.vertices.emplace_back(x, y, z);
  }

  void face(std::span<const tinyobj::index_t> corners) {
    if (corners.size() < 3) fail(too_few(corners.size()));
    require_short_numbers();
    const auto count = static_cast<std::int64_t>(mesh_.vertices.size());
    const auto first = static_cast<std::uint32_t>(mesh_.indices.size());
    for (const tinyobj::index_t& corner : corners) {
      const std::int64_t given = corner.vertex_index;  // from 1; negative: back from the latest vertex
      if (given == 0) fail("a face has an index that is 0 or no number: they start at 1");
      const std::int64_t index = given > 0 ? given - 1 : count + given;
      if (index < 0 || index >= count)
        fail(core::format("a face refers to vertex %td, and %td are defined so far", static_cast<std::ptrdiff_t>(given),
                          static_cast<std::ptrdiff_t>(count)));
      mesh_.indices.push_back(static_cast<std::uint32_t>(index));
    }
    mesh_.faces.push_back(
        {first, static_cast<std::uint32_t>(corners.size()), groups_.index_of(group_), materials_.index_of(material_)});
  }

  /// The library's integers overflow silently.
  void require_short_numbers() const {
    std::size_t digits = 0;
    for (const char c : line()) {
      digits = c >= '0' && c <= '9' ? digits + 1 : 0;
      if (digits > 9) fail("a face has an index beyond a thousand million");
    }
  }

  void group(std::span<const char* const> names) {
    group_.clear();
    for (const char* name : names) {
      if (!group_.empty()) group_ += ' ';
      group_ += core::single_line(name);
    }
  }

  const std::string original_;
  std::string text_;
  std::string shown_;
  TextBuffer buffer_;
  MeshFile mesh_;
  NameList groups_, materials_;
  std::string group_, material_;
};

}  // namespace

MeshFile read_obj(const std::filesystem::path& file, const std::string& shown) {
  std::string text = read_bytes(file, shown);
  require_text(text, shown);
  return ObjBuilder(std::string(without_byte_order_mark(text)), shown).build();
}

}  // namespace interflect::scene::io
