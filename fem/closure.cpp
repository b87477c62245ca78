#include "fem/closure.h"

#include <cmath>

#include "core/error.h"
#include "core/format.h"

namespace interflect::fem {
namespace {

using Vector = solvers::ColumnMatrix;  // one column

constexpr int most_gradient_steps = 500;
constexpr int most_halvings = 30;

/// S K S with S = diag(exp(u)), without storing it.
class Scaled {
 public:
  Scaled(const DenseSymmetric& K, Run& run)
      : K_(K), run_(run), areas_(K.gram().data(), K.size()), s_(Vector::Ones(K.size(), 1)) {}

  void set_logarithms(const Vector& u) { s_ = u.array().exp(); }
  const Vector& factors() const { return s_; }
  Vector times(const Vector& v) const {
    const Vector scaled = s_.array() * v.array();
    Vector product(scaled.rows(), 1);
    K_.apply(scaled, product, run_);
    return s_.array() * product.array();
  }
  Vector row_sums() const { return times(Vector::Ones(K_.size(), 1)); }
  /// A - K' 1
  Vector missing(const Vector& sums) const { return areas_ - sums.array(); }
  /// max_a |sum_b F'_ab - 1|
  double row_error(const Vector& sums) const { return (missing(sums).array() / areas_).abs().maxCoeff(); }

 private:
  const DenseSymmetric& K_;
  Run& run_;
  Eigen::Map<const Eigen::ArrayXd> areas_;
  Vector s_;
};

double dot(const Vector& a, const Vector& b) { return a.cwiseProduct(b).sum(); }

/// Solves (diag(K' 1) + K') step = missing by conjugate gradients with the diagonal as preconditioner, until the
/// residual is `reduction` of the right-hand side.  The matrix is positive semidefinite: singular where elements form
/// two groups that see each other only, and then consistent exactly if both have the same area.
Vector newton_step(const Scaled& K, const Vector& sums, const Vector& missing, double reduction) {
  Vector step = Vector::Zero(sums.rows(), 1), residual = missing, direction = missing.array() / sums.array();
  double size = dot(residual, direction);
  const double enough = reduction * reduction * size;
  for (int k = 0; k < most_gradient_steps && size > enough; ++k) {
    const Vector image = sums.array() * direction.array() + K.times(direction).array();
    const double curvature = dot(direction, image);
    if (!(curvature > 0)) break;
    step += size / curvature * direction;
    residual -= size / curvature * image;
    const Vector preconditioned = residual.array() / sums.array();
    const double next = dot(residual, preconditioned);
    direction = preconditioned + next / size * direction;
    size = next;
  }
  return step;
}

void require_nearly_closed(const DenseSymmetric& K, const std::vector<double>& F, const ClosureSettings& settings) {
  for (std::size_t a = 0; a < F.size(); ++a)
    if (!(std::abs(F[a] - 1) <= settings.largest_row_error))
      throw core::InputError(
          core::format("closure of %td elements: the form factors of element %zu add up to %.4g; only a closed scene, "
                       "with sums from %.4g to %.4g, can be corrected",
                       K.size(), a, F[a], 1 - settings.largest_row_error, 1 + settings.largest_row_error));
}

/// Newton's method: u such that exp(u_a) K_ab exp(u_b) has the row sums A.  Returns its steps.
int balance(Scaled& K, double tolerance, int max_iterations, const Run& run) {
  Vector u = Vector::Zero(K.factors().rows(), 1), sums = K.row_sums();
  double error = K.row_error(sums);
  for (int iteration = 0;; ++iteration) {
    if (error <= tolerance || iteration == max_iterations) return iteration;
    run.throw_if_stopped("closure");
    const Vector step = newton_step(K, sums, K.missing(sums), std::clamp(0.1 * error, 1e-8, 1e-2));
    // The step points where every norm of what is missing falls: shorten it until this one does.
    double length = 1;
    for (int halving = 0;; ++halving, length /= 2) {
      if (halving == most_halvings) {
        K.set_logarithms(u);
        return iteration;
      }
      K.set_logarithms(u + length * step);
      const Vector new_sums = K.row_sums();
      if (const double new_error = K.row_error(new_sums); new_error < error) {
        error = new_error;
        sums = new_sums;
        u += length * step;
        break;
      }
    }
  }
}

/// ||S K S - K|| / ||K||, Frobenius.
double relative_change(const DenseSymmetric& K, std::span<const double> s, const Run& run) {
  const double change = K.sum_over_entries(run, [&](Index a, Index b, double K_ab) {
    const double d = (s[static_cast<std::size_t>(a)] * s[static_cast<std::size_t>(b)] - 1) * K_ab;
    return d * d;
  });
  const double whole = K.sum_over_entries(run, [](Index, Index, double K_ab) { return K_ab * K_ab; });
  return std::sqrt(change / whole);
}

double largest_row_error(const std::vector<double>& F) {
  double largest = 0;
  for (const double f : F) largest = std::max(largest, std::abs(f - 1));
  return largest;
}

}  // namespace

ClosureReport restore_closure(DenseSymmetric& K, Run& run, const ClosureSettings& settings) {
  const std::vector<double> before = K.row_sums(run);
  require_nearly_closed(K, before, settings);
  Scaled scaled(K, run);
  ClosureReport report;
  report.row_error_before = largest_row_error(before);
  report.iterations =
      balance(scaled, settings.tolerance / 4, settings.max_iterations, run);  // rounding needs its part, too
  if (const double left = scaled.row_error(scaled.row_sums());
      left > 1e-3 * report.row_error_before && left > settings.tolerance)
    throw core::InputError(
        core::format("closure of %td elements: no symmetric scaling of the form factors makes every row sum 1 "
                     "(one is off by %.2g still)",
                     K.size(), left));
  const std::span<const double> s(scaled.factors().data(), static_cast<std::size_t>(K.size()));
  report.correction = relative_change(K, s, run);
  if (report.correction > settings.largest_correction)
    throw core::InputError(core::format(
        "closure of %td elements: it would change the form factors by %.3g of their norm, more than the %.3g "
        "that errors may explain",
        K.size(), report.correction, settings.largest_correction));
  K.scale(s, run);
  report.row_error_after = largest_row_error(K.row_sums(run));
  report.converged = report.row_error_after <= settings.tolerance;
  return report;
}

}  // namespace interflect::fem
