#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "fem/form_factor/adaptive_lambert.h"
#include "fem/form_factor/element_shapes.h"
#include "fem/form_factor/shadow_events.h"
#include "geometry/convex_blocker.h"
#include "geometry/hidden_part.h"
#include "geometry/union_corners.h"

namespace interflect::fem {

/// What blockers take from an exchange, and what its error is estimated to be at most [m²].
template <class Value>
struct HiddenIntegralOf {
  Value value{};
  double error = 0;
  bool all = false;  ///< one blocker hides all of the other element from wherever one is
};
using HiddenIntegral = HiddenIntegralOf<double>;

/// What blockers take from the exchange of two elements, after [Nishita, Nakamae 1985]: from a point of one the hidden
/// part of the other is known exactly, as polygons, and Lambert's formula gives their form factor; that is integrated
/// over the first,
///
///   K_hidden = int_{outer} F_{dA -> hidden part of inner} dA  [m²],    K = K_unoccluded - K_hidden.
///
/// The outer element is cut along the lines where the shadow changes its form (ShadowEvents).  On what lies between,
/// the integrand is smooth, and a ladder of rules is climbed: with values v_0, v_1, .. (1, 3, 6, .. nodes) of rules of
/// degree d_0, d_1, .. and q = radius of the cell / its distance from the edges that shape the shadow, the error of v_l
/// is taken for
///
///   c q |v_l - v_{l-1}| + 0.2 q^{d_l + 1} v_l   where q <= 1/2,    max(min(1, c q) |v_l - v_{l-1}|, |v_l - w|)   else
///
/// the error of the step before, of which a step leaves what is one order higher, and what is typical, since a
/// difference may be small by chance; w is of a rule with nodes near the corners and sides, for what no node of the
/// ladder sees.  (c = 1/2 on quads past one blocker, else 2: fitted, tests/fem/claimed_errors.cpp.  Without w, one in
/// seven of the cells that many lines cross was off by more than stated, by all of its value at worst.)  In a cell a
/// blocker hides nothing, all, or a part: what hides nothing or all of `inner` from the centroid does so from the whole
/// cell.  Where several hide parts each, kinks remain between the lines, across which what is seen past all of them
/// gains or loses corners, or has them on other shadows' edges.  A cell from whose middle, nodes, and from near whose
/// corners and middles of sides it has as many on each edge is taken for smooth.  One with a kink has q = 1 and twice
/// the error, and one that too many lines go through to be cut along them as many times as if all of it were as at a
/// corner where it is not as inside: a narrow strip that a line would have cut off may touch that corner alone; it is
/// cut along those lines that go through a corner of one blocker and an edge of another, and then in four (what is left
/// are surfaces of second degree, through three edges).  The cell with the largest error goes first, until the errors
/// sum to the tolerance.
///
/// What is integrated is a number or a small matrix, whose error is that of its worst entry:
///
///   Value, zero(), size(v)    as in adaptive_cells.h
///   at(x, parts)              the integrand at x, of parts of the inner element, convex and relative to x
///   at_whole(x, ring)         of all of it
///   degrees                   that its own polynomials take of a rule's
///
/// Not shared between threads: it holds the work's memory.
template <class Integrand>
class HiddenExchangeOf {
 public:
  using Value = typename Integrand::Value;

  /// @param rounding  of coordinates [m]
  explicit HiddenExchangeOf(double rounding) : events_(rounding), rounding_(rounding) {}

  /// @param outer, inner  each in front of the other's plane
  /// @param tolerance     [m²]
  /// @return  value, and an estimated bound on its error; that exceeds the tolerance only if 20 000 cells were not
  /// enough
  HiddenIntegralOf<Value> operator()(const ElementShape& outer, const ElementShape& inner, const Integrand& integrand,
                                     std::span<const geometry::ConvexBlocker* const> blockers, double tolerance);

