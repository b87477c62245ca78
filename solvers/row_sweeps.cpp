#include "solvers/row_sweeps.h"

namespace interflect::solvers {
namespace {

constexpr Index block_rows = 64;   // fetched together: as many as keep a block of 10 000 unknowns in the shared cache
constexpr Index rows_a_task = 32;  // of a block, by one thread
constexpr Index columns_a_task = 2048;

}  // namespace

RowSweeps::RowSweeps(const System& system, const RowAccess& rows, double relaxation, const ColumnMatrix& start,
                     const Run& run)
    : Sweeps(system, relaxation, start, start.rows(), block_rows),
      access_(rows),
      run_(run),
      rows_(std::min(block_rows, start.rows()), start.rows()),
      sums_(start.cols(), block_rows) {}

void RowSweeps::forward() {
  missing_.setZero();
  for (Index first = 0; first < n(); first += block_rows) sweep_rows(first, true);
}

void RowSweeps::back() {
  missing_.setZero();
  for (Index first = (n() - 1) / block_rows * block_rows; first >= 0; first -= block_rows) sweep_rows(first, false);
}

void RowSweeps::sweep_rows(Index first, bool ascending) {
  const Index count = std::min(block_rows, n() - first);
  fetch_and_sum(first, count);
  sweep({first, 0, count, {rows_.data() + first, count, count, n()}, {sums_.data(), columns(), block_rows}}, ascending);
  if (!system_.K.symmetric()) return;
  ascending ? spread(0, first, count) : spread(first + count, n(), count);
}

/// Fetches the rows of a block; sums_ = K b over the unknowns outside it.
void RowSweeps::fetch_and_sum(Index first, Index count) {
  sums_.setZero();
  const Index after = first + count;
  run_.threads.for_blocks(count, rows_a_task, [&](Index begin, Index end) {
    access_.rows(first + begin, end - begin, rows_.middleRows(begin, end - begin));
    const ColumnSpan sums{sums_.data() + begin, columns(), block_rows};
    const double* K = rows_.row(begin).data();
    add_product({K, end - begin, first, n()}, x_from(0), sums);
    add_product({K + after, end - begin, n() - after, n()}, x_from(after), sums);
  });
}

/// missing_a += sum_b K_ab change_b for the b of the block and all a of [begin, end), which come before it.
void RowSweeps::spread(Index begin, Index end, Index count) {
  run_.threads.for_blocks(end - begin, columns_a_task, [&](Index from, Index to) {
    const Index a = begin + from;
    add_transposed_product({rows_.data() + a, count, to - from, n()}, change(), missing_from(a));
  });
}

}  // namespace interflect::solvers
