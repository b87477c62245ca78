#include "fem/form_factor/exact_occlusion.h"

#include <algorithm>

namespace interflect::fem {

ExactOcclusion::ExactOcclusion(const ElementShapes& shapes, const Blockers& blockers, double tolerance)
    : shapes_(shapes),
      blockers_(blockers),
      tolerance_(tolerance),
      least_of_row_(1.0 / (16.0 * static_cast<double>(shapes.size()))),
      hidden_(shapes.plane_tolerance()) {}

ExchangeEntry ExactOcclusion::operator()(const DoubtfulPair& pair, PairCounts& counts) {
  find_blockers(pair);
  const std::uint64_t before = hidden_.points();
  const HiddenIntegral hidden = hidden_part(pair);
  ++counts.subtracted;
  counts.points += hidden_.points() - before;
  if (hidden.all) return {};
  return {std::max(0.0, pair.unoccluded.value - hidden.value), 0, pair.unoccluded.error + hidden.error};
}

void ExactOcclusion::find_blockers(const DoubtfulPair& pair) {
  found_.clear();
  blockers_.append_candidates(pair.shaft, pair.among, found_);
  list_.clear();
  for (const std::uint32_t k : found_) list_.push_back(&blockers_[k]);
}

/// Elements that reach through each other's planes are clipped first.
HiddenIntegral ExactOcclusion::hidden_part(const DoubtfulPair& pair) {
  const ElementShape &a = shapes_[pair.i], &b = shapes_[pair.j];
  const double tolerance = tolerance_ * std::max(pair.unoccluded.value, least_of_row_ * std::min(a.area, b.area));
  if (pair.unoccluded.facing == Facing::full) return hidden_between(a, b, tolerance);
  HiddenIntegral sum{0, 0, true};
  const Pieces of_a = pieces_in_front(a, b.plane), of_b = pieces_in_front(b, a.plane);
  const double share = tolerance / static_cast<double>(of_a.count * of_b.count);
  for (std::size_t k = 0; k < of_a.count; ++k)
    for (std::size_t l = 0; l < of_b.count; ++l) {
      const HiddenIntegral part = hidden_between(of_a.shape[k], of_b.shape[l], share);
      sum.value += part.value;
      sum.error += part.error;
      sum.all = sum.all && part.all;
    }
  return sum;
}

/// The outer element is the smaller one, as without occlusion (pair_integral.h).
HiddenIntegral ExactOcclusion::hidden_between(const ElementShape& a, const ElementShape& b, double tolerance) {
  return a.radius <= b.radius ? hidden_(a, b, list_, tolerance) : hidden_(b, a, list_, tolerance);
}

}  // namespace interflect::fem