  /// The integrand of the hidden part of inner at a point in front of its plane, for which that is in front of the
  /// horizon.
  Value hidden_at(const Vec3& x, const ElementShape& inner, const Integrand& integrand,
                  std::span<const geometry::ConvexBlocker* const> blockers);

  std::uint64_t points() const { return points_; }  ///< at which hidden parts were found, so far

 private:
  enum class Hides : std::uint8_t { none, all, part };
  /// Some of the first 64 shadows; of more, all.
  struct ShadowSet {
    std::uint64_t bits = 0;
    bool every = false;
    void add(std::size_t k) { k < 64 ? void(bits |= std::uint64_t{1} << k) : void(every = true); }
    bool has(std::size_t k) const { return every || (k < 64 && (bits >> k & 1) != 0); }
    bool several() const { return every || std::popcount(bits) > 1; }
  };
  /// A triangle or quad of the outer element, what is hidden from it, and its value by the rule of a rung.
  struct Cell {
    std::array<Vec3, 4> corner;
    std::size_t corners;
    Hides hides = Hides::none;
    ShadowSet parts;         ///< the shadows that hide a part each
    std::uint64_t form = 0;  ///< where there are several: of what they leave to be seen
    bool kinked = false;     ///< that has another form here than there
    bool uncut = false;      ///< too many lines go through it: nothing is known of it but by its nodes
    double ratio = 1;        ///< of its radius to its distance from the edges that shape the shadows
    int rung = 0;
    double error = 0;
    Value value{};
    Value by_border{};  ///< with several parts, or near an edge: the value by nodes at corners and sides
    std::span<const Vec3> ring() const { return {corner.data(), corners}; }
    friend bool operator<(const Cell& a, const Cell& b) { return a.error < b.error; }
  };
  class Pair;

  void prepare(std::span<const Vec3> outer, std::span<const Vec3> inner,
               std::span<const geometry::ConvexBlocker* const> blockers);
  void look(const Vec3& eye, const ElementShape& inner);
  void hide(const Vec3& eye, const PairShadow& shadow, geometry::HiddenPart& part);
  void hide(const Vec3& eye, const geometry::ConvexBlocker& blocker, geometry::HiddenPart& part);
  std::uint64_t form_seen(const Vec3& eye, const ElementShape& inner, const ShadowSet& past);

  ShadowEvents events_;
  double rounding_;
  std::uint64_t points_ = 0;
  geometry::HiddenPart part_;
  geometry::UnionCorners union_corners_;
  std::vector<PairShadow> shadows_;  ///< the first `shadow_count_` are in use
  std::size_t shadow_count_ = 0;
  std::vector<geometry::HalfSpace> shadow_;
  std::vector<Vec3> relative_;
  geometry::RingList rings_;
  std::vector<Cell> cells_;
};

/// F_{dA -> hidden part}, by Lambert's formula.
struct LambertOfParts {
  using Value = double;
  static constexpr int degrees = 0;
  Vec3 normal;

  double at(const Vec3& x, const geometry::RingList& parts) const;
  double at_whole(const Vec3& x, std::span<const Vec3> ring) const;
  static double zero() { return 0; }
  static double size(double value) { return std::abs(value); }
};

/// Of constants.
class HiddenExchange : public HiddenExchangeOf<LambertOfParts> {
 public:
  using HiddenExchangeOf::HiddenExchangeOf;
  HiddenIntegral operator()(const ElementShape& outer, const ElementShape& inner,
                            std::span<const geometry::ConvexBlocker* const> blockers, double tolerance) {
    return HiddenExchangeOf::operator()(outer, inner, {outer.plane.normal}, blockers, tolerance);
  }
  /// F_{dA -> hidden part of inner}
  double hidden_factor(const Vec3& x, const Vec3& normal, const ElementShape& inner,
                       std::span<const geometry::ConvexBlocker* const> blockers) {
    return hidden_at(x, inner, {normal}, blockers);
  }
};

}  // namespace interflect::fem
