#pragma once

#include <span>
#include <vector>

#include "core/vec.h"
#include "fem/form_factor/edge_pair.h"

namespace interflect::fem {

/// k for which the larger of two rings' size and distance is 2^(k-1) m to 2^k m, along some axis.
int unit_exponent(std::span<const Vec3> a, std::span<const Vec3> b);

/// 1/(2 pi) times a contour integral in units of 2^k m, in m².
Integral in_square_metres(const Integral& contour, int unit_exponent);

/// Two rings about a corner of the first, in a unit of length 2^k m for which the larger of size and distance is
/// between 1/2 and 1: ln r is of order 1 then, and lengths times 2^k give the same digits.
class ScaledRings {
 public:
  ScaledRings(std::span<const Vec3> a, std::span<const Vec3> b);

  std::span<const Edge> edges_of_a() const { return {edges_.data(), corners_of_a_}; }
  std::span<const Edge> edges_of_b() const { return {edges_.data() + corners_of_a_, edges_.size() - corners_of_a_}; }
  Integral to_square_metres(const Integral& contour) const { return in_square_metres(contour, exponent_); }

 private:
  std::vector<Edge> edges_;
  std::size_t corners_of_a_;
  int exponent_;
};

}  // namespace interflect::fem
