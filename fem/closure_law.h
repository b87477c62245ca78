#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "fem/environment_column.h"
#include "fem/operator/symmetric_operator.h"

namespace interflect::fem {

/// How far entries may be off, as a repair weighs them:
///
///   w_ab = e_ab² + tau_a tau_b K_ab²   [m^4],   kappa = sum_ab w_ab / sum_ab K_ab   [m²]
///
/// e_ab is the standard error of what was sampled.  The rest, quadrature, aliasing, far fields, is asked of methods
/// relative to the entry, so its deviation is a part tau of K_ab: tau_a is the larger of what row a states of it, sum_b
/// bound_ab / sum_b K_ab, and of what the row is seen to be off by, |1 - sum_b F_ab - F_a,env| / sum_b F_ab, but for
/// three standard errors of F_a,env; the mean of a's and b's (geometric) makes w symmetric.
struct EntryVariances {
  std::vector<double> relative;  ///< tau_a
  double kappa = 1;              ///< [m²]
  double operator()(const StoredPair& p) const {
    return p.standard_error * p.standard_error + relative[p.a] * relative[p.b] * p.K * p.K;
  }
};
/// @param row_bound   sum_b bound_ab / A_a
/// @param seen        |1 - sum_b F_ab - F_a,env|, less what the environment's noise explains
/// @param row_sum     sum_b F_ab
EntryVariances entry_variances(const SymmetricOperator& K, std::span<const double> row_bound,
                               std::span<const double> seen, std::span<const double> row_sum, const Run& run);

/// How a repaired matrix follows from multipliers u, one an element, none of which need to be stored a pair:
///
///   K'_ab = phi_ab(u_a + u_b)  [m²],   z_a = min(max(Z_a + v_a / kappa u_a, 0), A_a)  [m²]
///
/// with phi_ab non-decreasing and z_a = A_a F_a,env the environment's column, which was found to be Z_a with the
/// variance v_a (none in a closed scene).  With rows that add up to A this is a minimum, since  f(u) = 1/2 sum_ab
/// Phi_ab(u_a + u_b) + sum_a Psi_a(u_a) - sum_a A_a u_a,  whose Phi' is phi and Psi' is z, is convex and has the
/// gradient  sum_b K'_ab + z_a - A_a.
class ClosureLaw {
 public:
  using Vector = solvers::ColumnMatrix;  // one column

  virtual ~ClosureLaw() = default;
  /// K'_ab at the multipliers that were set last.
  virtual double repaired(const StoredPair& pair) const = 0;
  /// sum_b phi'_ab v_b
  virtual Vector times(const Vector& v) const = 0;

  void set(const Vector& u);
  /// What rows have beside K' and the environment, whatever u is [m²].
  void set_aside(Vector exchange) { aside_ = std::move(exchange); }
  /// sum_b phi'_ab + dz_a / du_a: what the Hessian has on its diagonal beside `times`.
  const Vector& stiffness() const { return stiffness_; }
  Vector missing() const { return areas() - sums_; }                ///< A_a - sum_b K'_ab - z_a
  double row_error() const;                                         ///< max_a |1 - sum_b F'_ab - F'_a,env|
  double environment(Index a) const { return environment_(a, 0); }  ///< z_a [m²]
  Index size() const { return K_.size(); }

 protected:
  /// @param environment  null in a closed scene
  ClosureLaw(const SymmetricOperator& K, const EnvironmentColumn* environment, const EntryVariances& variances,
             Run& run);

  /// sums = sum_b K'_ab and stiffness = sum_b phi'_ab at the multipliers u().
  virtual void sum_entries(Vector& sums, Vector& stiffness) = 0;
  const Vector& u() const { return u_; }
  const SymmetricOperator& matrix() const { return K_; }
  Run& run() const { return run_; }

 private:
  Eigen::Map<const Eigen::VectorXd> areas() const { return {K_.gram().data(), K_.size()}; }

  const SymmetricOperator& K_;
  Run& run_;
  Vector found_, slope_;  ///< Z_a and v_a / kappa [m²]
  Vector aside_;
  Vector u_, sums_, stiffness_, environment_;
};

/// K'_ab = K_ab exp(u_a + u_b), see closure.h.
std::unique_ptr<ClosureLaw> scaling_law(const SymmetricOperator& K, const EnvironmentColumn* environment,
                                        const EntryVariances& variances, Run& run);
/// K'_ab = min(max(K_ab + w_ab / kappa (u_a + u_b), 0), A_a, A_b), and 0 where K_ab is, see closure.h.
std::unique_ptr<ClosureLaw> least_squares_law(const SymmetricOperator& K, const EnvironmentColumn* environment,
                                              const EntryVariances& variances, Run& run);

}  // namespace interflect::fem
