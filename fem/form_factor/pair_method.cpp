#include "fem/form_factor/pair_method.h"

#include <algorithm>

namespace interflect::fem {

/// All pairs of two clusters: what may lie between the clusters is found once, when first asked for.
class PairMethod::ClusterPair {
 public:
  ClusterPair(const PairMethod& method, const ElementCluster& a, const ElementCluster& b)
      : method_(method), a_(a), b_(b) {}

  void exchange(Index i, Index j, ExchangeSink& sink, PairWork& work, PairCounts& counts) {
    const PairIntegral unoccluded = method_.integrate_(i, j);
    if (unoccluded.facing == Facing::away) {
      ++counts.facing_away;
      return;
    }
    const ElementShapes& shapes = method_.shapes();
    const double value = std::clamp(unoccluded.value, 0.0, std::min(shapes[i].area, shapes[j].area));
    counts.clamped += value != unoccluded.value;
    const PairIntegral kept{unoccluded.facing, value, unoccluded.error};
    if (!candidates_) find_candidates();
    if (planar_ && candidates_->empty()) {
      ++counts.clear;
      work.clear(i, j, kept, sink);
      return;
    }
    const geometry::Shaft shaft(shapes[i].ring(), shapes[j].ring(), shapes.plane_tolerance());
    if (planar_ ? !method_.blockers_.any(shaft, *candidates_) : !method_.blockers_.any(shaft)) {
      ++counts.clear;
      work.clear(i, j, kept, sink);
      return;
    }
    work.doubtful({i, j, kept, shaft, planar_ ? &*candidates_ : nullptr}, sink, counts);
  }

 private:
  static constexpr std::size_t longest_list = 128;  ///< beyond, a pair finds its own through the tree

  void find_candidates() {
    candidates_.emplace();
    planar_ = a_.rectangle && b_.rectangle;
    if (!planar_) return;
    *candidates_ =
        method_.blockers_.candidates(geometry::Shaft(*a_.rectangle, *b_.rectangle, method_.shapes().plane_tolerance()));
    if (candidates_->size() > longest_list) planar_ = false;
  }

  const PairMethod& method_;
  const ElementCluster &a_, &b_;
  bool planar_ = false;
  std::optional<std::vector<std::uint32_t>> candidates_;
};

PairMethod::PairMethod(const FormFactorContext& context)
    : context_(context),
      integrate_(context.patches, context.tolerance),
      clusters_(clusters_of(context.patches, integrate_.shapes())),
      cluster_of_(context.patches.size()),
      blockers_(context.scene, integrate_.shapes().origin(), integrate_.shapes().plane_tolerance()) {
  for (std::size_t c = 0; c < clusters_.size(); ++c)
    for (const Index i : clusters_[c].elements) cluster_of_[static_cast<std::size_t>(i)] = c;
}

std::vector<PairMethod::Part> PairMethod::parts_of(const ElementBlock& block) const {
  const Index end = block.first + block.count;
  std::vector<std::size_t> clusters;
  for (Index i = block.first; i < end; ++i) {
    const std::size_t c = cluster_of_[static_cast<std::size_t>(i)];
    if (clusters.empty() || clusters.back() != c) clusters.push_back(c);
  }
  std::sort(clusters.begin(), clusters.end());
  clusters.erase(std::unique(clusters.begin(), clusters.end()), clusters.end());
  std::vector<Part> parts;
  for (const std::size_t c : clusters) {
    const std::vector<Index>& all = clusters_[c].elements;
    const auto begin = std::lower_bound(all.begin(), all.end(), block.first);
    parts.push_back({clusters_[c], {begin, std::lower_bound(begin, all.end(), end)}});
  }
  return parts;
}

PairCounts PairMethod::exchange(const ElementBlock& rows, const ElementBlock& columns, ExchangeSink& sink,
                                const Run& run) const {
  PairCounts counts;
  const std::unique_ptr<PairWork> of_thread = work();
  const std::vector<Part> of_columns = parts_of(columns);
  for (const Part& a : parts_of(rows)) {
    run.throw_if_stopped("form factors");
    for (const Part& b : of_columns) {
      ClusterPair between(*this, a.cluster, b.cluster);
      for (const Index i : a.elements)
        for (const Index j : b.elements)
          if (i < j) between.exchange(i, j, sink, *of_thread, counts);
    }
  }
  return counts;
}

}  // namespace interflect::fem
