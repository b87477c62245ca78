#pragma once

#include <Eigen/Core>
#include <span>

#include "core/vec.h"
#include "fem/space/polynomials.h"

namespace interflect::fem {

/// The polynomials of degree <= order on an element, orthonormal in the mean:
///
///   (1/A) int N_a N_b = delta_ab,   N_0 = 1,   so that the Gram matrix is A times the identity
///
/// of the affine coordinates of the element's plane, or of its line: on triangles, parallelograms and segments those of
/// polynomials.h; on other quads, whose bilinear map is none of an affine one, products of Legendre polynomials in the
/// affine coordinates about their middle, orthonormalised by Cholesky's factors of their Gram matrix.  So all degrees
/// are there on every element, and L2 errors fall by order + 1 on bent meshes too [Arnold, Boffi, Falk 2002].
class ElementBasis {
 public:
  static constexpr int highest_order = 3, most_functions = plane_functions(highest_order);

  static int functions(int order, std::size_t corners) {
    return corners == 2 ? segment_functions(order) : plane_functions(order);
  }

  /// @param ring  2 corners: a segment; 3 or 4: planar and convex
  /// @throws core::PreconditionError  an order that is not 0 .. 3, or another number of corners
  ElementBasis(int order, std::span<const Vec3> ring);

  int size() const { return functions(order_, corners_); }
  int order() const { return order_; }
  /// At a point by the element's own coordinates, as mesh::ElementPoint has them (segments: u alone).
  /// @param out  size() values
  void at(double u, double v, std::span<double> out) const;

 private:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_functions, most_functions>;

  void products_at(double u, double v, std::span<double> out) const;
  void orthonormalise(std::span<const Vec3> ring);

  int order_;
  std::size_t corners_;
  double bend_u_ = 0,
         bend_v_ = 0;      ///< of a quad c + x A + y B, x = u + bend_u u v, y = v + bend_v u v; -1 <= u, v <= 1
  Matrix inverse_factor_;  ///< empty where products are orthonormal as they are
};

/// An element's functions by those of one of its quarters: N_a = sum_b R_ab N_b' on it, a of the whole, b of the
/// quarter (scene::quarters_of, or the half of a segment).
Eigen::MatrixXd restriction(int order, std::span<const Vec3> ring, std::size_t quarter);

}  // namespace interflect::fem
