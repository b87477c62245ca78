#include "fem/form_factor/hidden_exchange.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fem/form_factor/four_parts.h"
#include "fem/form_factor/moment_integrand.h"
#include "fem/form_factor/point_to_polygon.h"
#include "fem/quadrature.h"
#include "geometry/segment.h"

namespace interflect::fem {

namespace {

using geometry::ConvexBlocker;
using geometry::HiddenPart;
using Blockers = std::span<const ConvexBlocker* const>;

constexpr std::size_t most_cells = 20'000;
constexpr std::size_t most_events = 24;  ///< beyond, the element is cut in four first: the parts have fewer each
constexpr std::size_t most_kinks = 12;   ///< of one cell at a time
constexpr int deepest = 2;
constexpr int rungs = 4;
constexpr double smooth = 0.5;       ///< cells are climbed on whose radius is at most that part of their distance
constexpr double same_place = 1e-9;  ///< of corners, beside the radius of the inner element

/// Of a rung's rule: 1, 2, 4, 6 on triangles, 1, 3, 5, 7 on quads.
int degree_of(int rung, std::size_t corners) { return corners == 4 || rung == 0 ? 2 * rung + 1 : 2 * rung; }
const Rule& rule_of(int rung, std::size_t corners) {
  static const std::array<RulePair, rungs> ladder = {
      RulePair{triangle_rule(1), quad_rule(1)}, RulePair{triangle_rule(2), quad_rule(2)},
      RulePair{triangle_rule(4), quad_rule(3)}, RulePair{triangle_rule(6), quad_rule(4)}};
  return ladder[static_cast<std::size_t>(rung)].of(corners);
}

/// Nodes in the middle, near the corners and near the middles of the sides: on the lines themselves one of two forms is
/// as good as the other.
const Rule& closed_rule_of(std::size_t corners) {
  const auto inwards = [](Rule rule) {
    for (RuleNode& node : rule) {
      node.u += 1e-3 * (rule.front().u - node.u);
      node.v += 1e-3 * (rule.front().v - node.v);
    }
    return rule;
  };
  static const RulePair rules{inwards(closed_triangle_rule()), inwards(closed_quad_rule())};
  return rules.of(corners);
}

/// The parts of a cell over what a corner stands for in that rule.
double one_in_corner(std::size_t corners) { return corners == 4 ? 36 : 20; }

/// From a point to what shapes the shadows there: the edges of the inner element and the blockers' [m].
double distance_to_edges(const Vec3& x, std::span<const Vec3> inner, std::span<const PairShadow> shadows) {
  double distance = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < inner.size(); ++k)
    distance = std::min(distance, geometry::distance_to_segment(x, inner[k], inner[k + 1 < inner.size() ? k + 1 : 0]));
  for (const PairShadow& shadow : shadows)
    for (const PairShadow::Edge& edge : shadow.edges())
      distance = std::min(distance, geometry::distance_to_segment(x, edge.from, edge.to));
  return distance;
}

/// Some large odd number for each line of each shadow.
std::uint64_t line_code(std::size_t shadow, std::size_t line) {
  return (2 * (std::uint64_t{shadow} << 20 | std::uint64_t{line}) + 1) * 0x9e3779b97f4a7c15u;
}

std::uint64_t corners_on(const geometry::HalfSpace& half, std::span<const Vec3> corners, double near) {
  const double margin = near * half.normal.norm();
  return static_cast<std::uint64_t>(std::count_if(corners.begin(), corners.end(), [&](const Vec3& x) {
    return std::abs(half.normal.dot(x) - half.offset) <= margin;
  }));
}

double radius_of(std::span<const Vec3> ring) {
  double square = 0;
  for (const Vec3& x : ring.subspan(1)) square = std::max(square, (x - ring[0]).squaredNorm());
  return 0.5 * std::sqrt(square);
}

}  // namespace

/// One pair's integration over cells.
template <class Integrand>
class HiddenExchangeOf<Integrand>::Pair {
 public:
  Pair(HiddenExchangeOf& work, const ElementShape& inner, const Integrand& integrand)
      : work_(work), inner_(inner), integrand_(integrand) {
    work_.cells_.clear();
  }

