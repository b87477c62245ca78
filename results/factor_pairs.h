#pragma once

#include <algorithm>
#include <vector>

#include "results/factor_store.h"

namespace interflect::results {

/// f(a, b, K, error) for every pair a <= b of a store that is not 0 without an error [m²]; a tile's height of rows is
/// held.
template <class F>
void for_pairs(const FactorStore& store, const F& f) {
  const Index n = store.size();
  std::vector<double> K, error;
  for (Index first = 0; first < n; first += store.tile()) {
    const Index rows = std::min(store.tile(), n - first);
    K.resize(static_cast<std::size_t>(rows * n));
    error.resize(K.size());
    store.read_rows(first, rows, K, error);
    for (Index a = 0; a < rows; ++a)
      for (Index b = first + a; b < n; ++b)
        if (const auto at = static_cast<std::size_t>(a * n + b); K[at] != 0 || error[at] != 0)
          f(first + a, b, K[at], error[at]);
  }
}

}  // namespace interflect::results
