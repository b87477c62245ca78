#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "fem/operator/panel_product.h"
#include "fem/operator/symmetric_operator.h"
#include "solvers/sparse_rows.h"

namespace interflect::fem {

/// The entries that matter, in doubles, each pair once: 12 bytes a kept pair, and 4 more where entries have standard
/// errors.
///
/// Panels of 64 rows hold their pairs a <= b packed, column after column of the panel: where one stands is one 32-bit
/// number, 64 b + a mod 64.  A product reads K once for both triangles; the rows of a block are its own panel and, of
/// every panel before, the contiguous part with its columns.
///
/// What was left out is known by row and bounded: dropped() is sum_b F_ab over it, and its noise counts in
/// `apply_variances` with the largest b.  Made by SparseAssembly.
class SparseSymmetric final : public SymmetricOperator, public solvers::SparseRows {
 public:
  const solvers::Layout& layout() const override { return layout_; }
  /// Same bits for any number of threads.
  void apply(solvers::ConstColumns b, solvers::Columns out, Run& run) const override;
  std::span<const double> gram() const override { return areas_; }
  std::span<const double> self() const override { return self_; }
  using SymmetricOperator::rows;
  void rows(Index first, Index count, solvers::Columns out) const override;
  const solvers::SparseRows* sparse_rows() const override { return this; }
  void row(Index a, std::vector<solvers::RowEntry>& out) const override;
  Index evaluated() const override { return evaluated_.load(std::memory_order_relaxed); }

  double entry(Index a, Index b) const override;
  double entry_standard_error(Index a, Index b) const override;
  bool has_errors() const override;
  void apply_variances(solvers::ConstColumns b, solvers::Columns out, Run& run) const override;

  Index strips() const override { return static_cast<Index>(strips_.size()); }
  void visit(Index strip, const Visit& visit) const override;
  void change(const NewEntry& entry, Run& run) override;
  /// Without a threshold: every entry that is not 0.
  std::unique_ptr<SymmetricOperator> alike(std::vector<double> areas, const Fill& fill, Run& run) const override;

  double bytes() const override;
  double kept_share() const override;
  std::span<const double> dropped() const override { return dropped_; }
  double drop_below() const override { return drop_below_; }

 private:
  friend class SparseAssembly;
  using Place = std::uint32_t;

  /// Pairs in the order of their places.
  struct Panel {
    std::vector<Place> place;
    std::vector<double> K;
    std::vector<float> error;  ///< empty: all 0
    double error_of(std::size_t k) const { return error.empty() ? 0.0 : static_cast<double>(error[k]); }
  };
  struct Strip {
    Index first, end;  ///< panels
  };

  SparseSymmetric(std::vector<double> areas, double drop_below);
  void cut_into_strips();
  Index panels() const { return static_cast<Index>(panels_.size()); }
  const Panel& panel(Index P) const { return panels_[static_cast<std::size_t>(P)]; }
  /// Where (a, b) is in a's panel; nothing if it was left out.
  std::optional<std::size_t> find(Index a, Index b) const;
  StoredPair pair_at(Index P, std::size_t k) const;
  /// out = (a symmetric matrix of these pairs, with value(panel, k) in place of K) b.
  template <class Value>
  void multiply(const Value& value, solvers::ConstColumns b, solvers::Columns out, Run& run) const;

  solvers::Layout layout_;
  std::vector<double> areas_, self_;
  double drop_below_;
  std::vector<double> dropped_, dropped_variance_;  ///< by row: of F, and of K [m^4]
  std::vector<Panel> panels_;
  std::vector<Strip> strips_;
  mutable std::atomic<Index> evaluated_{0};
};

/// Where the entries of a SparseSymmetric go: keeps those with F_ab or F_ba of at least `drop_below`, K_ab >= t
/// min(A_a, A_b), and counts the others' F by row.  20 bytes a kept pair on the way.
///
/// At most 1 / t pairs an element are kept, N / t in all, since the F_ab of an element add up to 1 at most.  Sums of
/// what is dropped are integers, in units of 2^-52, rounded up: the same for any number of threads.
class SparseAssembly final : public ExchangeSink {
 public:
  /// @throws core::InputError  more than 2^26 elements
  SparseAssembly(std::vector<double> areas, double drop_below);

  /// Threads may add at the same time as long as no pair is added twice at the same time.  A pair that is added again
  /// later takes the place of what it was; where it was dropped, too, it counts as dropped twice, which is cautious.
  void add(Index a, Index b, const ExchangeEntry& entry) override;

  /// The operator; nothing is left here.
  std::unique_ptr<SparseSymmetric> packed(const Run& run);

 private:
  struct Entry {
    double K;
    SparseSymmetric::Place place;
    float error;
  };
  struct Rows {  ///< of a panel
    std::mutex mutex;
    std::deque<Entry> entries;
  };
  void drop(Index a, const ExchangeEntry& entry);
  static SparseSymmetric::Panel packed(std::deque<Entry> entries);

  std::vector<double> areas_;
  double drop_below_;
  std::vector<Rows> panels_;
  std::vector<std::atomic<std::uint64_t>> dropped_, dropped_variance_;
};

}  // namespace interflect::fem
