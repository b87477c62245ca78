#include "fem/form_factor/hybrid.h"

#include <algorithm>

#include "core/estimate.h"
#include "fem/form_factor/exact_occlusion.h"
#include "fem/form_factor/four_parts.h"
#include "fem/form_factor/point_to_polygon.h"
#include "fem/form_factor/visibility.h"
#include "fem/quadrature.h"

namespace interflect::fem {

namespace {

constexpr int side = 4;       // of the grid of rays to j, from each point
constexpr int deepest = 3;    // times that i is cut in four
constexpr double near = 0.5;  ///< radius over distance from which on it is

}  // namespace

/// Visibility from Gauss points of one element.
class Hybrid::Points final : public PairOcclusion {
 public:
  explicit Points(const Hybrid& method)
      : method_(method), exact_(method.shapes(), method.blockers(), method.context().tolerance), rule_(rules_of(2)) {}

  ExchangeEntry operator()(const DoubtfulPair& pair, PairCounts& counts) override {
    if (pair.unoccluded.facing != Facing::full) return exact_(pair, counts);
    const SampledVisibility v = visibility(pair);
    if (v.rays == 0 || normal_95 * v.standard_error > method_.context().tolerance) return exact_(pair, counts);
    ++counts.sampled;
    counts.rays += static_cast<std::uint64_t>(v.rays);
    return {pair.unoccluded.value * v.visible, pair.unoccluded.value * v.standard_error,
            v.visible * pair.unoccluded.error};
  }

 private:
  SampledVisibility visibility(const DoubtfulPair& pair) {
    const ElementShapes& shapes = method_.shapes();
    const bool i_is_outer = shapes[pair.i].radius <= shapes[pair.j].radius;
    const ElementShape &outer = shapes[i_is_outer ? pair.i : pair.j], &inner = shapes[i_is_outer ? pair.j : pair.i];
    nodes_.clear();
    add_nodes(outer.ring(), inner, 0);
    segments_.clear();
    weights_.clear();
    core::RandomNumbers random(method_.seed_, static_cast<std::uint32_t>(pair.i), static_cast<std::uint64_t>(pair.j));
    for (const SurfaceNode& node : nodes_) add_rays(node, outer, inner, random);
    if (segments_.empty()) return {};
    blocked_.resize(segments_.size());
    method_.context().rays.occluded(segments_, blocked_);
    return estimated_visibility(weights_, blocked_);
  }
  void add_nodes(std::span<const Vec3> ring, const ElementShape& inner, int depth) {
    double radius = 0;
    for (const Vec3& x : ring) radius = std::max(radius, 0.5 * (x - ring[0]).norm());
    const double distance = (ring[0] - inner.centroid).norm() - inner.radius;
    if (depth == deepest || radius < near * distance) return append_nodes(ring, rule_.of(ring.size()), nodes_);
    for (const CellPart& part : four_parts(ring)) add_nodes(part.ring(), inner, depth + 1);
  }
  /// The rays of a point share what Lambert's formula gives it, in proportion to their kernels.
  void add_rays(const SurfaceNode& node, const ElementShape& outer, const ElementShape& inner,
                core::RandomNumbers& random) {
    const double factor = node.weight * point_to_polygon_above_horizon(node.position, outer.plane.normal, inner.ring());
    const std::size_t first = weights_.size();
    const Vec3& origin = method_.shapes().origin();
    double sum = 0;
    for (int k = 0; k < side * side; ++k) {
      double u = (k % side + random.next()) / side,
             v = (k / side + random.next()) / side;  // NOLINT(bugprone-integer-division)
      if (inner.corners == 3 && u + v > 1) u = 1 - u, v = 1 - v;
      const Vec3 y = point_on(inner.ring(), u, v), d = y - node.position;
      const double cosines = outer.plane.normal.dot(d) * -inner.plane.normal.dot(d), square = d.squaredNorm();
      if (!(cosines > 0)) continue;
      const double kernel = cosines / (square * square) * jacobian(inner.ring(), u, v);
      sum += kernel;
      weights_.push_back(kernel);
      segments_.push_back({node.position + origin, y + origin, outer.plane.normal, inner.plane.normal});
    }
    for (std::size_t k = first; k < weights_.size(); ++k) weights_[k] *= factor / sum;
  }

  const Hybrid& method_;
  ExactOcclusion exact_;
  RulePair rule_;
  std::vector<SurfaceNode> nodes_;
  std::vector<raycast::Segment> segments_;
  std::vector<double> weights_;
  std::vector<std::uint8_t> blocked_;
};

std::unique_ptr<PairWork> Hybrid::work() const { return std::make_unique<Points>(*this); }

}  // namespace interflect::fem
