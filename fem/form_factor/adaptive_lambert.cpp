#include "fem/form_factor/adaptive_lambert.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "fem/form_factor/four_parts.h"
#include "fem/form_factor/point_to_polygon.h"
#include "fem/quadrature.h"
#include "geometry/segment.h"

namespace interflect::fem {

namespace {

constexpr double rounding = 0.5 * std::numeric_limits<double>::epsilon();
/// Cells with s above this touch the outline, or nearly, as far as a rule can tell.
constexpr double rough_from = 0.8;
constexpr double chance_when_cut = 0.3;

/// Rules, and c, f, p, g of the error estimate with them.
struct Scheme {
  RulePair rules;
  double smooth, smooth_floor;
  int power;
  double rough_floor;
};
const Scheme& scheme_for(double tolerance) {
  static const Scheme loose{{triangle_rule(5), quad_rule(3)}, 0.1, 2e-4, 6, 0.016};
  static const Scheme tight{{triangle_rule(8), quad_rule(6)}, 0.02, 1e-6, 10, 0.001};
  return tolerance < 1e-7 ? tight : loose;
}

/// A triangle or quad with its integral by the sum of its four parts', and what that errs by.
struct Cell {
  std::array<Vec3, 4> corner;
  std::size_t corners;
  double refined = 0, error = 0;
  std::array<double, 4> part_value{};
  double spread = 0;  ///< of its parts
  double chance = 1;  ///< of its error being small by chance: many cells even it out

  std::span<const Vec3> ring() const { return {corner.data(), corners}; }
  friend bool operator<(const Cell& a, const Cell& b) { return a.error < b.error; }
};

/// A ring seen against an outline.
struct Standing {
  double radius;    ///< of the ball about the mean of its corners [m]
  double distance;  ///< of that mean from the outline [m]
  double ratio() const { return radius / distance; }
};
Standing standing(std::span<const Vec3> ring, std::span<const Vec3> outline) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : ring) middle += p;
  middle /= static_cast<double>(ring.size());
  Standing result{0.0, std::numeric_limits<double>::infinity()};
  for (const Vec3& p : ring) result.radius = std::max(result.radius, (p - middle).norm());
  for (std::size_t k = 0; k < outline.size(); ++k)
    result.distance =
        std::min(result.distance, geometry::distance_to_segment(middle, outline[k], outline[(k + 1) % outline.size()]));
  return result;
}

/// How much a cell's parts would differ if they had equal areas.
class Spread {
 public:
  void add(double integral, double area) {
    if (!(area > 0)) return;
    area_ += area;
    least_ = std::min(least_, integral / area);
    greatest_ = std::max(greatest_, integral / area);
  }
  double of_four() const { return area_ > 0 ? 0.25 * area_ * (greatest_ - least_) : 0; }

 private:
  double area_ = 0, least_ = std::numeric_limits<double>::infinity(), greatest_ = 0;
};

class Refinement {
 public:
  Refinement(const Vec3& normal, std::span<const Vec3> inner, const Scheme& scheme)
      : normal_(normal), inner_(inner), scheme_(scheme) {}

  void add(const Cell& cell) { add(cell, by_rule(cell.ring())); }
  void cut_worst() {
    std::pop_heap(cells_.begin(), cells_.end());
    const Cell worst = cells_.back();
    cells_.pop_back();
    value_ -= worst.refined;
    error_ -= worst.error;
    for (std::size_t k = 0; const CellPart& part : four_parts(worst.ring()))
      add({part.corner, part.corners, 0.0, 0.0, {}, 0.0, chance_when_cut * worst.chance}, worst.part_value[k++]);
  }
  bool within(double error) const { return error_ <= error || value_ <= 0.0; }
  double value() const { return value_; }
  std::size_t cells() const { return cells_.size(); }

  /// Summed afresh: the running sums carry the rounding of what was taken out.
  Integral result() const {
    Integral sum;
    for (const Cell& cell : cells_) sum.value += cell.refined, sum.error += cell.error;
    return sum;
  }

 private:
  void add(Cell cell, double value) {
    Spread spread;
    for (std::size_t k = 0; const CellPart& part : four_parts(cell.ring())) {
      const double of_part = by_rule(part.ring());
      spread.add(of_part, area_of_nodes());
      cell.refined += cell.part_value[k++] = of_part;
    }
    cell.spread = spread.of_four();
    cell.error = error_of(cell, std::abs(cell.refined - value));
    value_ += cell.refined;
    error_ += cell.error;
    cells_.push_back(cell);
    std::push_heap(cells_.begin(), cells_.end());
  }
  double error_of(const Cell& cell, double difference) const {
    const double spread = cell.chance * cell.spread, s = standing(cell.ring(), inner_).ratio();
    if (!(s < rough_from)) return difference + scheme_.rough_floor * spread;
    return scheme_.smooth * difference + scheme_.smooth_floor * std::pow(s, scheme_.power) * spread;
  }
  /// Of the cell that was last integrated [m²].
  double area_of_nodes() const {
    double sum = 0;
    for (const SurfaceNode& node : nodes_) sum += node.weight;
    return sum;
  }
  double by_rule(std::span<const Vec3> cell) {
    nodes_.clear();
    append_nodes(cell, scheme_.rules.of(cell.size()), nodes_);
    double sum = 0.0;
    for (const SurfaceNode& node : nodes_)
      sum += node.weight * point_to_polygon_above_horizon(node.position, normal_, inner_);
    return sum;
  }

  Vec3 normal_;
  std::span<const Vec3> inner_;
  const Scheme& scheme_;
  std::vector<SurfaceNode> nodes_;
  std::vector<Cell> cells_;
  double value_ = 0, error_ = 0;
};

/// Of Lambert's sum over angles, integrated: the angles are at most perimeter / distance, and 2 pi.
double rounding_of(std::span<const Vec3> outer, const Vec3& normal, std::span<const Vec3> inner) {
  double area = 0.0, perimeter = 0.0;
  for (std::size_t k = 2; k < outer.size(); ++k)
    area += 0.5 * normal.dot((outer[k - 1] - outer[0]).cross(outer[k] - outer[0]));
  for (std::size_t k = 0; k < inner.size(); ++k) perimeter += (inner[(k + 1) % inner.size()] - inner[k]).norm();
  return 2 * rounding * std::abs(area) * std::min(1.0, 0.5 * inv_pi * perimeter / standing(outer, inner).distance);
}

}  // namespace

Integral adaptive_lambert(std::span<const Vec3> outer, const Vec3& normal, std::span<const Vec3> inner,
                          const LambertEffort& effort) {
  Refinement refinement(normal, inner, scheme_for(effort.tolerance));
  if (outer.size() == 4) {
    refinement.add(Cell{{outer[0], outer[1], outer[2], outer[3]}, 4});
  } else {
    for (std::size_t k = 2; k < outer.size(); ++k) refinement.add(Cell{{outer[0], outer[k - 1], outer[k]}, 3});
  }
  const double least = rounding_of(outer, normal, inner);
  while (!refinement.within(std::max(least, effort.tolerance * refinement.value() - least)) &&
         refinement.cells() < effort.most_cells)
    refinement.cut_worst();
  const Integral result = refinement.result();
  return {result.value, result.error + least};
}

double expected_lambert_error(std::span<const Vec3> outer, std::span<const Vec3> inner) {
  const double s = standing(outer, inner).ratio();
  return s < rough_from ? 4e-4 * std::pow(s, 7) : 2e-2;
}

}  // namespace interflect::fem
