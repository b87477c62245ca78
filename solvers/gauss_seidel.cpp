#include "solvers/gauss_seidel.h"

#include "solvers/block_product.h"
#include "solvers/bounce.h"
#include "solvers/iterations.h"
#include "solvers/system_check.h"

namespace interflect::solvers {
namespace {

constexpr Index block_rows = 64;   // fetched together: as many as keep a block of 10 000 unknowns in the shared cache
constexpr Index rows_a_task = 32;  // of a block, by one thread
constexpr Index columns_a_task = 2048;

/// One sweep after the other over all rows.  Unknowns are kept column after column, for contiguous inner loops.
class Sweeps {
 public:
  Sweeps(const System& system, const RowAccess& rows, double relaxation, const ColumnMatrix& start, const Run& run)
      : system_(system),
        access_(rows),
        relaxation_(relaxation),
        run_(run),
        x_(start.transpose()),
        missing_(start.cols(), start.rows()),
        own_(start.cols(), start.rows()),
        rows_(std::min(block_rows, start.rows()), start.rows()),
        sums_(start.cols(), block_rows),
        change_(start.cols(), block_rows) {}

  void forward() {
    missing_.setZero();
    for (Index first = 0; first < n(); first += block_rows) sweep_block(first, true);
  }
  void back() {
    missing_.setZero();
    for (Index first = (n() - 1) / block_rows * block_rows; first >= 0; first -= block_rows) sweep_block(first, false);
  }
  ColumnMatrix radiosity() const { return x_.transpose(); }
  /// e + R G^-1 K b - b of the symmetric case, see the header.
  ColumnMatrix residual() const {
    const Eigen::Map<const Eigen::VectorXd> G(system_.K.gram().data(), n());
    const ColumnMatrix of_others =
        (system_.R.reflectance().array() * missing_.transpose().array()).colwise() / G.array();
    return of_others + own_.transpose();
  }

 private:
  Index n() const { return x_.cols(); }
  Index columns() const { return x_.rows(); }

  void sweep_block(Index first, bool ascending) {
    const Index count = std::min(block_rows, n() - first);
    fetch_and_sum(first, count);
    for (Index k = 0; k < count; ++k) update(first, ascending ? k : count - 1 - k, count);
    if (!system_.K.symmetric()) return;
    spread_within(first, count, ascending);
    ascending ? spread(0, first, count) : spread(first + count, n(), count);
  }

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
      const double of_itself = 1 - reflected * rows_(i, a);
      const double value = (system_.e(a, c) + reflected * sum) / of_itself, step = value - x_(c, a);
      own_(c, a) = (1 - relaxation_) * of_itself * step;
      change_(c, i) = relaxation_ * step;
      x_(c, a) = relaxation_ == 1 ? value : x_(c, a) + change_(c, i);
    }
  }

  /// missing_a += sum_b K_ab change_b for all b of the block that come after an a of it.
  void spread_within(Index first, Index count, bool ascending) {
    for (Index c = 0; c < columns(); ++c)
      for (Index i = 0; i < count; ++i) {
        const Index begin = ascending ? 0 : i + 1, end = ascending ? i : count;
        for (Index j = begin; j < end; ++j) missing_(c, first + j) += rows_(i, first + j) * change_(c, i);
      }
  }
  /// The same for all a from `begin` on, which come before the block.
  void spread(Index begin, Index end, Index count) {
    run_.threads.for_blocks(end - begin, columns_a_task, [&](Index from, Index to) {
      const Index a = begin + from;
      add_transposed_product({rows_.data() + a, count, to - from, n()}, {change_.data(), columns(), block_rows},
                             {missing_.data() + a, columns(), n()});
    });
  }

  const System& system_;
  const RowAccess& access_;
  double relaxation_;
  const Run& run_;
  ColumnMatrix x_, missing_, own_;  ///< columns x unknowns
  ColumnMatrix rows_;               ///< of the block at work: block_rows x unknowns
  ColumnMatrix sums_, change_;      ///< columns x block_rows
};

}  // namespace

std::string GaussSeidel::name() const {
  if (sweep_ == Sweep::there_and_back) return "symmetric-gauss-seidel";
  return relaxation_ == 1 ? "gauss-seidel" : "over-relaxation";
}

SolverReport GaussSeidel::advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const {
  const RowAccess& rows = required_rows(system, name());
  require_solvable(system);
  if (!prepare(system, state)) return {.why = SolverReport::Stopped::nothing_to_do};

  const auto n = static_cast<double>(state.x.rows());
  const bool back_too = sweep_ == Sweep::there_and_back;
  Sweeps sweeps(system, rows, relaxation_, state.x, run);
  Iterations iterations(state, rule, run);
  for (bool more = true; more;) {
    sweeps.forward();
    if (back_too) sweeps.back();
    ColumnMatrix x = sweeps.radiosity();
    const ColumnMatrix residual = system.K.symmetric() ? sweeps.residual() : residual_of(system, x, run);
    more = iterations.next(x, {relative_size(residual, x), (back_too ? 2 : 1) * n});
  }
  return iterations.report();
}

}  // namespace interflect::solvers
