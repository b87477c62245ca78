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
        root_(Eigen::Map<const Eigen::ArrayXd>(system.K.gram().data(), system.e.rows()).sqrt()),
        run_(run) {}

  /// Q S G^1/2 b
  ColumnMatrix reflected(const ColumnMatrix& b) const {
    ColumnMatrix h(b.rows(), b.cols());
    system_.K.apply(b, h, run_);
    h.array().colwise() /= root_;
    return times_Q(h);
  }
  ColumnMatrix radiosity_of(const ColumnMatrix& t) const { return times_Q(t).array().colwise() / root_; }

 private:
  ColumnMatrix times_Q(const ColumnMatrix& t) const {
    ColumnMatrix out = ColumnMatrix::Zero(t.rows(), t.cols());
    Q_.add_reflected(t, out);
    return out;
  }

  const System& system_;
  Reflection Q_;
  Eigen::ArrayXd root_;  ///< of G
  Run& run_;
};

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
    t += direction * step.asDiagonal();
    residual -= changed * step.asDiagonal();
    const OfColumns next = dots(residual, residual);
    direction = residual + direction * ratio(next, size).asDiagonal();
    size = next;
    x = system.e + A.radiosity_of(t);
    const double relative = relative_size(A.radiosity_of(residual), x);
    more = iterations.next(x, {relative, products * n});
  }
  return iterations.report();
}

}  // namespace interflect::solvers
