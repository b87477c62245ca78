#include "fem/form_factor/hidden_exchange.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fem/form_factor/point_to_polygon.h"
#include "fem/quadrature.h"
#include "scene/place.h"

namespace interflect::fem {

namespace {

using geometry::ConvexBlocker;
using Blockers = std::span<const ConvexBlocker* const>;

constexpr std::size_t most_cells = 20'000;
constexpr std::size_t most_events = 24;  ///< beyond, the element is quartered first: the parts have fewer each
constexpr int deepest = 5;
constexpr int rungs = 4;

/// Rules of rising degree: 1, 2, 4, 6 on triangles, 1, 3, 5, 7 on quads.
const Rule& rule_of(int rung, std::size_t corners) {
  static const std::array<RulePair, rungs> ladder = {RulePair{triangle_rule(1), quad_rule(1)}, RulePair{triangle_rule(2), quad_rule(2)},
                                                     RulePair{triangle_rule(4), quad_rule(3)}, RulePair{triangle_rule(6), quad_rule(4)}};
  return ladder[static_cast<std::size_t>(rung)].of(corners);
}

double distance_to_segment(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double t = std::clamp(along.dot(x - a) / along.squaredNorm(), 0.0, 1.0);
  return (x - a - t * along).norm();
}

/// From the outer element to what shapes the shadows on it: the blockers' edges and the inner element [m].
double distance_of(const ElementShape& outer, const ElementShape& inner, std::span<const PairShadow> shadows) {
  double distance = (outer.centroid - inner.centroid).norm() - inner.radius;
  for (const PairShadow& shadow : shadows)
    for (const PairShadow::Edge& edge : shadow.edges()) distance = std::min(distance, distance_to_segment(outer.centroid, edge.from, edge.to));
  return distance;
}

double radius_of(std::span<const Vec3> ring) {
  double square = 0;
  for (const Vec3& x : ring.subspan(1)) square = std::max(square, (x - ring[0]).squaredNorm());
  return 0.5 * std::sqrt(square);
}

}  // namespace

/// One pair's integration over cells.
class HiddenExchange::Pair {
 public:
  Pair(HiddenExchange& work, const ElementShape& outer, const ElementShape& inner)
      : work_(work), outer_(outer), inner_(inner), distance_(distance_of(outer, inner, shadows())) {
    work_.cells_.clear();
  }

  /// Cuts a triangle or quad of the outer element into cells between the lines of the events.
  void cover(std::span<const Vec3> ring, int depth) {
    work_.events_.start(ring, inner_.ring());
    for (const PairShadow& shadow : shadows()) work_.events_.add(shadow);
    if (work_.events_.planes().size() > most_events) {
      if (depth == deepest) return give_up(ring);
      for (const auto& part : scene::quarters_of(ring)) cover({part.data(), ring.size()}, depth + 1);
      return;
    }
    work_.rings_.clear();
    work_.rings_.push_back(ring);
    work_.events_.cut(work_.rings_);
    for (std::size_t k = 0; k < work_.rings_.size(); ++k) add(work_.rings_[k]);
  }
  void refine(double tolerance) {
    std::vector<Cell>& cells = work_.cells_;
    while (error_ > tolerance && !cells.empty() && cells.size() < most_cells) {
      std::pop_heap(cells.begin(), cells.end());
      Cell worst = cells.back();
      cells.pop_back();
      value_ -= worst.value;
      error_ -= worst.error;
      if (worst.rung + 1 < rungs && ratio(worst) <= 0.5) {
        climb(worst);
        push(worst);
      } else {
        for (const auto& part : scene::quarters_of(worst.ring())) add(Cell{part, worst.corners});
      }
    }
  }
  /// Summed afresh: the running sums carry the rounding of what was taken out.
  Integral result() const {
    Integral sum = given_up_;
    for (const Cell& cell : work_.cells_) sum.value += cell.value, sum.error += cell.error;
    return sum;
  }

 private:
  std::span<const PairShadow> shadows() const { return {work_.shadows_.data(), work_.shadow_count_}; }

