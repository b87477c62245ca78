#pragma once

#include <algorithm>
#include <array>

#include "fem/form_factor/distant_emitter.h"
#include "fem/form_factor/polynomial_emitter.h"
#include "fem/space/plane_basis.h"
#include "geometry/hidden_part.h"

namespace interflect::fem {

/// K_ab = int int N_a k N_b of two elements' functions: a of the first, b of the second [m²].
using Moments =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, PlaneBasis::most_functions, PlaneBasis::most_functions>;

/// N_a(x) times the irradiance at x from parts of an element whose radiosity is N_b: what is integrated over the
/// receiving one.  Of near parts in closed form (polynomial_emitter.h), of far ones by rules, if that is accurate
/// enough (distant_emitter.h).
class MomentIntegrand {
 public:
  using Value = Moments;

  /// All outlive this.  @param accuracy  of far parts; 0: all are in closed form
  MomentIntegrand(const PlaneBasis& receiver, const Vec3& normal, const PlaneBasis& emitter, double accuracy)
      : degrees(receiver.order()), receiver_(receiver), normal_(normal), emitter_(emitter), accuracy_(accuracy) {}

  int degrees;  ///< of its own polynomials

  /// Of a convex polygon on the emitter, none of it below x's horizon.
  Value at_whole(const Vec3& x, std::span<const Vec3> ring) const {
    Integrals integrals;
    integrate(x, ring, emitter_.frame(), integrals);
    return weighed(x, integrals);
  }
  /// Of several, relative to x.
  Value at(const Vec3& x, const geometry::RingList& parts) const {
    PlaneFrame frame = emitter_.frame();
    frame.origin -= x;
    Integrals sum{}, integrals{};
    const auto add = [&](std::span<const Vec3> part) {
      integrate(Vec3::Zero(), part, frame, integrals);
      for (std::size_t a = 0; a < sum.size(); ++a) sum[a] += integrals[a];
    };
    for (std::size_t k = 0; k < parts.size(); ++k) for_fans(parts[k], add);
    return weighed(x, sum);
  }
  Value zero() const { return Value::Zero(receiver_.size(), emitter_.size()); }
  static double size(const Value& value) { return value.cwiseAbs().maxCoeff(); }
  static Value least(const Value& a, const Value& b) { return a.cwiseMin(b); }
  static Value greatest(const Value& a, const Value& b) { return a.cwiseMax(b); }

 private:
  using Integrals = std::array<double, PlaneBasis::most_functions>;  ///< those that the order has

  /// A convex ring as those of few enough corners.
  template <class F>
  static void for_fans(std::span<const Vec3> ring, const F& f) {
    constexpr std::size_t most = 16;
    if (ring.size() <= most) return f(ring);
    std::array<Vec3, most> fan;
    fan[0] = ring[0];
    for (std::size_t first = 1; first + 1 < ring.size();) {
      const std::size_t count = std::min(most - 1, ring.size() - first);
      std::copy_n(ring.begin() + static_cast<std::ptrdiff_t>(first), count, fan.begin() + 1);
      f(std::span<const Vec3>(fan).first(count + 1));
      first += count - 1;
    }
  }
  void integrate(const Vec3& x, std::span<const Vec3> ring, const PlaneFrame& frame, Integrals& out) const {
    if (accuracy_ > 0 && distant_monomials(x, normal_, ring, frame, emitter_.order(), accuracy_, out)) return;
    point_to_monomials(x, normal_, ring, frame, emitter_.order(), out);
  }
  Value weighed(const Vec3& x, const Integrals& integrals) const {
    return receiver_.at(x) * emitter_.of_monomials(integrals).transpose();
  }

  const PlaneBasis& receiver_;
  Vec3 normal_;
  const PlaneBasis& emitter_;
  double accuracy_;
};

}  // namespace interflect::fem
