#pragma once

#include <vector>

#include "core/spectrum.h"
#include "fem/goal/goal.h"
#include "fem/goal/iterated_transport.h"
#include "fem/operator/symmetric_operator.h"
#include "solvers/solver.h"

namespace interflect::fem {

/// A solution of b = e + R T_h b on elements, T_h = G^-1 K, with polynomials of an order.
struct ElementSystem {
  const scene::Scene& scene;
  const mesh::ElementMesh& mesh;
  int order;                       ///< of the functions that K has; 0 .. 2
  std::span<const int> degree;     ///< of elements, <= order: functions of higher ones are not reflected
  const SymmetricOperator& K;      ///< of unknowns: functions of elements
  const solvers::ColumnMatrix& R;  ///< reflectance of unknowns, per channel
  const solvers::ColumnMatrix& e;
  double tolerance = 0;  ///< relative, of K's entries
};

/// What a solution says of a goal, and what it may be wrong by.
struct DualWeighted {
  Spectrum value;                     ///< J(B_h)
  Spectrum correction;                ///< J(B) - J(B_h), estimated
  Spectrum by_importance;             ///< J(B_h) once more, by the importance: <z_h, e>
  std::vector<Spectrum> of_elements;  ///< what elements add to the correction
  std::vector<Spectrum> size;         ///< sqrt(int zeta² int r²) of elements: what a better mesh may change there
  std::vector<double> decay;          ///< of elements: of T B_h's and T w_h's Legendre coefficients, see below
  Spectrum quadrature;                ///< what K's own errors do to it: root of the sum of squares
};

/// Dual-weighted residuals [Becker, Rannacher 2001], which for radiosity is importance [Smits, Arvo, Salesin 1992] with
/// its error: the importance z of a goal solves the adjoint equation
///
///   z = c + T (s + R z),     J(B) = <z, E>,     J(B) - J(B_h) = <z, r>,     r = E + R T B_h - B_h
///
/// since T is its own adjoint.  B_h and z_h are of one system: with w = s + R z it is w = (s + R c) + R T w, radiosity
/// from an exitance.  <z_h, r> = 0 as B_h is Galerkin's, so that
///
///   J(B) - J(B_h) = <z - z_h, r>  ~  <(T - T_h) w_h, r> + <c - c_h, r>,     r = R (T - T_h) B_h
///
/// with T B_h and T w_h at Gauss nodes of every element, past whatever hides (iterated_transport.h); c - c_h is of the
/// functions of degree up to 3, since points and pixels have no density of their own.  The error of z in its place is
/// one bounce of the importance's own residual, which is smaller as the iterated solution is than B_h.
///
/// Where both are smooth inside an element their coefficients in orthonormal polynomials fall like exp(-s degree), and
/// a higher degree pays; along shadows' edges they fall like a power of it, and cuts pay [Mavriplis 1994; Houston,
/// Sueli 2005].  With c_k the root of the sum of squares of T B_h's coefficients of degree k, and d_k of T w_h's,
///
///   decay = 1/2 ln (c_1 / c_3) + 1/2 ln (d_1 / d_3),
///
/// the slopes of straight lines fitted to ln c_k and ln d_k, k = 1 .. 3.
///
/// K's entries are off by up to `tolerance` of them, each in its own way:
///
///   J = <z, e>,   dJ = sum_ab w_a dK_ab b_b   ~   tolerance sqrt(sum_{a<b} (w_a b_b + w_b b_a)² K_ab²)
///   [constants alone]
///
/// @param b  the solution, unknowns x channels
/// Test: tests/fem/goal/dual_weighted.cpp
DualWeighted dual_weighted(const ElementSystem& system, solvers::ConstColumns b, const Goal& goal,
                           const raycast::RayCaster& rays, const solvers::RadiositySolver& solver,
                           const solvers::StoppingRule& stopping, Run& run);

}  // namespace interflect::fem
