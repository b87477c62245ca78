#include "solvers/sweeps.h"

namespace interflect::solvers {
namespace {

using ConstVector = Eigen::Map<const Eigen::VectorXd>;

}  // namespace

Sweeps::Sweeps(const System& system, double relaxation, const ColumnMatrix& start, Index stride, Index block_rows)
    : system_(system),
      values_(start.cols() * stride),
      x_(values_.data(), start.cols(), stride),
      missing_(ColumnMatrix::Zero(start.cols(), stride)),
      n_(start.rows()),
      relaxation_(relaxation),
      own_(start.cols(), start.rows()),
      change_(ColumnMatrix::Zero(start.cols(), block_rows)) {
  x_.leftCols(n_) = start.transpose();
}

ColumnMatrix Sweeps::residual() const {
  const std::span<const double> G = system_.K.gram();
  ColumnMatrix r(n_, columns());
  for (Index a = 0; a < n_; ++a)
    for (Index c = 0; c < columns(); ++c)
      r(a, c) = system_.R.reflectance()(a, c) / G[static_cast<std::size_t>(a)] * missing_(c, a) + own_(c, a);
  return r;
}

void Sweeps::sweep(const Rows& rows, bool ascending) {
  for (Index k = rows.begin; k < rows.end; ++k) update(rows, ascending ? k : rows.end - 1 - (k - rows.begin));
  if (system_.K.symmetric()) spread_within(rows, ascending);
}

void Sweeps::update(const Rows& rows, Index i) {
  const Index a = rows.first + i, after = rows.diagonal.n - i - 1, of_part = i - rows.begin;
  const double* K = rows.diagonal.entries + of_part * rows.diagonal.stride;
  for (Index c = 0; c < columns(); ++c) {
    double* x = x_.row(c).data() + rows.first;
    const double sum = rows.received.values[c * rows.received.stride + of_part] +
                       ConstVector(K, i).dot(ConstVector(x, i)) +
                       ConstVector(K + i + 1, after).dot(ConstVector(x + i + 1, after));
    const double reflected = system_.R.reflectance()(a, c) / system_.K.gram()[static_cast<std::size_t>(a)];
    const double of_itself = 1 - reflected * K[i];
    const double value = (system_.e(a, c) + reflected * sum) / of_itself, step = value - x[i];
    own_(c, a) = (1 - relaxation_) * of_itself * step;
    change_(c, i) = relaxation_ * step;
    x[i] = relaxation_ == 1 ? value : x[i] + change_(c, i);
  }
}

void Sweeps::spread_within(const Rows& rows, bool ascending) {
  for (Index c = 0; c < columns(); ++c)
    for (Index i = rows.begin; i < rows.end; ++i) {
      const Index begin = ascending ? 0 : i + 1, end = ascending ? i : rows.diagonal.n;
      const double* K = rows.diagonal.entries + (i - rows.begin) * rows.diagonal.stride;
      double* missing = missing_.row(c).data() + rows.first;
      for (Index j = begin; j < end; ++j) missing[j] += K[j] * change_(c, i);
    }
}

}  // namespace interflect::solvers