  /// A convex part between the lines, as quads and at most one triangle.
  void add(std::span<const Vec3> ring) {
    for (std::size_t first = 1; first + 1 < ring.size(); first += 2) {
      Cell cell{{ring[0], ring[first], ring[first + 1], ring[0]}, 3};
      if (first + 2 < ring.size()) cell.corner[cell.corners++] = ring[first + 2];
      add(cell);
    }
  }
  /// Half of it may be hidden, or all, or nothing.
  void give_up(std::span<const Vec3> ring) {
    const Cell cell{{ring[0], ring[1], ring[2], ring[ring.size() - 1]}, ring.size(), Hides::all};
    const double half = 0.5 * integral(cell);
    given_up_.value += half;
    given_up_.error += half;
  }
  void add(Cell cell) {
    classify(cell);
    if (cell.hides == Hides::none) return;
    cell.value = integral(cell);
    climb(cell);
    push(cell);
  }
  /// What each blocker alone hides from the centroid.
  void classify(Cell& cell) const {
    const RuleNode centre = rule_of(0, cell.corners).front();
    const Vec3 eye = point_on(cell.ring(), centre.u, centre.v);
    cell.hides = Hides::none;
    int parts = 0;
    for (std::size_t k = 0; k < shadows().size(); ++k) {
      work_.look(eye, inner_);
      work_.hide(eye, shadows()[k]);
      if (work_.part_.hidden().size() == 0) continue;
      cell.hides = work_.part_.seen().size() == 0 ? Hides::all : Hides::part;
      if (cell.hides == Hides::all) return;
      cell.only = ++parts == 1 ? static_cast<int>(k) : -1;
    }
  }
  void push(const Cell& cell) {
    value_ += cell.value;
    error_ += cell.error;
    work_.cells_.push_back(cell);
    std::push_heap(work_.cells_.begin(), work_.cells_.end());
  }
  void climb(Cell& cell) const {
    ++cell.rung;
    const double before = cell.value;
    cell.value = integral(cell);
    const double q = ratio(cell);
    cell.error = std::abs(cell.value - before) * (cell.corners == 4 ? q * q : q);
  }
  /// Of the cell to the distance over which its integrand varies; 1 where that has kinks.
  double ratio(const Cell& cell) const {
    if (cell.hides == Hides::part && cell.only < 0) return 1;
    const double radius = radius_of(cell.ring());
    return radius < distance_ ? radius / distance_ : 1;
  }
  double integral(const Cell& cell) const {
    const double scale = cell.corners == 3 ? 0.5 : 1.0;
    double sum = 0;
    for (const RuleNode& node : rule_of(cell.rung, cell.corners))
      sum += node.weight * jacobian(cell.ring(), node.u, node.v) * factor(cell, point_on(cell.ring(), node.u, node.v));
    return scale * sum;
  }
  double factor(const Cell& cell, const Vec3& eye) const {
    const Vec3& normal = outer_.plane.normal;
    if (cell.hides == Hides::all) return point_to_polygon_above_horizon(eye, normal, inner_.ring());
    work_.look(eye, inner_);
    if (cell.only >= 0) {
      work_.hide(eye, shadows()[static_cast<std::size_t>(cell.only)]);
    } else {
      for (const PairShadow& shadow : shadows()) work_.hide(eye, shadow);
    }
    return work_.factor_of_hidden(normal);
  }

  HiddenExchange& work_;
  const ElementShape &outer_, &inner_;
  double distance_;
  double value_ = 0, error_ = 0;
  Integral given_up_;  ///< parts with too many events
};

Integral HiddenExchange::operator()(const ElementShape& outer, const ElementShape& inner, Blockers blockers, double tolerance) {
  prepare(outer.ring(), inner.ring(), blockers);
  if (shadow_count_ == 0) return {};
  Pair pair(*this, outer, inner);
  pair.cover(outer.ring(), 0);
  pair.refine(tolerance);
  return pair.result();
}

double HiddenExchange::hidden_factor(const Vec3& x, const Vec3& normal, const ElementShape& inner, Blockers blockers) {
  look(x, inner);
  for (const ConvexBlocker* blocker : blockers) hide(x, *blocker);
  return factor_of_hidden(normal);
}

/// What each blocker is to the pair; those that hide nothing drop out.
void HiddenExchange::prepare(std::span<const Vec3> outer, std::span<const Vec3> inner, Blockers blockers) {
  shadow_count_ = 0;
  if (shadows_.size() < blockers.size()) shadows_.resize(blockers.size());
  for (const ConvexBlocker* blocker : blockers) shadow_count_ += shadows_[shadow_count_].prepare(*blocker, outer, inner, rounding_);
}

void HiddenExchange::look(const Vec3& eye, const ElementShape& inner) {
  ++points_;
  relative_.clear();
  for (const Vec3& corner : inner.ring()) relative_.push_back(corner - eye);
  part_.start(relative_);
}

void HiddenExchange::hide(const Vec3& eye, const PairShadow& shadow) {
  if (shadow.touches_eyes()) return hide(eye, shadow.blocker());
  if (part_.seen().size() == 0) return;
  shadow_.clear();
  shadow.append(eye, shadow_);
  part_.hide(shadow_);
}

void HiddenExchange::hide(const Vec3& eye, const ConvexBlocker& blocker) {
  if (part_.seen().size() == 0) return;
  shadow_.clear();
  if (blocker.append_shadow(eye, rounding_, shadow_)) {
    part_.hide(shadow_);
  } else if (!blocker.flat()) {  // from within a solid, or from what it stands on, its faces are what hides
    for (const geometry::Ring& face : blocker.faces()) hide(eye, ConvexBlocker::polygon(face));
  }
}

double HiddenExchange::factor_of_hidden(const Vec3& normal) const {
  double sum = 0;
  for (std::size_t k = 0; k < part_.hidden().size(); ++k)
    sum += point_to_polygon_above_horizon(Vec3::Zero(), normal, part_.hidden()[k]);
  return sum;
}

}  // namespace interflect::fem
