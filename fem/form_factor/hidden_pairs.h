#pragma once

#include <algorithm>
#include <vector>

#include "fem/form_factor/hidden_exchange.h"
#include "fem/form_factor/pair_method.h"

namespace interflect::fem {

/// What is hidden of doubtful pairs, exactly: finds what may lie in the way, and clips elements that reach through each
/// other's planes.  In one thread.
template <class Integrand>
class HiddenPairs {
 public:
  using Hidden = HiddenIntegralOf<typename Integrand::Value>;

  /// @param tolerance  relative to the unoccluded K, or to what a sixteenth of a row would give each element, if that
  /// is
  ///                   more: so many of them add up to a sixteenth of the tolerance at most.  What is referred to
  ///                   outlives this.
  HiddenPairs(const ElementShapes& shapes, const Blockers& blockers, double tolerance)
      : shapes_(shapes),
        blockers_(blockers),
        tolerance_(tolerance),
        least_of_row_(1.0 / (16.0 * static_cast<double>(shapes.size()))),
        hidden_(shapes.plane_tolerance()) {}

  /// @param integrand  (outer, i_is_outer): what is integrated over `outer`, i or j of the pair or a part of it
  /// @param add        (hidden, i_is_outer): called once, or for every two parts
  /// @return           whether all of the pair is hidden
  template <class Make, class Add>
  bool operator()(const DoubtfulPair& pair, PairCounts& counts, const Make& integrand, const Add& add) {
    find_blockers(pair);
    const std::uint64_t before = hidden_.points();
    const ElementShape &a = shapes_[pair.i], &b = shapes_[pair.j];
    const double tolerance = tolerance_ * std::max(pair.unoccluded.value, least_of_row_ * std::min(a.area, b.area));
    bool all = true;
    // The outer element is the smaller one, as without occlusion (pair_integral.h).
    const auto between = [&](const ElementShape& p, const ElementShape& q, double share) {
      const bool i_is_outer = p.radius <= q.radius;
      const ElementShape &outer = i_is_outer ? p : q, &inner = i_is_outer ? q : p;
      const Hidden part = hidden_(outer, inner, integrand(outer, i_is_outer), list_, share);
      all = all && part.all;
      add(part, i_is_outer);
    };
    if (pair.unoccluded.facing == Facing::full) {
      between(a, b, tolerance);
    } else {
      const Pieces of_a = pieces_in_front(a, b.plane), of_b = pieces_in_front(b, a.plane);
      const double share = tolerance / static_cast<double>(of_a.count * of_b.count);
      for (std::size_t k = 0; k < of_a.count; ++k)
        for (std::size_t l = 0; l < of_b.count; ++l) between(of_a.shape[k], of_b.shape[l], share);
    }
    ++counts.subtracted;
    counts.points += hidden_.points() - before;
    return all;
  }

 private:
  void find_blockers(const DoubtfulPair& pair) {
    found_.clear();
    blockers_.append_candidates(pair.shaft, pair.among, found_);
    list_.clear();
    for (const std::uint32_t k : found_) list_.push_back(&blockers_[k]);
  }

  const ElementShapes& shapes_;
  const Blockers& blockers_;
  double tolerance_, least_of_row_;
  HiddenExchangeOf<Integrand> hidden_;
  std::vector<std::uint32_t> found_;
  std::vector<const geometry::ConvexBlocker*> list_;
};

}  // namespace interflect::fem
