#pragma once

#include <optional>
#include <span>

#include "core/vec.h"

namespace interflect::solvers {

/// What random walks see of geometry: where light that leaves an unknown arrives.  Of constants, whose unknowns are elements.
///
///   P(from_element(i) = j) = F_ij = K_ij / G_i,     nothing: it arrives nowhere, 1 - sum_j F_ij
class TransitionSampler {
 public:
  virtual ~TransitionSampler() = default;
  /// How many uniform numbers a draw takes.
  virtual int dimensions() const = 0;
  /// @param u  in [0, 1).  From any thread.
  virtual std::optional<Index> from_element(Index i, std::span<const double> u) const = 0;
};

}  // namespace interflect::solvers
