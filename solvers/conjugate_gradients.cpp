#include "solvers/conjugate_gradients.h"

#include "core/error.h"
#include "solvers/iterations.h"
#include "solvers/system_check.h"

namespace interflect::solvers {
namespace {

using OfColumns = Eigen::RowVectorXd;

OfColumns dots(const ColumnMatrix& a, const ColumnMatrix& b) { return a.cwiseProduct(b).colwise().sum(); }

/// a / b, 0 where b is: a column that is solved already.
OfColumns ratio(const OfColumns& a, const OfColumns& b) { return (b.array() > 0).select(a.array() / b.array(), 0.0); }

/// Between b and t.
class Symmetrised {
 public:
  Symmetrised(const System& system, Run& run)
      : system_(system),
        Q_(system.R.root()),
        by_root_(Eigen::Map<const Eigen::VectorXd>(system.K.gram().data(), system.e.rows())
                     .cwiseSqrt()
                     .cwiseInverse()
                     .replicate(1, system.e.cols())),
        run_(run) {}

  /// Q S G^1/2 b
  ColumnMatrix reflected(const ColumnMatrix& b) const {
    ColumnMatrix h(b.rows(), b.cols());
    system_.K.apply(b, h, run_);
    h = h.cwiseProduct(by_root_);
    return times_Q(h);
  }
  ColumnMatrix radiosity_of(const ColumnMatrix& t) const { return times_Q(t).cwiseProduct(by_root_); }

 private:
  ColumnMatrix times_Q(const ColumnMatrix& t) const {
    ColumnMatrix out = ColumnMatrix::Zero(t.rows(), t.cols());
    Q_.add_reflected(t, out);
    return out;
  }

  const System& system_;
  Reflection Q_;
  ColumnMatrix by_root_;  ///< G^-1/2, for each column
  Run& run_;
};

/// t + a d and r - a c, a number a column: in one pass.
void step_along(const OfColumns& a, const ColumnMatrix& d, const ColumnMatrix& c, ColumnMatrix& t, ColumnMatrix& r) {
  const Index rows = t.rows(), columns = t.cols();
  for (Index i = 0; i < rows; ++i)
    for (Index k = 0; k < columns; ++k) {
      t(i, k) += a(k) * d(i, k);
      r(i, k) -= a(k) * c(i, k);
    }
}

/// d = r + a d
void turn(const OfColumns& a, const ColumnMatrix& r, ColumnMatrix& d) {
  const Index rows = d.rows(), columns = d.cols();
  for (Index i = 0; i < rows; ++i)
    for (Index k = 0; k < columns; ++k) d(i, k) = r(i, k) + a(k) * d(i, k);
}

}  // namespace

SolverReport ConjugateGradients::advance(const System& system, SolverState& state, const StoppingRule& rule,
                                         Run& run) const {
  if (!system.K.symmetric())
    throw core::InputError("solver '" + name() + "'", "a symmetric operator expected; use 'gmres' here");
  require_solvable(system);
  if (!prepare(system, state)) return {.why = SolverReport::Stopped::nothing_to_do};

  const auto n = static_cast<double>(state.x.rows());
  const Symmetrised A(system, run);
  // t = Q S G^1/2 b where b is the solution, and of any start something to begin with; 0 of b = e.
  const bool fresh = state.x == system.e;
  ColumnMatrix t = fresh ? ColumnMatrix::Zero(state.x.rows(), state.x.cols()) : A.reflected(state.x);
  ColumnMatrix x = system.e + A.radiosity_of(t), residual = A.reflected(x) - t, direction = residual;
  OfColumns size = dots(residual, residual);
  Iterations iterations(state, rule, run);
  double products = fresh ? 2 : 3;  // of the first iteration, with those to begin with
  for (bool more = true; more; products = 1) {
    const ColumnMatrix changed = direction - A.reflected(A.radiosity_of(direction));
    const OfColumns step = ratio(size, dots(direction, changed));
    step_along(step, direction, changed, t, residual);
    const OfColumns next = dots(residual, residual);
    turn(ratio(next, size), residual, direction);
    size = next;
    x = system.e + A.radiosity_of(t);
    const double relative = relative_size(A.radiosity_of(residual), x);
    more = iterations.next(x, {relative, products * n});
  }
  return iterations.report();
}

}  // namespace interflect::solvers
