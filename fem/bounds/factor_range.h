#pragma once

#include <array>
#include <span>

#include "geometry/polygon.h"

namespace interflect::fem {

/// A convex part of a receiver's plane, over which a point moves; (s, t, normal) is right-handed.
struct Cell {
  geometry::Ring ring;  ///< corners [m], counter-clockwise around the normal
  Vec3 normal, s, t;    ///< unit
  Vec3 centre;          ///< of its area: what is linear has its mean there
  double radius;        ///< of the ball about the centre that holds it [m]
  double area;          ///< [m²]
  /// Means over the cell of s², s t, t² about the centre [m²].
  std::array<double, 3> second_moments;

  Vec2 local(const Vec3& x) const { return {s.dot(x - centre), t.dot(x - centre)}; }
};
Cell cell_of(std::span<const Vec3> ring);
/// The same with the frame of a wider cell that it is a part of.
Cell cell_of(std::span<const Vec3> ring, const Cell& wider);

/// What a configuration factor F(x) = F_{dA(x)->P} does as x moves over a cell, proved and not sampled: with d = (s, t)
/// from the centre,
///
///   |F(x) - value - (F_s, F_t) . d - 1/2 d . (F_ss, F_st; F_st, F_tt) d| <= remainder,     least <= F(x) <= most
///
/// and, for any e(y) on P with the mean m,
///
///   |int_P k(x, y) e(y) dy - F(x) m| <= across / area(P) int_P |e - m|
struct FactorRange {
  bool smooth = false;  ///< else nothing but least and most is known
  double value = 0;
  std::array<double, 5> derivatives{};  ///< s, t [1/m], ss, st, tt [1/m²]
  double remainder = 0;
  double least = 0, most = 0;
  double across = 0;
};

/// Of a polygon past which nothing is hidden.
///
/// While x moves along a unit vector v of its own plane with the normal n, its height c = n . (y - x) under y stays as
/// it is, and h = N . (x - y) is linear, so that with r^ = (y - x) / r, u = v . r^, z = n . r^ = c / r
///
///   k = c h / (pi r^4)                                             pi is inside, the reflectance is not
///   dk/dv   = z / (pi r³) N . (v - 4 u r^)
///   d³k/dv³ = z / (pi r^5) N . ((72 u² - 12) v + (72 - 192 u²) u r^)
///
/// The vectors' lengths are functions of u, and z <= sqrt(1 - u²): whatever N is,
///
///   |dk/dv| <= min(1.6, 3 z) / (pi r³),      |d³k/dv³| <= min(17.1, 60 z) / (pi r^5)
///
/// By the first, as k is the same for y moving in its plane, k is within 1.6 radius / (pi r_min³) of what it is at the
/// polygon's centre, and within that for both radii of what it is between both centres; by the second, times the area
/// and the radius' third power over 6, the remainder is bounded.  The value is Lambert's formula; derivatives are of
/// that as a sum over edges R = r + t e, 0 <= t <= 1,
///
///   F = 1/(2 pi) sum  n . (r x e) int dt / R²
///   grad F = 1/(2 pi) sum  2 n . (r x e) J - (e x n) int dt / R²,    J = int R / R^4 dt
///   d²F/dv² = 1/(2 pi) sum  n . (r x e) int (8 (v . R)² / R^6 - 2 / R^4) dt - 4 (v . (e x n)) (v . J)
///
/// A polygon that touches the cell has bounds alone: most is at most (1 - n . N) / 2, what a half-space behind its
/// plane sends.
///
/// Errors: of rounding alone; derivatives to 1e-7 of themselves, which is in the remainder.
/// @param polygon  convex, its side that is seen in front of all of the cell; no corner below the cell's plane, within
///                 rounding
/// @param plane    its plane, normal towards the cell
/// Test: tests/fem/bounds/factor_range.cpp
FactorRange factor_range(const Cell& cell, std::span<const Vec3> polygon, const geometry::Plane& plane);

/// Where no more is known, or any part may be hidden.
FactorRange between_none_and(double most);

}  // namespace interflect::fem
