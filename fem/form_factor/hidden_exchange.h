#pragma once

#include <span>
#include <vector>

#include "fem/form_factor/adaptive_lambert.h"
#include "fem/form_factor/element_shapes.h"
#include "fem/form_factor/shadow_events.h"
#include "geometry/convex_blocker.h"
#include "geometry/hidden_part.h"

namespace interflect::fem {

/// What blockers take from the exchange of two elements, after [Nishita, Nakamae 1985]: from a point of one the hidden part of the other is
/// known exactly, as polygons, and Lambert's formula gives their form factor; that is integrated over the first,
///
///   K_hidden = int_{outer} F_{dA -> hidden part of inner} dA  [m²],    K = K_unoccluded - K_hidden.
///
/// The outer element is cut along the lines where the shadow changes its form (ShadowEvents).  On what lies between, the integrand is
/// smooth, and a ladder of rules is climbed: with values v_0, v_1, .. (1, 3, 6, .. nodes) the error of v_l is taken for
/// |v_l - v_{l-1}|, the error of the step before, times (cell / distance)^n, n = 2 on quads, whose rules gain two orders a step, and 1 on
/// triangles.  In a cell a blocker hides nothing, all, or a part: what hides nothing or all of `inner` from the centroid does so from the
/// whole cell.  Where several hide parts, kinks remain between the lines: there the factor is 1, and cells are quartered.  The cell
/// with the largest error goes first, until the errors sum to the tolerance.
///
/// Not shared between threads: it holds the work's memory.
class HiddenExchange {
 public:
  /// @param rounding  of coordinates [m]
  explicit HiddenExchange(double rounding) : events_(rounding), rounding_(rounding) {}

  /// @param outer, inner  each in front of the other's plane
  /// @param tolerance     [m²]
  /// @return  value, and an estimated bound on its error; that exceeds the tolerance only if 20 000 cells were not enough
  Integral operator()(const ElementShape& outer, const ElementShape& inner,
                      std::span<const geometry::ConvexBlocker* const> blockers, double tolerance);

  /// F_{dA -> hidden part of inner} from a point in front of the inner element's plane, for which that is in front of the horizon.
  double hidden_factor(const Vec3& x, const Vec3& normal, const ElementShape& inner,
                       std::span<const geometry::ConvexBlocker* const> blockers);

  std::uint64_t points() const { return points_; }  ///< at which hidden parts were found, so far

 private:
  enum class Hides : std::uint8_t { none, all, part };
  /// A triangle or quad of the outer element, what is hidden from it, and its value by the rule of a rung.
  struct Cell {
    std::array<Vec3, 4> corner;
    std::size_t corners;
    Hides hides = Hides::none;
    int only = -1;  ///< the one of the shadows that hides a part; none where several do
    int rung = 0;
    double value = 0, error = 0;
    std::span<const Vec3> ring() const { return {corner.data(), corners}; }
    friend bool operator<(const Cell& a, const Cell& b) { return a.error < b.error; }
  };
  class Pair;

  void prepare(std::span<const Vec3> outer, std::span<const Vec3> inner, std::span<const geometry::ConvexBlocker* const> blockers);
  void look(const Vec3& eye, const ElementShape& inner);
  void hide(const Vec3& eye, const PairShadow& shadow);
  void hide(const Vec3& eye, const geometry::ConvexBlocker& blocker);
  double factor_of_hidden(const Vec3& normal) const;

  ShadowEvents events_;
  double rounding_;
  std::uint64_t points_ = 0;
  geometry::HiddenPart part_;
  std::vector<PairShadow> shadows_;  ///< the first `shadow_count_` are in use
  std::size_t shadow_count_ = 0;
  std::vector<geometry::HalfSpace> shadow_;
  std::vector<Vec3> relative_;
  geometry::RingList rings_;
  std::vector<Cell> cells_;
};

}  // namespace interflect::fem
