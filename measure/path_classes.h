#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace interflect::measure {

/// What a path of light is made of [Heckbert 1990]: where it starts, how it is scattered, where it ends.  What passes
/// straight on through panes and nets is not scattered there.
enum class PathLetter : std::uint8_t {
  area,      ///< A: a light that has an area: surfaces, balls
  point,     ///< P: a light that has none: points and spots
  far,       ///< F: a light from afar that has an extent in the sky: the sun, the sky
  beam,      ///< B: one that has none: a sun without an angle, parallel light
  diffuse,   ///< D: by a diffuse surface
  glossy,    ///< G: by one that favours directions, and none alone
  specular,  ///< S: by a mirror or a smooth boundary, into a direction of its own
  eye        ///< E: a patch, a point, or a pixel, that is measured
};
inline constexpr std::size_t path_letters = 8;

/// A set of paths by a regular expression of those letters, from the light to the eye; `L` is any light, `.` any
/// scattering: `L.*E` are all paths, `LD*E` what radiosity finds, `LD?S*E` what Whitted's ray tracing does.
///
/// A finite automaton of at most 64 states, which a walk from the light runs forwards, one state, and a walk from the
/// eye backwards, the set of states from which the rest is accepted; where two walks are joined the one has to be in the
/// other.  Test: tests/measure/path_classes.cpp
class PathClasses {
 public:
  /// @throws core::InputError  with the place in the expression, or if it needs more states
  static PathClasses of(const std::string& expression);
  static PathClasses all() { return of("L.*E"); }

  bool empty() const { return shortest().empty(); }
  /// One of the shortest paths, `PSDE`; empty if there is none.
  std::string shortest() const;
  bool contains(const std::string& path) const;  ///< letters as in `shortest`
  /// As it was written.
  const std::string& expression() const { return expression_; }

  /// Paths that both have.
  friend PathClasses operator&(const PathClasses& a, const PathClasses& b) { return combined(a, b, true); }
  /// Paths that b has not.
  friend PathClasses operator-(const PathClasses& a, const PathClasses& b) { return combined(a, b, false); }
  friend bool operator==(const PathClasses& a, const PathClasses& b) { return (a - b).empty() && (b - a).empty(); }

  using FromLight = std::uint8_t;
  using FromEye = std::uint64_t;
  FromLight before_light() const { return 0; }
  FromLight after(FromLight walk, PathLetter letter) const { return next_[walk][static_cast<std::size_t>(letter)]; }
  FromEye before_eye() const { return accepting_; }
  FromEye after(FromEye walk, PathLetter letter) const;
  /// The path is one of these.
  static bool joined(FromLight light, FromEye eye) { return (eye >> light & 1) != 0; }
  /// A walk from the eye that has got to its light.
  static bool complete(FromEye eye) { return joined(0, eye); }
  /// No path of these goes on so.
  static bool hopeless(FromEye eye) { return eye == 0; }

 private:
  using Row = std::array<std::uint8_t, path_letters>;
  static PathClasses combined(const PathClasses& a, const PathClasses& b, bool with_b);
  static PathClasses smallest(std::vector<Row> next, std::vector<bool> accepting, std::string expression);
  friend class PathExpression;

  std::vector<Row> next_;  ///< [state][letter]; states from 0, where all begins
  FromEye accepting_ = 0;
  std::string expression_;
};

}  // namespace interflect::measure
