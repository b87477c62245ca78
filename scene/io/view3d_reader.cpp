#include "scene/io/view3d_reader.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/error.h"
#include "core/format.h"
#include "scene/io/placement.h"
#include "scene/io/text_file.h"

namespace interflect::scene::io {
namespace {

using Kind = View3dSurface::Kind;

struct Line {
  int number = 0;
  std::vector<std::string_view> words;
};

/// Lines with words in them: blanks, tabs and commas between them, comments left out.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  std::optional<Line> next() {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      Line line{++number_, split(rest_.substr(0, end))};
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      if (!line.words.empty() && line.words[0][0] != '/') return line;
    }
    return std::nullopt;
  }
  int number() const { return number_; }

 private:
  static std::vector<std::string_view> split(std::string_view line) {
    constexpr const char* between = " \t\r,";
    std::vector<std::string_view> words;
    for (std::size_t at = line.find_first_not_of(between); at != std::string_view::npos && line[at] != '!';) {
      const std::size_t end = std::min(line.find_first_of(between, at), line.size());
      words.push_back(line.substr(at, end - at));
      at = line.find_first_not_of(between, end);
    }
    return words;
  }

  std::string_view rest_;
  int number_ = 0;
};

class View3dReader {
 public:
  View3dReader(std::string_view text, const std::string& shown) : lines_(text), shown_(shown) {}

  std::vector<View3dSurface> run() {
    bool ended = false;
    while (const auto line = ended ? std::nullopt : lines_.next()) {
      line_ = *line;
      at_ = 0;
      const char key = static_cast<char>(std::toupper(static_cast<unsigned char>(word("a key")[0])));
      ended = key == 'E' || key == '*';
      if (ended || key == 'T' || key == 'C' || key == 'X') continue;
      read(key);
    }
    if (surfaces_.empty()) throw core::InputError(shown_, "the file has no surfaces");
    if (!ended) fail_at(lines_.number(), "the file ends without a line 'End of data': it may have been cut short");
    for (std::size_t k = 0; k < surfaces_.size(); ++k) check(k + 1);
    return std::move(surfaces_);
  }

 private:
  struct Corners {
    std::vector<std::size_t> vertex;  ///< numbers, from 1
  };

  void read(char key) {
    switch (key) {
      case 'F':
        return read_format();
      case 'V':
        return read_vertex();
      case 'S':
        return read_surface(Kind::radiating);
      case 'M':
        return read_surface(Kind::mask);
      case 'N':
        return read_surface(Kind::null);
      case 'O':
        return read_surface(Kind::obstruction);
      default:
        fail("the key '" + shown_word(line_.words[0]) +
             "' is not known: one of T, C, F, V, S, M, N, O, X, E is expected");
    }
  }

  [[noreturn]] void fail_at(int line, const std::string& message) const {
    throw core::InputError(core::format("%s:%d", shown_.c_str(), line), message);
  }
  [[noreturn]] void fail(const std::string& message) const { fail_at(line_.number, message); }

  bool more() const { return at_ < line_.words.size(); }
  std::string_view word(const char* what) {
    if (!more()) fail(std::string("the line ends before ") + what);
    return line_.words[at_++];
  }

