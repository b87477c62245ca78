#pragma once

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "fem/operator/dense_symmetric.h"
#include "fem/operator/sparse_symmetric.h"

namespace interflect::fem {

/// A DenseSymmetric and the same matrix in full.
struct OperatorPair {
  std::unique_ptr<DenseSymmetric> K;
  Eigen::MatrixXd full, errors;
  Eigen::VectorXd areas;
};

/// Random entries K_ab = A_a A_b u / sum A, zeros among them; areas over `decades` powers of ten; the row sums are
/// `closed` to rounding if asked for.  A third of the entries has an error, none where `exact`.
inline OperatorPair random_pair(Index n, std::uint64_t seed, double decades = 4, bool closed = false,
                                bool exact = false) {
  core::RandomNumbers random(seed, 0, 0);
  OperatorPair pair;
  pair.areas.resize(n);
  for (Index a = 0; a < n; ++a) pair.areas(a) = std::pow(10.0, decades * random.next());
  pair.full.setZero(n, n);
  pair.errors.setZero(n, n);
  for (Index a = 0; a < n; ++a)
    for (Index b = a; b < n; ++b) {
      const double u = random.next(), v = random.next();
      pair.full(a, b) = pair.full(b, a) =
          u < 0.2 || a == b ? 0.0 : u * pair.areas(a) * pair.areas(b) / pair.areas.sum();
      if (!exact && v < 1.0 / 3)
        pair.errors(a, b) = pair.errors(b, a) = static_cast<double>(static_cast<float>(v * pair.full(a, b)));
    }
  for (int round = 0; closed && round < 2000;
       ++round) {  // as a test helper may: slowly, by another method than the one tested
    const Eigen::VectorXd sums = pair.full.rowwise().sum(), s = (pair.areas.array() / sums.array()).sqrt();
    if ((sums.array() / pair.areas.array() - 1).abs().maxCoeff() < 1e-15) break;
    pair.full = s.asDiagonal() * pair.full * s.asDiagonal();
  }
  if (closed) pair.full = (0.5 * (pair.full + pair.full.transpose())).eval();
  pair.K = std::make_unique<DenseSymmetric>(std::vector<double>(pair.areas.begin(), pair.areas.end()));
  for (Index a = 0; a < n; ++a)
    for (Index b = a; b < n; ++b) pair.K->add(a, b, {pair.full(a, b), pair.errors(a, b)});
  return pair;
}

/// The same entries, stored sparsely.
inline std::unique_ptr<SparseSymmetric> sparse(const OperatorPair& pair, double drop_below, const Run& run) {
  SparseAssembly assembly(std::vector<double>(pair.areas.begin(), pair.areas.end()), drop_below);
  const Index n = pair.areas.size();
  run.threads.for_blocks(n, 1, [&](Index a, Index) {
    for (Index b = a; b < n; ++b) assembly.add(b, a, {pair.full(a, b), pair.errors(a, b)});
  });
  return assembly.packed(run);
}

inline Eigen::MatrixXd full(const SymmetricOperator& K) {
  solvers::ColumnMatrix rows(K.size(), K.size());
  K.rows(0, K.size(), rows);
  return rows;
}

inline solvers::ColumnMatrix random_columns(Index n, Index columns, std::uint64_t seed) {
  core::RandomNumbers random(seed, 1, 0);
  solvers::ColumnMatrix m(n, columns);
  for (Index a = 0; a < n; ++a)
    for (Index c = 0; c < columns; ++c) m(a, c) = 2 * random.next() - 1;
  return m;
}

}  // namespace interflect::fem