  /// Cuts a triangle or quad of the outer element into cells between the lines of the events.
  void cover(std::span<const Vec3> ring, int depth) {
    work_.events_.start(ring, inner_.ring());
    for (const PairShadow& shadow : shadows()) work_.events_.add(shadow);
    if (work_.events_.planes().size() > most_events) {
      if (depth == deepest) return add_uncut(ring);
      for (const CellPart& part : four_parts(ring)) cover(part.ring(), depth + 1);
      return;
    }
    work_.rings_.clear();
    work_.rings_.push_back(ring);
    work_.events_.cut(work_.rings_);
    for (std::size_t k = 0; k < work_.rings_.size(); ++k) add(work_.rings_[k]);
  }
  void refine(double tolerance) {
    std::vector<Cell>& cells = work_.cells_;
    for (std::size_t step = 1; !within(tolerance, step) && !cells.empty() && cells.size() < most_cells; ++step) {
      std::pop_heap(cells.begin(), cells.end());
      Cell worst = cells.back();
      cells.pop_back();
      error_ -= worst.error;
      if (worst.rung + 1 < rungs && ratio(worst) <= smooth) {
        climb(worst);
        push(worst);
      } else if (worst.uncut) {
        for (const CellPart& part : four_parts(worst.ring())) cover(part.ring(), deepest);
      } else if (!worst.kinked || !follow_kinks(worst)) {
        for (const CellPart& part : four_parts(worst.ring())) add(Cell{part.corner, part.corners, Hides::none, {}});
      }
    }
  }
  HiddenIntegralOf<Value> result() const {
    HiddenIntegralOf<Value> sum{integrand_.zero(), summed_errors(), all_};
    for (const Cell& cell : work_.cells_) sum.value += cell.value;
    return sum;
  }

 private:
  /// The running sum carries the rounding of what was taken out: it is made afresh now and then, and in the end.
  bool within(double tolerance, std::size_t step) {
    constexpr std::size_t steps_between = 256;
    if (error_ > tolerance && step % steps_between != 0) return false;
    error_ = summed_errors();
    return error_ <= tolerance;
  }
  double summed_errors() const {
    double sum = 0;
    for (const Cell& cell : work_.cells_) sum += cell.error;
    return sum;
  }
  std::span<const PairShadow> shadows() const { return {work_.shadows_.data(), work_.shadow_count_}; }

