#include "visual/outlines.h"

#include <array>
#include <cmath>
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
      : samples_(samples), reach_(reach), enough_(enough), ink_(samples.colours.size(), Ink::none) {
    for (std::uint32_t face : samples.faces) ++size_[face];
  }

  /// Between a sample and the one at its right or below it.
  void mark(int x, int y, int dx, int dy) {
    const std::size_t a = samples_.place(x, y), b = samples_.place(x + dx, y + dy);
    if (samples_.faces[a] == samples_.faces[b] || small(a) || small(b)) return;
    const double mean = 0.5 * (lightness(samples_.colours[a]) + lightness(samples_.colours[b]));
    for (int k = 1 - reach_; k <= reach_; ++k)
      if (samples_.holds(x + k * dx, y + k * dy))
        ink_[samples_.place(x + k * dx, y + k * dy)] = mean < 0.2 ? Ink::light : Ink::dark;
  }
  const std::vector<Ink>& ink() const { return ink_; }

 private:
  bool small(std::size_t place) const { return size_.at(samples_.faces[place]) < enough_; }

  const Samples& samples_;
  int reach_, enough_;
  std::unordered_map<std::uint32_t, int> size_;
  std::vector<Ink> ink_;
};

}  // namespace

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

void draw_outlines(Samples& samples, int reach, int enough) {
  Lines lines(samples, reach, enough);
  for (int y = 0; y < samples.height; ++y)
    for (int x = 0; x < samples.width; ++x) {
      if (x + 1 < samples.width) lines.mark(x, y, 1, 0);
      if (y + 1 < samples.height) lines.mark(x, y, 0, 1);
    }
  constexpr double part = 0.6;  // of a line's own colour
  for (std::size_t i = 0; i < samples.colours.size(); ++i) {
    if (lines.ink()[i] == Ink::none) continue;
    const double to = lines.ink()[i] == Ink::light ? 255 : 0;
    for (std::uint8_t& c : samples.colours[i]) c = static_cast<std::uint8_t>(std::lround(c + part * (to - c)));
  }
}

}  // namespace interflect::visual