  std::size_t count(const char* what) {
    const std::string_view digits = word(what);
    std::uint32_t value = 0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || stop != digits.data() + digits.size())
      fail("'" + shown_word(digits) + "' is not " + what);
    return value;
  }

  double number(const char* what) {
    const std::string_view given = word(what);
    const std::optional<double> value = number_of(given);
    if (!value || !std::isfinite(*value)) fail("'" + shown_word(given) + "' is not " + what);
    return *value;
  }

  void read_format() {
    const std::string format = core::lower_case(std::string(word("the format")));
    if (format != "3" && format != "3a")
      fail("the format '" + shown_word(format) + "' is not known: 3 or 3a is expected");
    if (!vertices_.empty() || !surfaces_.empty()) fail("the format comes before vertices and surfaces");
    by_vertices_ = format == "3";
  }

  void require_format() const {
    if (!by_vertices_) fail("a line 'F 3' or 'F 3a' is expected before vertices and surfaces");
  }

  void read_vertex() {
    require_format();
    if (!*by_vertices_) fail("the format 3a has no vertices");
    const std::size_t n = count("a vertex number");
    if (n != vertices_.size() + 1) fail(core::format("vertex %zu is expected here, not %zu", vertices_.size() + 1, n));
    const double x = number("a coordinate"), y = number("a coordinate"), z = number("a coordinate");
    vertices_.emplace_back(x, y, z);
  }

  void read_surface(Kind kind) {
    require_format();
    View3dSurface surface;
    surface.kind = kind;
    surface.line = line_.number;
    const std::size_t n = count("a surface number");
    if (n != surfaces_.size() + 1) fail(core::format("surface %zu is expected here, not %zu", surfaces_.size() + 1, n));
    Corners corners;
    char shape = 0;
    if (*by_vertices_)
      corners = read_corners();
    else
      shape = read_shape();
    read_role(surface, n);
    if (!*by_vertices_) surface.ring = read_plane(shape);
    surfaces_.push_back(std::move(surface));
    corners_.push_back(std::move(corners));
  }

  Corners read_corners() {
    Corners corners;
    for (int k = 0; k < 4; ++k)
      corners.vertex.push_back(count("a vertex number (of four: 0 as the last of a triangle)"));
    if (corners.vertex[3] == 0) corners.vertex.pop_back();
    return corners;
  }

  char read_shape() {
    const std::string_view given = word("the shape");
    const char shape = static_cast<char>(std::toupper(static_cast<unsigned char>(given[0])));
    if (shape != 'R' && shape != 'Q' && shape != 'T')
      fail("the shape '" + shown_word(given) +
           "' is not known: R (rectangle), Q (quadrilateral) or T (triangle) is expected");
    return shape;
  }

  /// Base, combination, emittance and name; an obstruction may leave them out, and its name alone counts.
  void read_role(View3dSurface& surface, std::size_t n) {
    const bool obstruction = surface.kind == Kind::obstruction;
    if (!obstruction || more()) {
      surface.base = count("the number of a base surface");
      surface.combined_with = count("the number of a surface to combine with");
      surface.emittance = number("an emittance");
      if (!(surface.emittance >= 0 && surface.emittance <= 1)) fail("an emittance lies between 0 and 1");
    }
    if (obstruction) surface.base = surface.combined_with = 0;
    surface.name = more() ? one_line(word("a name")) : core::format("surface-%zu", n);
  }

  /// Format 3a: the plane's origin, azimuth and tilt, and the corners in it, on the next lines.
  geometry::Ring read_plane(char shape) {
    const std::size_t corners = shape == 'T' ? 3 : 4, all = 5 + (shape == 'R' ? 2 : 2 * corners);
    std::vector<double> v;
    while (v.size() < all) {
      if (v.size() >= 5 && more()) fail("the surface has more numbers than its shape");
      const auto line = lines_.next();
      if (!line) fail("the file ends within a surface");
      line_ = *line;
      at_ = 0;
      while (v.size() < all && more()) v.push_back(number("a number of the surface's plane"));
    }
    if (more()) fail("the surface has more numbers than its shape");
    const Vec3 origin(v[0], v[1], v[2]);
    const auto [ca, sa] = cosine_sine(v[3]);
    const auto [ct, st] = cosine_sine(v[4]);
    // Seen from the active side: to the right, and up.  The azimuth runs clockwise from y, a tilt of 0 looks to z.
    const Vec3 right(-ca, sa, 0), up(-sa * ct, -ca * ct, st);
    if (shape == 'R') return {origin + v[6] * up, origin, origin + v[5] * right, origin + v[5] * right + v[6] * up};
    geometry::Ring ring;
    for (std::size_t k = 0; k < corners; ++k) ring.emplace_back(origin + v[5 + 2 * k] * right + v[6 + 2 * k] * up);
    return ring;
  }

  /// What can be told when all is there: surfaces may come before what they refer to.
  void check(std::size_t n) {
    View3dSurface& s = surfaces_[n - 1];
    const std::size_t all = surfaces_.size();
    for (const std::size_t vertex : corners_[n - 1].vertex) {
      if (vertex == 0 || vertex > vertices_.size())
        fail_at(s.line,
                core::format("surface %zu refers to vertex %zu, and there are %zu", n, vertex, vertices_.size()));
      s.ring.push_back(vertices_[vertex - 1]);
    }
    const bool covers = s.kind == Kind::mask || s.kind == Kind::null;
    if (covers && s.base == 0) fail_at(s.line, core::format("surface %zu needs a base surface, which it covers", n));
    if (s.base != 0) {
      const bool good =
          s.base <= all && s.base != n && (s.base < n || (!covers && surfaces_[s.base - 1].kind == Kind::obstruction));
      if (!good || surfaces_[s.base - 1].kind == Kind::mask || surfaces_[s.base - 1].kind == Kind::null)
        fail_at(s.line, core::format("surface %zu cannot have surface %zu as its base", n, s.base));
    }
    if (s.combined_with == 0) return;
    const bool good = s.combined_with < n && s.kind == Kind::radiating &&
                      surfaces_[s.combined_with - 1].kind == Kind::radiating &&
                      surfaces_[s.combined_with - 1].combined_with == 0;
    if (!good) fail_at(s.line, core::format("surface %zu cannot be combined with surface %zu", n, s.combined_with));
  }

  Lines lines_;
  const std::string& shown_;
  Line line_;
  std::size_t at_ = 0;  ///< the next word of the line
  std::optional<bool> by_vertices_;
  std::vector<Vec3> vertices_;
  std::vector<View3dSurface> surfaces_;
  std::vector<Corners> corners_;
};

}  // namespace

std::vector<View3dSurface> read_view3d(const std::filesystem::path& file, const std::string& shown) {
  const std::string text = read_bytes(file, shown);
  require_text(text, shown);
  return View3dReader(without_byte_order_mark(text), shown).run();
}

}  // namespace interflect::scene::io
