#include "fem/form_factor/uniform_map.h"

#include <algorithm>
#include <cmath>

namespace interflect::fem {
namespace {

/// x in [0, 1] of the density that goes linearly from `at_0` to `at_1`, where its integral is u times the whole: the
/// root of (at_1 - at_0) x² + 2 at_0 x = u (at_0 + at_1), in the form that does not cancel.
double invert_linear(double at_0, double at_1, double u) {
  const double root = std::sqrt(std::max(0.0, at_0 * at_0 + u * (at_1 - at_0) * (at_1 + at_0)));
  return std::min(1.0, u * (at_0 + at_1) / (at_0 + root));
}

}  // namespace

UniformMap::UniformMap(std::span<const Vec3> ring)
    : shape_(ring.size() == 3 ? Shape::triangle : Shape::quad),
      corner_(ring[0]),
      along_s_(ring[1] - corner_),
      along_t_(ring[shape_ == Shape::triangle ? 2 : 3] - corner_) {
  if (shape_ == Shape::triangle) return;
  twist_ = ring[2] - ring[1] - along_t_;
  constexpr double rounding = 1e-13;
  if (twist_.norm() <= rounding * std::min(along_s_.norm(), along_t_.norm())) {
    shape_ = Shape::parallelogram;
    return;
  }
  const Vec3 normal = (ring[2] - ring[0]).cross(ring[3] - ring[1]);
  jacobian_ = normal.dot(along_s_.cross(along_t_)) / normal.squaredNorm();
  jacobian_s_ = normal.dot(along_s_.cross(twist_)) / normal.squaredNorm();
  jacobian_t_ = normal.dot(twist_.cross(along_t_)) / normal.squaredNorm();
}

/// Of triangles, and of quads whose sides are not parallel.
Vec3 UniformMap::bent(double u, double v) const {
  if (shape_ == Shape::triangle) {
    const double root = std::sqrt(u);
    return corner_ + root * (1 - v) * along_s_ + root * v * along_t_;
  }
  const double marginal = jacobian_ + 0.5 * jacobian_t_;
  const double s = invert_linear(marginal, marginal + jacobian_s_, u), given_s = jacobian_ + s * jacobian_s_;
  const double t = invert_linear(given_s, given_s + jacobian_t_, v);
  return corner_ + s * along_s_ + t * along_t_ + s * t * twist_;
}

}  // namespace interflect::fem
