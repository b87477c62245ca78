#include "fem/form_factor/gauss_lambert.h"

#include <algorithm>
#include <optional>

namespace interflect::fem {

/// All pairs of two clusters: what may lie between the clusters is found once, when first asked for.
class GaussLambert::ClusterPair {
 public:
  ClusterPair(const GaussLambert& method, const ElementCluster& a, const ElementCluster& b)
      : method_(method), a_(a), b_(b) {}

  void exchange(Index i, Index j, ExchangeSink& sink, VisibilitySampler::Workspace& workspace, PairCounts& counts) {
    const PairIntegral unoccluded = method_.integrate_(i, j);
    if (unoccluded.facing == Facing::away) {
      ++counts.facing_away;
      return;
    }
    const ElementShapes& shapes = method_.integrate_.shapes();
    const double smaller = std::min(shapes[i].area, shapes[j].area), value = std::clamp(unoccluded.value, 0.0, smaller);
    counts.clamped += value != unoccluded.value;
    if (proved_clear(i, j)) {
      ++counts.clear;
      sink.add(i, j, {value, 0, unoccluded.error});
      return;
    }
    const SampledVisibility v = method_.visibility_(i, j, effort_for(value / smaller), workspace);
    ++counts.sampled;
    counts.rays += static_cast<std::uint64_t>(v.rays);
    sink.add(i, j, {value * v.visible, value * v.standard_error, unoccluded.error});
  }

 private:
  static constexpr std::size_t longest_list = 128;  ///< beyond, a pair finds its own through the tree

  bool proved_clear(Index i, Index j) {
    if (!candidates_) find_candidates();
    if (planar_ && candidates_->empty()) return true;
    const ElementShapes& shapes = method_.integrate_.shapes();
    const geometry::Shaft shaft(shapes[i].ring(), shapes[j].ring(), shapes.plane_tolerance());
    return planar_ ? !method_.blockers_.any(shaft, *candidates_) : !method_.blockers_.any(shaft);
  }
  void find_candidates() {
    candidates_.emplace();
    planar_ = a_.rectangle && b_.rectangle;
    if (!planar_) return;
    const double rounding = method_.integrate_.shapes().plane_tolerance();
    *candidates_ = method_.blockers_.candidates(geometry::Shaft(*a_.rectangle, *b_.rectangle, rounding));
    if (candidates_->size() > longest_list) planar_ = false;
  }

  const GaussLambert& method_;
  const ElementCluster &a_, &b_;
  bool planar_ = false;
  std::optional<std::vector<std::uint32_t>> candidates_;
};

GaussLambert::GaussLambert(const FormFactorContext& context)
    : context_(context),
      integrate_(context.patches, context.tolerance),
      clusters_(clusters_of(context.patches, integrate_.shapes())),
      blockers_(context.scene, integrate_.shapes().origin()),
      visibility_(context.patches, context.rays, context.visibility_rays, context.seed) {}

PairCounts GaussLambert::exchange(const ElementBlock& rows, const ElementBlock& columns, ExchangeSink& sink,
                                  const Run& run) const {
  PairCounts counts;
  VisibilitySampler::Workspace workspace;
  const auto within = [](const ElementBlock& block, const ElementCluster& cluster) {
    const auto begin = std::lower_bound(cluster.elements.begin(), cluster.elements.end(), block.first);
    return std::span(begin, std::lower_bound(begin, cluster.elements.end(), block.first + block.count));
  };
  for (const ElementCluster& a : clusters_) {
    const auto of_rows = within(rows, a);
    if (of_rows.empty()) continue;
    run.throw_if_stopped("form factors");
    for (const ElementCluster& b : clusters_) {
      const auto of_columns = within(columns, b);
      ClusterPair between(*this, a, b);
      for (const Index i : of_rows)
        for (const Index j : of_columns)
          if (i < j) between.exchange(i, j, sink, workspace, counts);
    }
  }
  return counts;
}

}  // namespace interflect::fem
