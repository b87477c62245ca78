#pragma once

#include <functional>

#include "fem/environment_column.h"
#include "fem/operator/symmetric_operator.h"
#include "fem/polynomial_radiosity.h"

namespace interflect::fem {

/// What the error of a solution is estimated from.
struct ErrorSources {
  const SymmetricOperator& K;                 ///< on the fine mesh; its errors are those of its entries
  const SymmetricOperator* blocks = nullptr;  ///< of polynomials, with errors of theirs
  std::span<const double> row_sum_before;     ///< sum_j F_ij before any closure was restored
  double quadrature_tolerance = 0;            ///< relative, of entries
  std::span<const double> beyond_tolerance;   ///< sum_j of what bounds of entries are beyond it, over A_i; empty: none
  std::span<const double> row_bound;          ///< sum_j bound_ij / A_i, in place of that tolerance; empty: not known
  const EnvironmentColumn* environment = nullptr;  ///< of an open scene, where it was found
  bool both_converged = true;  ///< the solves at either size: else nothing bounds the discretisation error
  /// Of polynomials, what their highest degree adds: in place of the halving, of neighbours and of the field's
  /// variation.
  const PolynomialChange* polynomials = nullptr;
};

/// Fills irradiance_error, irradiance_noise, shared_noise and field_error of a solution whose other fields are there.
///
/// Discretisation.  D = G^-1 K (B_h - P B_2h): what the iterated irradiance of each element owes to halving the
/// elements, with the same K for both, so that no noise of visibility is in it.  Where errors fall as h^p, |D| is (2^p
/// - 1) times the error that is left at h, so at least the error for p >= 1; means of constants have p = 2 where the
/// solution is smooth, 1.5 to 2 beside edges. A zero of D is a place where the sign changes and not one without error,
/// so that the bound is
///
///   max(|D_i|, rms of D over the four children of i's parent, 1/2 rms of D over i's side of its surface)
///
/// (of polynomials without the second)
///
/// plus  neighbours: what radiosity varies by inside elements next to i, which halving does not show
///       (neighbour_error.h);
/// plus  quadrature: tolerance times H, and what rows are beyond it times the larger of H and the mean radiosity, over
///       1 - mean rho for all bounces; where the errors of rows are known, those in place of both;
/// plus  closure, where scenes are closed or their environment was found: |1 - row sum_i - F_i,env - dropped_i| beyond
///       twice its standard error, times the mean radiosity, and the same of the mean row times rho / (1 - rho), for
///       later bounces: rows that all lack d make H lack d B / (1 - rho);
/// plus  dropped pairs: the most that they may bring (dropped_irradiance.h), and its mean times rho / (1 - rho);
/// plus  solver: residual times max B / (1 - max rho), mean rho where max rho is 1.
///
/// Noise.  With the standard errors e_ij of K's entries, one bounce off B makes
///
///   var_i = sum_j (e_ij B_j / A_i)²
///
/// of its own in each element, and the next one
///
///   sum_j (F_ij rho_j)² var_j + 2 e_ij² B_j F_ij rho_j B_i / (A_i A_j),
///
/// which is much where an element sees little but one other.  Later bounces see means over many elements, and add one
/// and the same deviation to all,
///
///   shared² = (rho / (1 - rho))² Var(mean H),   Var(mean H) = sum_{i<j} e_ij² (B_i + B_j)² / A²
///                                             = sum_ij e_ij² (B_j² + B_i B_j) / A²
///
/// with the mean rho and the total area A; K_ij = K_ji is one random number that two elements share.  irradiance_noise²
/// is all of these.
///
/// Field.  Constants differ from the iterated B_1 by its variation inside the element.  For a linear field the root
/// mean square over an element is 1/sqrt(3) of that between the four children of a parent, for triangles and
/// parallelograms alike; that is what is taken:  field_error_i = rho_i rms_children(H_k - H_parent) / sqrt(3).
///
/// Polynomials.  |h_p - h_{p-1}| of elements' means stands for |D|: means converge with the order 2p + 2 where the
/// solution is smooth, so that it is mostly far more than the error that is left.  Functions show what radiosity does
/// inside elements, so that neighbours add nothing, and the field's error is what those of the highest degree make of
/// H.
/// Test: tests/fem/error_estimate.cpp, by coverage.
void estimate_errors(RadiositySolution& solution, const ErrorSources& from, int channels, Run& run);

/// The same where no matrix tells what halving the elements would change, of constants whose irradiance_noise is there:
/// what irradiance varies by inside the element; what radiosity varies by in those that it sees, if that can be told,
/// and in the mean of all; what form factors lack; all but the first for all bounces, over 1 - mean rho; and what is
/// missing anyhow. Of siblings' differences noise is subtracted.
/// @param bound  of form factors, on one bounce; empty: none
/// @param missing  on irradiance, in all elements
/// @param arriving  what of a field arrives at elements, sum_j F_ij v_j; none: the mean of all stands for it
using Arriving = std::function<std::vector<Spectrum>(std::span<const Spectrum> sent)>;
void estimate_errors_alone(RadiositySolution& solution, std::span<const Spectrum> bound, const Spectrum& missing,
                           const Arriving& arriving = {});

/// Of polynomials without a matrix: with |D| what the highest degree adds to elements' means, as above, and rho / (1 - rho)
/// times its mean in later bounces; in the field what that degree makes of H, noise subtracted.
/// @param added  |D|
void estimate_errors_of_polynomials_alone(RadiositySolution& solution, std::span<const Spectrum> added);

/// Of four elements that are the quarters of one, for each of them.
std::vector<Spectrum> means_of_fours(const mesh::ElementMesh& mesh, std::span<const Spectrum> values);

/// By area.
Spectrum area_mean(const mesh::ElementMesh& mesh, std::span<const Spectrum> values);

/// rho / (1 - rho) with the mean rho by area: what all bounces after the first bring, if light spreads evenly.
Spectrum later_bounces(const RadiositySolution& solution);

/// Root mean square of irradiance inside an element about its mean, from its siblings as above; of polynomials, theirs.
Spectrum irradiance_variation(const RadiositySolution& solution, std::size_t element);

}  // namespace interflect::fem
