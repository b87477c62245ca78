#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "fem/form_factor/blockers.h"
#include "fem/form_factor/element_clusters.h"
#include "fem/form_factor/method.h"
#include "fem/form_factor/pair_integral.h"

namespace interflect::fem {

/// A pair that something may partly hide.
struct DoubtfulPair {
  Index i, j;  ///< i < j
  const PairIntegral& unoccluded;
  const geometry::Shaft& shaft;
  const std::vector<std::uint32_t>* among;  ///< all blockers that reach into it are among these; null: among all
};

/// What a method writes of pairs that exchange something, in one thread; it may hold memory for that.
class PairWork {
 public:
  virtual ~PairWork() = default;
  /// @param K  bounded: 0 <= K <= min(A_i, A_j)
  virtual void clear(Index i, Index j, const PairIntegral& K, ExchangeSink& sink) = 0;
  virtual void doubtful(const DoubtfulPair& pair, ExchangeSink& sink, PairCounts& counts) = 0;
};

/// The same of constants, one entry a pair: what a method does with doubtful pairs is all that it adds.
class PairOcclusion : public PairWork {
 public:
  virtual ExchangeEntry operator()(const DoubtfulPair& pair, PairCounts& counts) = 0;

  void clear(Index i, Index j, const PairIntegral& K, ExchangeSink& sink) final {
    sink.add(i, j, {K.value, 0, K.error});
  }
  void doubtful(const DoubtfulPair& pair, ExchangeSink& sink, PairCounts& counts) final {
    sink.add(pair.i, pair.j, (*this)(pair, counts));
  }
};

/// Methods that go from pair to pair, K_ij = K_ij,unoccluded V_ij.
///
/// Orientation proves pairs dark; a shaft between two clusters of elements, or between the two elements, that nothing
/// reaches into proves them clear.  What is left is the method's own.
class PairMethod : public FormFactorMethod {
 public:
  Granularity granularity() const final { return Granularity::pair; }
  PairCounts exchange(const ElementBlock& rows, const ElementBlock& columns, ExchangeSink& sink,
                      const Run& run) const final;

 protected:
  explicit PairMethod(const FormFactorContext& context);

  virtual std::unique_ptr<PairWork> work() const = 0;  ///< for one thread

  const FormFactorContext& context() const { return context_; }
  const PairIntegrator& integrator() const { return integrate_; }
  const ElementShapes& shapes() const { return integrate_.shapes(); }
  const Blockers& blockers() const { return blockers_; }

 private:
  class ClusterPair;
  /// Those elements of a cluster that are in a block.
  struct Part {
    const ElementCluster& cluster;
    std::span<const Index> elements;
  };
  std::vector<Part> parts_of(const ElementBlock& block) const;

  FormFactorContext context_;
  PairIntegrator integrate_;
  std::vector<ElementCluster> clusters_;
  std::vector<std::size_t> cluster_of_;  ///< per element
  Blockers blockers_;
};

}  // namespace interflect::fem
