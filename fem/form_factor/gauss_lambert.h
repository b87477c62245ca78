#pragma once

#include "fem/form_factor/blockers.h"
#include "fem/form_factor/element_clusters.h"
#include "fem/form_factor/method.h"
#include "fem/form_factor/pair_integral.h"
#include "fem/form_factor/visibility.h"

namespace interflect::fem {

/// Form factors of pairs: K_ij = K_ij,unoccluded V_ij.
///
/// Orientation proves pairs dark; a shaft between two clusters of elements, or between the two elements, that no facet
/// reaches into proves them clear; the visibility of the rest is sampled, which gives an entry its standard error.
class GaussLambert final : public FormFactorMethod {
 public:
  explicit GaussLambert(const FormFactorContext& context);
  std::string name() const override { return "gauss-lambert"; }
  Granularity granularity() const override { return Granularity::pair; }
  PairCounts exchange(const ElementBlock& rows, const ElementBlock& columns, ExchangeSink& sink,
                      const Run& run) const override;

 private:
  class ClusterPair;

  FormFactorContext context_;
  PairIntegrator integrate_;
  std::vector<ElementCluster> clusters_;
  Blockers blockers_;
  VisibilitySampler visibility_;
};

}  // namespace interflect::fem