  /// A convex part between the lines, as quads and at most one triangle.
  void add(std::span<const Vec3> ring) {
    for (std::size_t first = 1; first + 1 < ring.size(); first += 2) {
      Cell cell{{ring[0], ring[first], ring[first + 1], ring[0]}, 3, Hides::none, {}};
      if (first + 2 < ring.size()) cell.corner[cell.corners++] = ring[first + 2];
      add(cell);
    }
  }
  /// With more lines than it is worth to be cut by: integrated as if there were kinks everywhere.
  void add_uncut(std::span<const Vec3> ring) {
    Cell cell{{ring[0], ring[1], ring[2], ring[ring.size() - 1]}, ring.size(), Hides::part, {0, true}};
    cell.kinked = cell.uncut = true;
    all_ = false;
    look_from_border(cell);
    cell.value = integral(cell);
    climb(cell);
    push(cell);
  }
  void add(Cell cell) {
    classify(cell);
    all_ = all_ && cell.hides == Hides::all;
    if (cell.hides == Hides::none) return;
    if (several_hide(cell) || ratio(cell) > smooth) look_from_border(cell);
    cell.value = integral(cell);
    climb(cell);
    push(cell);
  }
  /// What each blocker alone hides from the centroid.
  void classify(Cell& cell) const {
    const RuleNode centre = rule_of(0, cell.corners).front();
    const Vec3 eye = point_on(cell.ring(), centre.u, centre.v);
    cell.hides = Hides::none;
    cell.ratio = radius_of(cell.ring()) / distance_to_edges(eye, inner_.ring(), shadows());
    for (std::size_t k = 0; k < shadows().size(); ++k) {
      work_.look(eye, inner_);
      work_.hide(eye, shadows()[k], work_.part_);
      if (work_.part_.hidden().size() == 0) continue;
      cell.hides = work_.part_.seen().size() == 0 ? Hides::all : Hides::part;
      if (cell.hides == Hides::all) {
        cell.ratio = radius_of(cell.ring()) / distance_to_edges(eye, inner_.ring(), {});
        return;
      }
      cell.parts.add(k);
    }
  }
  static bool several_hide(const Cell& cell) { return cell.hides == Hides::part && cell.parts.several(); }
  /// The integral by nodes near the border; and whether what is seen past several has another form there than from the
  /// middle.
  void look_from_border(Cell& cell) const {
    const Rule& rule = closed_rule_of(cell.corners);
    if (several_hide(cell)) cell.form = form_seen(cell, point_on(cell.ring(), rule.front().u, rule.front().v));
    cell.by_border = integral(cell, rule);
  }
  std::uint64_t form_seen(const Cell& cell, const Vec3& eye) const {
    look_past(cell, eye);
    return work_.form_seen(eye, inner_, cell.parts);
  }
  /// Cuts a cell along what lines there are of two blockers together; false where there are none, or too many.
  bool follow_kinks(const Cell& cell) {
    work_.events_.start(cell.ring(), inner_.ring());
    for (std::size_t k = 0; k < shadows().size(); ++k)
      for (std::size_t l = k + 1; l < shadows().size(); ++l) {
        if (!cell.parts.has(k) || !cell.parts.has(l)) continue;
        work_.events_.add_between(shadows()[k], shadows()[l]);
        if (work_.events_.planes().size() > most_kinks) return false;
      }
    if (work_.events_.planes().empty()) return false;
    work_.rings_.clear();
    work_.rings_.push_back(cell.ring());
    work_.events_.cut(work_.rings_);
    for (std::size_t k = 0; k < work_.rings_.size(); ++k) add(work_.rings_[k]);
    return true;
  }
  void push(const Cell& cell) {
    error_ += cell.error;
    work_.cells_.push_back(cell);
    std::push_heap(work_.cells_.begin(), work_.cells_.end());
  }
  void climb(Cell& cell) const {
    ++cell.rung;
    const Value before = cell.value;
    cell.value = integral(cell);
    cell.error = error_of(cell, Integrand::size(cell.value - before));
  }
  double error_of(const Cell& cell, double difference) const {
    const bool quad = cell.corners == 4;
    const double c = quad && !cell.parts.several() ? 0.5 : 2, q = ratio(cell);
    if (q > smooth)
      return (cell.uncut    ? one_in_corner(cell.corners)
              : cell.kinked ? 2
                            : 1) *
             std::max(std::min(1.0, c * q) * difference, Integrand::size(cell.by_border - cell.value));
    const int degree = std::max(0, degree_of(cell.rung, cell.corners) - integrand_.degrees);
    return c * q * difference + 0.2 * std::pow(q, degree + 1) * Integrand::size(cell.value);
  }
  /// Of the cell to the distance over which its integrand varies; 1 where that has kinks.
  static double ratio(const Cell& cell) { return cell.kinked ? 1 : std::min(1.0, cell.ratio); }
  Value integral(Cell& cell) const { return integral(cell, rule_of(cell.rung, cell.corners)); }
  /// Its nodes may find a kink.
  Value integral(Cell& cell, const Rule& rule) const {
    Value sum = integrand_.zero();
    for (const RuleNode& node : rule)
      sum +=
          node.weight * jacobian(cell.ring(), node.u, node.v) * value_at(cell, point_on(cell.ring(), node.u, node.v));
    return (cell.corners == 3 ? 0.5 : 1.0) * sum;
  }
  Value value_at(Cell& cell, const Vec3& eye) const {
    if (cell.hides == Hides::all) return integrand_.at_whole(eye, inner_.ring());
    look_past(cell, eye);
    if (several_hide(cell) && !cell.kinked) cell.kinked = work_.form_seen(eye, inner_, cell.parts) != cell.form;
    return integrand_.at(eye, work_.part_.hidden());
  }
  void look_past(const Cell& cell, const Vec3& eye) const {
    work_.look(eye, inner_);
    for (std::size_t k = 0; k < shadows().size(); ++k)
      if (cell.parts.has(k)) work_.hide(eye, shadows()[k], work_.part_);
  }

  HiddenExchangeOf& work_;
  const ElementShape& inner_;
  const Integrand& integrand_;
  double error_ = 0;
  bool all_ = true;  ///< is hidden from all cells
};

