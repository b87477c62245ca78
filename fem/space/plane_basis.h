#pragma once

#include <Eigen/Core>
#include <span>

#include "core/vec.h"
#include "fem/space/element_basis.h"

namespace interflect::fem {

/// Coordinates of a plane: y = origin + xi e_1 + eta e_2, unit and orthogonal; its front is along e_1 x e_2.
struct PlaneFrame {
  Vec3 origin, e_1, e_2;
};

/// xi^i eta^j, i + j <= order, by i + j and then by j.
/// @param out  plane_functions(order) values
void monomials(int order, double xi, double eta, std::span<double> out);

/// The functions of ElementBasis as polynomials of the coordinates of the element's plane, which they are on every
/// element: for points and parts of it that come from clipping and from shadows.
///
///   N_a(y) = sum_ij C_a,ij (xi / r)^i (eta / r)^j     about the element's middle, with its radius r
class PlaneBasis {
 public:
  static constexpr int most_functions = ElementBasis::most_functions;
  using Values = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_functions, 1>;

  /// @param ring  of a planar triangle or convex quad
  PlaneBasis(int order, std::span<const Vec3> ring, const Vec3& normal);

  int order() const { return order_; }
  Index size() const { return coefficients_.rows(); }
  const PlaneFrame& frame() const { return frame_; }
  /// At a point of the plane, within the element or near it.
  Values at(const Vec3& y) const;
  /// From integrals of xi^i eta^j [m^(i+j) times what they are of] to those of the functions.
  Values of_monomials(std::span<const double> integrals) const;
  double largest() const { return largest_; }  ///< what |N_a| are at most on the element: not below it

 private:
  double largest_on(std::span<const Vec3> ring) const;

  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_functions, most_functions>;

  int order_;
  PlaneFrame frame_;
  double radius_ = 0, largest_ = 0;
  Matrix coefficients_;  ///< functions x monomials
};

}  // namespace interflect::fem
