#pragma once

#include <atomic>
#include <memory>
#include <span>
#include <vector>

#include "core/run.h"
#include "fem/form_factor/method.h"
#include "fem/operator/tile_product.h"
#include "solvers/transport_operator.h"

namespace interflect::fem {

/// K = A F of constants on elements, every entry stored, in doubles, each pair once: 4 N² bytes.
///
///   (K b)_a = sum_b K_ab b_b   [m² x unit of b],   K_ab = K_ba = A_a F_ab [m²],   h = G^-1 K b with G = diag(A)
///
/// The upper triangle lies in square tiles, row of tiles after row of tiles, so that one pass over memory serves K_IJ
/// and its mirror K_JI = K_IJ^T.  Symmetric by construction: there is only one number a pair.
///
/// Standard errors of entries are kept in single precision, in tiles made when an entry in them was sampled: up to 2 N²
/// bytes more.  Bounds on quadrature errors are not kept: they are at most the tolerance that the method was given.
class DenseSymmetric final : public solvers::TransportOperator, public solvers::RowAccess, public ExchangeSink {
 public:
  /// All entries 0.  @param areas  of the elements [m²]   @throws core::InputError  where there is no memory for it
  explicit DenseSymmetric(std::vector<double> areas);
  ~DenseSymmetric() override;

  Index size() const { return layout_.unknowns(); }

  /// Sets K_ab = K_ba.  Threads may add at the same time as long as no pair is added twice.
  void add(Index a, Index b, const ExchangeEntry& entry) override;

  const solvers::Layout& layout() const override { return layout_; }
  bool symmetric() const override { return true; }
  /// Reads K once for up to any number of columns.  Same bits for any number of threads.
  void apply(solvers::ConstColumns b, solvers::Columns out, Run& run) const override;
  std::span<const double> gram() const override { return areas_; }
  std::span<const double> self() const override { return self_; }
  const solvers::RowAccess* rows() const override { return this; }

  void rows(Index first, Index count, solvers::Columns out) const override;
  Index evaluated() const override { return evaluated_.load(std::memory_order_relaxed); }

  double entry(Index a, Index b) const;                 ///< K_ab [m²]
  double entry_standard_error(Index a, Index b) const;  ///< [m²]

  /// sum_b F_ab = sum_b K_ab / A_a, for every a: 1 where a closed scene is resolved, less where light escapes.
  std::vector<double> row_sums(Run& run) const;

  /// out_a = sum_b error_ab² b_b, error_ab being the standard error of K_ab [m^4 x unit of b]; shape as in `apply`.  Of squares
  /// b_b² it is the variance of (K b)_a, since errors of different pairs are independent.
  void apply_variances(solvers::ConstColumns b, solvers::Columns out, Run& run) const;
  bool has_errors() const;

  /// K_ab <- s_a K_ab s_b for all pairs, errors too.
  void scale(std::span<const double> s, Run& run);

  /// sum of f(a, b, K_ab) over all entries, both triangles, in a fixed order; f, symmetric, is asked once a pair.
  template <class F>
  double sum_over_entries(const Run& run, const F& f) const;

  double bytes() const;  ///< of matrix and errors, as stored now

 private:
  /// Rows of tiles with about the same number of tiles: the unit of parallel work, the same for any number of threads.
  struct Strip {
    Index first, end;  ///< rows of tiles
  };
  struct Free {
    void operator()(double* p) const;
  };

  /// Position of tile (I, J), I <= J, among all of them.
  Index tile_at(Index I, Index J) const { return I * tile_rows_ - I * (I - 1) / 2 + (J - I); }
  const double* tile_data(Index I, Index J) const { return entries_.get() + tile_at(I, J) * tile_entries; }
  double* tile_data(Index I, Index J) { return entries_.get() + tile_at(I, J) * tile_entries; }
  float* error_tile(Index at);
  /// out = (a symmetric matrix whose tiles `tile_of(at, scratch)` gives) b.
  template <class TileOf>
  void multiply(const TileOf& tile_of, solvers::ConstColumns b, solvers::Columns out, Run& run) const;

  solvers::Layout layout_;
  std::vector<double> areas_, self_;
  Index tile_rows_;
  std::vector<Strip> strips_;
  std::unique_ptr<double[], Free> entries_;
  std::vector<std::atomic<float*>> errors_;  ///< per tile: null while all of its errors are 0
  mutable std::atomic<Index> evaluated_{0};
};

template <class F>
double DenseSymmetric::sum_over_entries(const Run& run, const F& f) const {
  return core::reduce_in_blocks(run.threads, static_cast<Index>(strips_.size()), 1, 0.0, [&](Index s, Index) {
    double sum = 0;
    for (Index I = strips_[static_cast<std::size_t>(s)].first; I < strips_[static_cast<std::size_t>(s)].end; ++I)
      for (Index J = I; J < tile_rows_; ++J) {
        const double* K = tile_data(I, J);
        double of_tile = 0;
        for (Index i = 0; i < std::min(tile_size, size() - I * tile_size); ++i)
          for (Index j = 0; j < std::min(tile_size, size() - J * tile_size); ++j)
            of_tile += f(I * tile_size + i, J * tile_size + j, K[i * tile_size + j]);
        sum += I == J ? of_tile : 2 * of_tile;
      }
    return sum;
  });
}

}  // namespace interflect::fem
