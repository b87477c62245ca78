#pragma once

#include <cmath>

#include "core/vec.h"

namespace interflect::fem {

/// What irradiance at x owes to radiosity at y, per area of either: both see each other where it is asked.
class Kernel {
 public:
  virtual ~Kernel() = default;
  /// @param x, normal_x  receiving point [m] and unit normal; y, normal_y likewise
  /// @return  >= 0; 0 where one is behind the other
  virtual double operator()(const Vec3& x, const Vec3& normal_x, const Vec3& y, const Vec3& normal_y) const = 0;
};

/// cos cos / (pi r²) [1/m²]
class SpaceKernel final : public Kernel {
 public:
  double operator()(const Vec3& x, const Vec3& normal_x, const Vec3& y, const Vec3& normal_y) const override {
    const Vec3 d = y - x;
    const double arrives = normal_x.dot(d), leaves = -normal_y.dot(d), square = d.squaredNorm();
    return arrives > 0 && leaves > 0 ? inv_pi * arrives * leaves / (square * square) : 0;
  }
};

/// Of flatland, where nothing depends on z: the integral of the above along lines, cos cos / (2 r) [1/m].
/// Source: [Heckbert 1992] "Radiosity in flatland".
class FlatlandKernel final : public Kernel {
 public:
  double operator()(const Vec3& x, const Vec3& normal_x, const Vec3& y, const Vec3& normal_y) const override {
    const Vec3 d = y - x;
    const double arrives = normal_x.dot(d), leaves = -normal_y.dot(d), r = d.norm();
    return arrives > 0 && leaves > 0 ? 0.5 * arrives * leaves / (r * r * r) : 0;
  }
};

}  // namespace interflect::fem