template <class Integrand>
HiddenIntegralOf<typename Integrand::Value> HiddenExchangeOf<Integrand>::operator()(const ElementShape& outer,
                                                                                    const ElementShape& inner,
                                                                                    const Integrand& integrand,
                                                                                    Blockers blockers,
                                                                                    double tolerance) {
  prepare(outer.ring(), inner.ring(), blockers);
  if (shadow_count_ == 0) return {integrand.zero(), 0, false};
  Pair pair(*this, inner, integrand);
  pair.cover(outer.ring(), 0);
  pair.refine(tolerance);
  return pair.result();
}

template <class Integrand>
typename Integrand::Value HiddenExchangeOf<Integrand>::hidden_at(const Vec3& x, const ElementShape& inner,
                                                                 const Integrand& integrand, Blockers blockers) {
  look(x, inner);
  for (const ConvexBlocker* blocker : blockers) hide(x, *blocker, part_);
  return integrand.at(x, part_.hidden());
}

/// What each blocker is to the pair; those that hide nothing drop out.
template <class Integrand>
void HiddenExchangeOf<Integrand>::prepare(std::span<const Vec3> outer, std::span<const Vec3> inner, Blockers blockers) {
  shadow_count_ = 0;
  if (shadows_.size() < blockers.size()) shadows_.resize(blockers.size());
  for (const ConvexBlocker* blocker : blockers)
    shadow_count_ += shadows_[shadow_count_].prepare(*blocker, outer, inner, rounding_);
}

template <class Integrand>
void HiddenExchangeOf<Integrand>::look(const Vec3& eye, const ElementShape& inner) {
  ++points_;
  relative_.clear();
  for (const Vec3& corner : inner.ring()) relative_.push_back(corner - eye);
  part_.start(relative_);
}

template <class Integrand>
void HiddenExchangeOf<Integrand>::hide(const Vec3& eye, const PairShadow& shadow, HiddenPart& part) {
  if (shadow.touches_eyes()) return hide(eye, shadow.blocker(), part);
  if (part.seen().size() == 0) return;
  shadow_.clear();
  shadow.append(eye, shadow_);
  part.hide(shadow_);
}

template <class Integrand>
void HiddenExchangeOf<Integrand>::hide(const Vec3& eye, const ConvexBlocker& blocker, HiddenPart& part) {
  if (part.seen().size() == 0) return;
  shadow_.clear();
  if (blocker.append_shadow(eye, rounding_, shadow_)) {
    part.hide(shadow_);
  } else if (!blocker.flat()) {  // from within a solid, or from what it stands on, its faces are what hides
    for (const geometry::Ring& face : blocker.faces()) hide(eye, ConvexBlocker::polygon(face), part);
  }
}

/// The form of what is seen of the inner element past some, as one number: how many corners it has on each line of each
/// shadow.
template <class Integrand>
std::uint64_t HiddenExchangeOf<Integrand>::form_seen(const Vec3& eye, const ElementShape& inner,
                                                     const ShadowSet& past) {
  const double near = same_place * inner.radius;
  const std::span<const Vec3> corners = union_corners_(part_.seen(), inner.plane.normal, near);
  std::uint64_t form = corners.size();
  for (std::size_t k = 0; k < shadow_count_; ++k) {
    if (!past.has(k) || shadows_[k].touches_eyes()) continue;
    shadow_.clear();
    shadows_[k].append(eye, shadow_);
    for (std::size_t line = 0; line < shadow_.size(); ++line)
      form += line_code(k, line) * corners_on(shadow_[line], corners, near);
  }
  return form;
}

double LambertOfParts::at(const Vec3&, const geometry::RingList& parts) const {
  double sum = 0;
  for (std::size_t k = 0; k < parts.size(); ++k) sum += point_to_polygon_above_horizon(Vec3::Zero(), normal, parts[k]);
  return sum;
}

double LambertOfParts::at_whole(const Vec3& x, std::span<const Vec3> ring) const {
  return point_to_polygon_above_horizon(x, normal, ring);
}

template class HiddenExchangeOf<LambertOfParts>;
template class HiddenExchangeOf<MomentIntegrand>;

}  // namespace interflect::fem
