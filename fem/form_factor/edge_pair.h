#pragma once

#include "core/vec.h"
#include "fem/form_factor/integral.h"

namespace interflect::fem {

/// An edge of a polygon, from corner to corner.
struct Edge {
  Vec3 from, to;
  Vec3 along;      ///< to - from [m]
  Vec3 direction;  ///< along / length
  double length;   ///< [m]
};
Edge edge_between(const Vec3& from, const Vec3& to);

/// Two corners this close, where distances are about 1, are one: both have been rounded.
inline constexpr double one_corner = 1e-15;

/// What one pair of edges adds to the double contour integral, in closed form:
///
///   I(e, f) = int_e int_f ln r dr_e . dr_f = c int_{S_0}^{S_1} int_{T_0}^{T_1} ln r dT dS
///
/// with r in units of length. **Lines that are not parallel.** S and T are counted from the feet of their common
/// perpendicular, whose length is h; c is the cosine and sigma the sine of their angle:
///
///   r² = h² + R²,   R² = S² + T² - 2 c S T
///
/// R is homogeneous in (S, T), so that ln r is the divergence of (S, T) g, a function of R, and I is over four sides:
///
///   4 R² g = r² ln r² - R² - h² ln h²,   I / c = [ S int g dT ]_{S_0}^{S_1} + [ T int g dS ]_{T_0}^{T_1}
///
/// On the side at S let u run along f from the foot of e's point there (and likewise on the one at T):
///
///   p = sigma |S|,   m² = h² + p²,   R² = p² + u²,   tan theta = u / p
///   4 int g du = u ln(m² + u²) - 3 u + 2 m atan(u / m) + h²/p D
///   D = int_0^theta ln(1 + (p / (h cos t))²) dt = -theta ln b + Im Li2(-e^{2 i theta}) - Im Li2(-b e^{2 i theta})
///   b = (sqrt(1 + p²/h²) - p/h)²
///
/// D falls away for lines that meet (h = 0), and with it every side that goes through their point: edges that share a
/// corner need two sides and no dilogarithm. u is taken from the corners, so that only S and T grow, as 1 / sigma.
///
/// **Parallel lines** at distance d, with v between the places of the two points along them: an alternating sum over
/// the four pairs of corners of
///
///   G(v) = (v² - d²)/4 ln(d² + v²) + d v atan(v/d) - 3/4 v²
///
/// d = 0 on one line: a shared edge has L² (ln L - 3/2).
///
/// @param e, f  lengths and distances of about 1, else digits are lost: scale first
/// @return  I, without the 1/(2 pi) of K, and an estimate of its rounding: 2^-53 times the sizes of what is summed;
///          for edges that are taken for parallel at an angle below 3e-8, what that may cost
///
/// Source: derived here; closed forms of the same integral: [Schroeder, Hanrahan 1993].
///
/// Test: tests/fem/edge_pair.cpp, against quadrature.
Integral edge_pair(const Edge& e, const Edge& f);

}  // namespace interflect::fem
