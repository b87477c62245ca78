#include "visual/outlines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace interflect::visual {

namespace {

using results::Colour;

constexpr std::pair<int, int> beside[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};

bool is_back(const Samples& samples, int x, int y) {
  return samples.holds(x, y) && samples.faces[samples.place(x, y)] == Samples::back;
}

/// Of 2 x 2 samples of backs, in any of four places.
bool in_a_block_of_backs(const Samples& samples, int x, int y) {
  for (int dx : {-1, 1})
    for (int dy : {-1, 1})
      if (is_back(samples, x + dx, y) && is_back(samples, x, y + dy) && is_back(samples, x + dx, y + dy)) return true;
  return false;
}

double lightness(const Colour& c) { return (0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2]) / 255; }

enum class Ink : std::uint8_t { none, dark, light };

class Lines {
 public:
  Lines(const Samples& samples, int reach, int enough)
      : samples_(samples), reach_(reach), enough_(enough), ink_(samples.colours.size(), Ink::none) {}

  /// Where neighbours differ: in their faces, or in the clear bodies of one list.  A line between two faces has one ink
  /// over a part of the picture, by what it is on there: chosen sample by sample it would be dashed.
  template <class Number>
  void mark(const std::vector<Number>& faces) {
    struct Mean {
      double lightness = 0;
      int samples = 0;
    };
    std::map<std::tuple<Number, Number, int>, Mean> means;
    const auto mean_at = [&](int x, int y, std::size_t a, std::size_t b) -> Mean& {
      const auto [low, high] = std::minmax(faces[a], faces[b]);
      return means[{low, high, part_of(x, y)}];
    };
    for_ends(faces, [&](int x, int y, int dx, int dy) {
      const std::size_t a = samples_.place(x, y), b = samples_.place(x + dx, y + dy);
      Mean& mean = mean_at(x, y, a, b);
      mean.lightness += 0.5 * (lightness(samples_.colours[a]) + lightness(samples_.colours[b]));
      ++mean.samples;
    });
    for_ends(faces, [&](int x, int y, int dx, int dy) {
      const Mean& mean = mean_at(x, y, samples_.place(x, y), samples_.place(x + dx, y + dy));
      draw(x, y, dx, dy, mean.lightness < 0.2 * mean.samples ? Ink::light : Ink::dark);
    });
  }
  const std::vector<Ink>& ink() const { return ink_; }

 private:
  /// Of so many by so many.
  int part_of(int x, int y) const {
    constexpr int parts = 6;
    return parts * (parts * y / samples_.height) + parts * x / samples_.width;
  }

  /// Between each sample and the one at its right or below it, if one face ends there and another begins.
  template <class Number, class Act>
  void for_ends(const std::vector<Number>& faces, const Act& act) const {
    std::unordered_map<Number, int> size;
    for (const Number face : faces) ++size[face];
    const auto ends = [&](std::size_t a, std::size_t b) {
      return faces[a] != faces[b] && size.at(faces[a]) >= enough_ && size.at(faces[b]) >= enough_;
    };
    for (int y = 0; y < samples_.height; ++y)
      for (int x = 0; x < samples_.width; ++x)
        for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}})
          if (samples_.holds(x + dx, y + dy) && ends(samples_.place(x, y), samples_.place(x + dx, y + dy)))
            act(x, y, dx, dy);
  }

  void draw(int x, int y, int dx, int dy, Ink ink) {
    for (int k = 1 - reach_; k <= reach_; ++k)
      if (samples_.holds(x + k * dx, y + k * dy)) ink_[samples_.place(x + k * dx, y + k * dy)] = ink;
  }

  const Samples& samples_;
  int reach_, enough_;
  std::vector<Ink> ink_;
};

}  // namespace

int Samples::clear_bodies(std::size_t place) const {
  return static_cast<int>(std::ranges::count_if(clear, [&](const auto& bodies) { return bodies[place] != 0; }));
}

void leave_out_specks(Samples& samples) {
  const Samples before = samples;
  for (int y = 0; y < samples.height; ++y)
    for (int x = 0; x < samples.width; ++x) {
      if (!is_back(before, x, y) || in_a_block_of_backs(before, x, y)) continue;
      for (const auto& [dx, dy] : beside) {
        if (!before.holds(x + dx, y + dy) || is_back(before, x + dx, y + dy)) continue;
        samples.colours[samples.place(x, y)] = before.colours[before.place(x + dx, y + dy)];
        samples.faces[samples.place(x, y)] = before.faces[before.place(x + dx, y + dy)];
        break;
      }
    }
}

void draw_outlines(Samples& samples, int reach, int enough, bool of_faces) {
  Lines lines(samples, reach, enough);
  if (of_faces) lines.mark(samples.faces);
  for (const std::vector<std::uint8_t>& bodies : samples.clear) lines.mark(bodies);
  constexpr double part = 0.6;  // of a line's own colour
  for (std::size_t i = 0; i < samples.colours.size(); ++i) {
    if (lines.ink()[i] == Ink::none) continue;
    const double to = lines.ink()[i] == Ink::light ? 255 : 0;
    for (std::uint8_t& c : samples.colours[i]) c = static_cast<std::uint8_t>(std::lround(c + part * (to - c)));
  }
}

}  // namespace interflect::visual
