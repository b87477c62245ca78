#pragma once

#include <algorithm>

#include "fem/form_factor/polynomial_emitter.h"
#include "fem/space/plane_basis.h"

namespace interflect::fem {

/// K_ab = int int N_a k N_b of two elements' functions: a of the first, b of the second [m²].
using Moments =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, PlaneBasis::most_functions, PlaneBasis::most_functions>;

/// N_a(x) times the irradiance at x from parts of an element whose radiosity is N_b, in closed form
/// (polynomial_emitter.h): what is integrated over the receiving one.
class MomentIntegrand {
 public:
  using Value = Moments;

  /// All outlive this.
  MomentIntegrand(const PlaneBasis& receiver, const Vec3& normal, const PlaneBasis& emitter)
      : receiver_(receiver), normal_(normal), emitter_(emitter) {}

  /// From a convex part of the emitter, none of it below x's horizon.
  PlaneBasis::Values irradiance(const Vec3& x, std::span<const Vec3> part) const {
    std::array<double, PlaneBasis::most_functions> integrals;
    point_to_monomials(x, normal_, part, emitter_.frame(), emitter_.order(), integrals);
    return emitter_.of_monomials(integrals);
  }
  Value weighed(const Vec3& x, const PlaneBasis::Values& irradiance) const {
    return receiver_.at(x) * irradiance.transpose();
  }
  Value zero() const { return Value::Zero(receiver_.size(), emitter_.size()); }
  static double size(const Value& value) { return value.cwiseAbs().maxCoeff(); }
  static Value least(const Value& a, const Value& b) { return a.cwiseMin(b); }
  static Value greatest(const Value& a, const Value& b) { return a.cwiseMax(b); }

 private:
  const PlaneBasis& receiver_;
  Vec3 normal_;
  const PlaneBasis& emitter_;
};

}  // namespace interflect::fem
