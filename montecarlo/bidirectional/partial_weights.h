#pragma once

#include <cmath>

#include "core/vec.h"

namespace interflect::montecarlo {

/// Weights of all strategies that could have made a path, by sums that each of its two walks carries along.
///
/// A path x_0 (on the light) .. x_k (the eye's end) can be made by s vertices of a walk from the light and t = k + 1 - s
/// of one from the eye, with the density p_s = prod_{i<s} pL(x_i) prod_{i>=s} pE(x_i), each per area.  The balance
/// heuristic weighs it by 1 / sum_j p_j / p_s [Veach, Guibas 1995].  Of the sum, the strategies with fewer vertices of
/// the light's walk need what that walk knows, but for the densities with which the eye's would make its last two
/// vertices y = x_{s-1} and x_{s-2}, which is known when the walks are joined:
///
///   sum_{j<s} p_j / p_s = pE(y) (a + r b),     r: of scattering at y back to x_{s-2} [1/sr], given where it is joined to
///
///   x_i reached from x_{i-1}:   a_i = c / p_i,    b_i = g / p_i (a_{i-1} + r_{i-1} b_{i-1})
///
/// p_i: density of x_i by this walk [1/m²];  g = |cos_{i-1}| / |x_i - x_{i-1}|²: from solid angle at x_i to area at
/// x_{i-1};  c = 1, or what strategies that join at x_{i-1} are more or fewer by.  At a mirror or the like walks cannot
/// be joined: there c = 0, a_{i-1} is left out, and p and r are 1 per solid angle, which is as good as any number that
/// both walks agree on.  The same holds from the eye.  Straight passes through panes and nets are no vertices; Russian
/// roulette is no part of the densities.
///
/// Source: the idea is [Georgiev et al. 2012], "Implementing vertex connection and merging".
/// Test: tests/montecarlo/bidirectional.cpp, against all strategies of a path one by one
struct PartialWeights {
  double a = 0;  ///< [m²]
  double b = 0;  ///< [m² sr]

  /// sum_j p_j / p_s of the strategies with fewer vertices of this walk.
  /// @param pdf_area  by the other walk, of the vertex that has these weights
  /// @param pdf_back  by the other walk there, of the way back to the vertex before [1/sr]
  double of_others(double pdf_area, double pdf_back) const { return pdf_area * (a + pdf_back * b); }
};

/// A walk that has left a vertex, and not arrived at the next.
struct Departure {
  Vec3 from;
  double pdf_solid_angle;  ///< of its way [1/sr]; 1 where that is delta
  double cosine;           ///< |cos| of the way there
  double joins;            ///< c above
  double others;           ///< a + r b of the vertex left

  /// At a vertex with these weights.
  /// @param pdf_back  of scattering back there, given the new way
  static Departure scattered(const Vec3& from, const PartialWeights& weights, double pdf_solid_angle, double cosine,
                             double pdf_back) {
    return {from, pdf_solid_angle, cosine, 1, weights.a + pdf_back * weights.b};
  }
  /// Into the only way there is.
  static Departure mirrored(const Vec3& from, const PartialWeights& weights, double cosine) {
    return {from, 1, cosine, 0, weights.b};
  }

  /// Per area at a place that it arrives at, its |cos| there given.
  double pdf_area(const Vec3& to, double cosine_there) const {
    return pdf_solid_angle * cosine_there / (to - from).squaredNorm();
  }
  /// Of the vertex arrived at, whose density is this.
  PartialWeights arrived(const Vec3& to, double pdf_area_there) const {
    return {joins / pdf_area_there, cosine / (to - from).squaredNorm() / pdf_area_there * others};
  }
  /// Of one arrived at afar, where all is per solid angle.
  PartialWeights escaped() const { return {joins / pdf_solid_angle, cosine / pdf_solid_angle * others}; }
};

}  // namespace interflect::montecarlo
