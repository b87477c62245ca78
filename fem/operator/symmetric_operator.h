#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/run.h"
#include "fem/form_factor/method.h"
#include "solvers/transport_operator.h"

namespace interflect::fem {

/// An entry of a symmetric matrix with a <= b, which stands for K_ba too.
struct StoredPair {
  std::uint32_t a, b;
  double K;               ///< [m²]
  double standard_error;  ///< [m²]; 0 where nothing was sampled
};

/// K = A F of constants on elements, each pair stored once: what solvers apply, closure repairs and error estimates
/// read, however it is stored.
///
///   (K b)_a = sum_b K_ab b_b   [m² x unit of b],   K_ab = K_ba = A_a F_ab [m²],   h = G^-1 K b with G = diag(A)
///
/// Pairs are visited in strips, about equal parts of the matrix that are the same for any number of threads: sums over
/// a strip, added in the order of the strips, have the same bits for any number of threads.
class SymmetricOperator : public solvers::TransportOperator, public solvers::RowAccess {
 public:
  using Visit = std::function<void(std::span<const StoredPair>)>;
  using NewEntry = std::function<double(const StoredPair&)>;
  using Fill = std::function<void(ExchangeSink&)>;

  Index size() const { return layout().unknowns(); }
  bool symmetric() const final { return true; }
  const solvers::RowAccess* rows() const final { return this; }
  void rows(Index first, Index count, solvers::Columns out) const override = 0;

  virtual double entry(Index a, Index b) const = 0;                 ///< K_ab [m²]
  virtual double entry_standard_error(Index a, Index b) const = 0;  ///< [m²]
  virtual bool has_errors() const = 0;
  /// out_a = sum_b error_ab² b_b, error_ab being the standard error of K_ab [m^4 x unit of b]; shape as in `apply`.  Of
  /// squares b_b² it is the variance of (K b)_a, since errors of different pairs are independent.
  virtual void apply_variances(solvers::ConstColumns b, solvers::Columns out, Run& run) const = 0;

  virtual Index strips() const = 0;
  /// Every pair of a strip that is not 0 without an error, each once, a few thousand at a time, always in the same
  /// order.
  virtual void visit(Index strip, const Visit& visit) const = 0;
  /// K_ab <- entry(pair) for all of those; standard errors stay.
  virtual void change(const NewEntry& entry, Run& run) = 0;

  /// Another operator that is stored as this one is, with every pair that `fill` writes.
  virtual std::unique_ptr<SymmetricOperator> alike(std::vector<double> areas, const Fill& fill, Run& run) const = 0;

  virtual double bytes() const = 0;                               ///< of matrix and errors, as stored now
  virtual double kept_share() const { return 1; }                 ///< of the pairs a < b, stored
  virtual std::span<const double> dropped() const { return {}; }  ///< sum_b F_ab over what is not; empty: all pairs are
  virtual double drop_below() const { return 0; }                 ///< what is not stored has F_ab and F_ba below it

  /// sum_b F_ab = sum_b K_ab / A_a, for every a: 1 where a closed scene is resolved, less where light escapes.
  std::vector<double> row_sums(Run& run) const;

  /// sum of f(a, b, K_ab) over all entries that are stored, both triangles, in a fixed order; f, symmetric, is asked
  /// once a pair.
  template <class F>
  double sum_over_entries(const Run& run, const F& f) const;

  /// Row sums of anything: add(pair, sums) adds what a pair means to rows a and b (once, where a = b) of size() x
  /// columns sums.
  template <class Add>
  solvers::ColumnMatrix sums_by_row(const Run& run, Index columns, const Add& add) const;
};

template <class F>
double SymmetricOperator::sum_over_entries(const Run& run, const F& f) const {
  return core::reduce_in_blocks(run.threads, strips(), 1, 0.0, [&](Index strip, Index) {
    double sum = 0;
    visit(strip, [&](std::span<const StoredPair> pairs) {
      double of_pairs = 0;
      for (const StoredPair& p : pairs) of_pairs += (p.a == p.b ? 1 : 2) * f(Index{p.a}, Index{p.b}, p.K);
      sum += of_pairs;
    });
    return sum;
  });
}

template <class Add>
solvers::ColumnMatrix SymmetricOperator::sums_by_row(const Run& run, Index columns, const Add& add) const {
  std::vector<solvers::ColumnMatrix> of_strips(static_cast<std::size_t>(strips()));
  run.threads.for_blocks(strips(), 1, [&](Index strip, Index) {
    solvers::ColumnMatrix sums = solvers::ColumnMatrix::Zero(size(), columns);
    visit(strip, [&](std::span<const StoredPair> pairs) {
      for (const StoredPair& pair : pairs) add(pair, sums);
    });
    of_strips[static_cast<std::size_t>(strip)] = std::move(sums);
  });
  solvers::ColumnMatrix all = solvers::ColumnMatrix::Zero(size(), columns);
  for (const solvers::ColumnMatrix& sums : of_strips) all += sums;
  return all;
}

}  // namespace interflect::fem
