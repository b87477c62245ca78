#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/format.h"
#include "scene/io/assimp_guard.h"
#include "scene/io/text_file.h"

namespace interflect::scene::io {
namespace {

/// Walks through a text from "solid" to "endsolid".  What assimp does not expect is put straight: people write keywords
/// in capitals, and names of several words, which may be keywords.
class StlText {
 public:
  StlText(std::string& text, const std::string& shown) : text_(text), shown_(shown) {}

  /// Number of facets, all of them whole.
  std::size_t run() {
    while (next_word()) {
      if (!in_solid_) {  // what stands between solids is not for us
        if (word_is("solid")) begin_solid();
      } else if (word_is("facet")) {
        begin_facet();
      } else if (word_is("vertex")) {
        read_vertex();
      } else if (word_is("endloop") || word_is("endfacet")) {
        end_facet();
      } else if (word_is("endsolid") || is_end_solid_in_two_words()) {
        end_solid();
      } else {
        word_is("normal");
      }
    }
    if (in_facet_) fail("the file ends within a facet");
    if (in_solid_) fail("the file ends within the solid '" + shown_word(solid_) + "': 'endsolid' is expected");
    return facets_;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw core::InputError(core::format("%s:%zu", shown_.c_str(), line_), message);
  }

  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

  bool next_word() {
    for (; end_ < text_.size() && is_blank(text_[end_]); ++end_) line_ += text_[end_] == '\n';
    start_ = end_;
    while (end_ < text_.size() && !is_blank(text_[end_])) ++end_;
    return start_ < end_;
  }
  std::string_view word() const { return std::string_view(text_).substr(start_, end_ - start_); }

  bool word_is(const char* keyword) {
    if (core::lower_case(std::string(word())) != keyword) return false;
    text_.replace(start_, end_ - start_, keyword);
    return true;
  }

  bool is_end_solid_in_two_words() {
    if (core::lower_case(std::string(word())) != "end") return false;
    const std::size_t next = text_.find_first_not_of(" \t", end_);
    return next < text_.size() && core::lower_case(text_.substr(next, 5)) == "solid";
  }

  /// What stands behind the word in its line: names have blanks in them, and may be keywords.
  std::string rest_of_line() {
    const std::size_t from = end_;
    end_ = std::min(text_.find('\n', from), text_.size());
    std::string rest = one_line(std::string_view(text_).substr(from, end_ - from));
    return rest.erase(0, rest.find_first_not_of(' '));
  }

  void begin_solid() {
    in_solid_ = true;
    std::size_t at = end_;
    solid_ = rest_of_line();
    while (at < end_ && is_blank(text_[at])) ++at;
    while (at < end_ && !is_blank(text_[at])) ++at;  // assimp takes the first word of the name
    std::fill(text_.begin() + static_cast<std::ptrdiff_t>(at), text_.begin() + static_cast<std::ptrdiff_t>(end_), ' ');
  }

  void end_solid() {
    if (in_facet_) fail("the solid ends within a facet");
    in_solid_ = false;
    rest_of_line();
  }

  void begin_facet() {
    if (in_facet_) fail("a facet begins within another");
    in_facet_ = true;
    corners_ = 0;
    ++facets_;
  }

  void end_facet() {
    if (in_facet_ && corners_ != 3) fail(core::format("a facet has three corners, not %zu", corners_));
    in_facet_ = in_facet_ && !word_is("endfacet");
  }

  void read_vertex() {
    ++corners_;
    const std::size_t line = line_;
    for (int axis = 0; axis < 3; ++axis) {
      if (next_word() && std::string_view("+-.0123456789nNiI").find(text_[start_]) != std::string_view::npos) continue;
      line_ = line;
      fail("a vertex has three coordinates");
    }
  }

  std::string& text_;
  const std::string& shown_;
  std::size_t start_ = 0, end_ = 0, line_ = 1;  ///< of the word: where it is, and its line
  std::string solid_;
  bool in_solid_ = false, in_facet_ = false;
  std::size_t corners_ = 0, facets_ = 0;
};

}  // namespace

/// 80 bytes, a count, 50 bytes a triangle; or text that begins with "solid", which binary files do too.
GuardedFile guarded_stl(std::string bytes, const std::string& shown) {
  constexpr std::size_t head = 84, each = 50;
  const bool solid = core::lower_case(bytes.substr(0, 5)) == "solid";
  if (bytes.size() < head && !solid)
    throw core::InputError(shown, core::format("%zu bytes are too few for an STL file", bytes.size()));
  const std::size_t triangles = bytes.size() < head ? 0 : little_endian(bytes, 80);
  const bool exact = bytes.size() >= head && bytes.size() == head + each * triangles;
  const bool facets = bytes.size() < head || core::lower_case(bytes).find("facet") != std::string::npos;
  if (solid && facets && !exact) {
    const std::size_t count = StlText(bytes, shown).run();
    return {std::move(bytes), count};
  }
  if (triangles <= (bytes.size() - head) / each) return {std::move(bytes), triangles};
  throw core::InputError(shown,
                         core::format("the header promises %zu triangles, in %zu bytes", triangles, bytes.size()));
}

}  // namespace interflect::scene::io
