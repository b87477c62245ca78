#include "solvers/gauss_seidel.h"

#include "core/error.h"
#include "solvers/block_product.h"
#include "solvers/system_check.h"

namespace interflect::solvers {
namespace {

constexpr Index block_rows = 64;   // fetched together: as many as keep a block of 10 000 unknowns in the shared cache
constexpr Index rows_a_task = 32;  // of a block, by one thread
constexpr Index columns_a_task = 2048;

/// One sweep after the other over all rows.  Unknowns are kept column after column, for contiguous inner loops.
class Sweeps {
 public:
  Sweeps(const System& system, const RowAccess& rows, const ColumnMatrix& start, const Run& run)
      : system_(system),
        access_(rows),
        run_(run),
        x_(start.transpose()),
        missing_(start.cols(), start.rows()),
        rows_(std::min(block_rows, start.rows()), start.rows()),
        sums_(start.cols(), block_rows),
        change_(start.cols(), block_rows) {}

  void sweep() {
    missing_.setZero();
    for (Index first = 0; first < n(); first += block_rows) {
      const Index count = std::min(block_rows, n() - first);
      fetch_and_sum(first, count);
      for (Index i = 0; i < count; ++i) update(first, i, count);
      if (system_.K.symmetric()) spread_changes(first, count);
    }
  }
  ColumnMatrix radiosity() const { return x_.transpose(); }
  /// e + R G^-1 K b - b of the symmetric case, see the header.
  ColumnMatrix residual() const {
    const Eigen::Map<const Eigen::VectorXd> G(system_.K.gram().data(), n());
    return (system_.R.reflectance().array() * missing_.transpose().array()).colwise() / G.array();
  }

 private:
  Index n() const { return x_.cols(); }
  Index columns() const { return x_.rows(); }

  /// Fetches the rows of a block; sums_ = K b over the unknowns outside it.
  void fetch_and_sum(Index first, Index count) {
    sums_.setZero();
    const Index after = first + count;
    run_.threads.for_blocks(count, rows_a_task, [&](Index begin, Index end) {
      access_.rows(first + begin, end - begin, rows_.middleRows(begin, end - begin));
      const ColumnSpan sums{sums_.data() + begin, columns(), block_rows};
      const double* K = rows_.row(begin).data();
      add_product({K, end - begin, first, n()}, {x_.data(), columns(), n()}, sums);
      add_product({K + after, end - begin, n() - after, n()}, {x_.data() + after, columns(), n()}, sums);
    });
  }

  /// The new value of unknown first + i, with the newest of its block.
  void update(Index first, Index i, Index count) {
    const Index a = first + i;
    for (Index c = 0; c < columns(); ++c) {
      double sum = sums_(c, i);
      for (Index j = 0; j < count; ++j)
        if (j != i) sum += rows_(i, first + j) * x_(c, first + j);
      const double reflected = system_.R.reflectance()(a, c) / system_.K.gram()[static_cast<std::size_t>(a)];
      const double value = (system_.e(a, c) + reflected * sum) / (1 - reflected * rows_(i, a));
      change_(c, i) = value - x_(c, a);
      x_(c, a) = value;
    }
  }

  /// missing_a += sum_b K_ab change_b for the b of the block and all a < b.
  void spread_changes(Index first, Index count) {
    for (Index c = 0; c < columns(); ++c)
      for (Index i = 0; i < count; ++i)
        for (Index j = 0; j < i; ++j) missing_(c, first + j) += rows_(i, first + j) * change_(c, i);
    run_.threads.for_blocks(first, columns_a_task, [&](Index begin, Index end) {
      add_transposed_product({rows_.data() + begin, count, end - begin, n()}, {change_.data(), columns(), block_rows},
                             {missing_.data() + begin, columns(), n()});
    });
  }

  const System& system_;
  const RowAccess& access_;
  const Run& run_;
  ColumnMatrix x_, missing_;    ///< columns x unknowns
  ColumnMatrix rows_;           ///< of the block at work: block_rows x unknowns
  ColumnMatrix sums_, change_;  ///< columns x block_rows
};

/// e + R G^-1 K x - x.
ColumnMatrix residual_of(const System& system, const ColumnMatrix& x, Run& run) {
  const Eigen::Map<const Eigen::VectorXd> G(system.K.gram().data(), x.rows());
  ColumnMatrix h(x.rows(), x.cols());
  system.K.apply(x, h, run);
  h.array().colwise() /= G.array();
  ColumnMatrix residual = system.e - x;
  system.R.add_reflected(h, residual);
  return residual;
}

}  // namespace

SolverReport GaussSeidel::advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const {
  const RowAccess* rows = system.K.rows();
  if (rows == nullptr)
    throw core::InputError("solver 'gauss-seidel'", "an operator with rows expected; use 'jacobi' here");
  if (!system.R.diagonal())
    throw core::InputError("solver 'gauss-seidel'", "reflectance varies inside elements; use 'jacobi' here");
  require_solvable(system);
  if (!prepare(system, state)) return {.why = SolverReport::Stopped::nothing_to_do};

  Sweeps sweeps(system, *rows, state.x, run);
  SolverReport report;
  for (bool more = true; more;) {
    sweeps.sweep();
    ColumnMatrix x = sweeps.radiosity();
    const ColumnMatrix residual = system.K.symmetric() ? sweeps.residual() : residual_of(system, x, run);
    more = go_on(report, relative_size(residual, x), rule, run);
    state.x.swap(x);  // only now: a solve that fails leaves the last good x for another
    ++state.step;
  }
  return report;
}

}  // namespace interflect::solvers
