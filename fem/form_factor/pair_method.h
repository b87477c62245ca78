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

/// What a method does with doubtful pairs, in one thread; it may hold memory for that.
class PairOcclusion {
 public:
  virtual ~PairOcclusion() = default;
  virtual ExchangeEntry operator()(const DoubtfulPair& pair, PairCounts& counts) = 0;
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

  virtual std::unique_ptr<PairOcclusion> occlusion() const = 0;  ///< for one thread

  const FormFactorContext& context() const { return context_; }
  const PairIntegrator& integrator() const { return integrate_; }
  const ElementShapes& shapes() const { return integrate_.shapes(); }
  const Blockers& blockers() const { return blockers_; }

 private:
  class ClusterPair;

  FormFactorContext context_;
  PairIntegrator integrate_;
  std::vector<ElementCluster> clusters_;
  Blockers blockers_;
};

}  // namespace interflect::fem
