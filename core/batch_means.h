#pragma once

#include <vector>

#include "core/moments.h"

namespace interflect::core {

/// Numbers that come in batches, each a small run of its own: whatever is correlated within them, the means of batches
/// are independent, and say how wrong the mean of all is.
///
///   mean = mean over batches,   SE² = sum (m_k - mean)² / (K (K - 1)),   95 % within student_t(.95, K - 1) SE
///
/// Batches are of one size; with fewer than 32 of them intervals get long.
class BatchMeans {
 public:
  explicit BatchMeans(int batches) : of_(static_cast<std::size_t>(batches)) {}

  void add(int batch, double sample) { of_[static_cast<std::size_t>(batch)].add(sample); }
  int batches() const { return static_cast<int>(of_.size()); }
  const ScalarMoments& batch(int k) const { return of_[static_cast<std::size_t>(k)]; }

  double mean() const { return over_batches().mean(); }
  double standard_error() const { return over_batches().standard_error(); }
  /// Half of the interval that holds the truth with this confidence.
  double half_width(double confidence = 0.95) const;

 private:
  /// @throws PreconditionError  where batches differ in size
  ScalarMoments over_batches() const;

  std::vector<ScalarMoments> of_;
};

}  // namespace interflect::core
