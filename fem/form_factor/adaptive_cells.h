#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "fem/form_factor/four_parts.h"
#include "fem/quadrature.h"
#include "geometry/segment.h"

namespace interflect::fem {

/// A ring seen against an outline.
struct Standing {
  double radius;    ///< of the ball about the mean of its corners [m]
  double distance;  ///< of that mean from the outline [m]
  double ratio() const { return radius / distance; }
};
inline Standing standing(std::span<const Vec3> ring, std::span<const Vec3> outline) {
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

/// Cells with a ratio above this touch the outline, or nearly, as far as a rule can tell.
inline constexpr double rough_from = 0.8;

/// Rules, and c, f, p, g of the error estimate with them (adaptive_lambert.h).
struct CellScheme {
  RulePair rules;
  double smooth, smooth_floor;
  int power;
  double rough_floor;
};
/// Below a relative tolerance of 1e-7 rules of order 9 and 12, else of order 6.
const CellScheme& cell_scheme(double tolerance);

/// What adaptive_lambert does, of whatever is integrated over the outer element:
///
///   Value         a number, or a small matrix
///   at(x)         the integrand
///   zero()        of that size
///   size(v)       of the largest entry
///   least(v, w), greatest(v, w)   entry by entry
///
/// The error of a matrix is that of its worst entry.
template <class Integrand>
class AdaptiveCells {
 public:
  using Value = typename Integrand::Value;
  struct Result {
    Value value;
    double error;
  };

  AdaptiveCells(const Integrand& integrand, std::span<const Vec3> outline, const CellScheme& scheme)
      : integrand_(integrand), outline_(outline), scheme_(scheme), value_(integrand.zero()) {}

  void cover(std::span<const Vec3> ring) {
    if (ring.size() == 4) return add({{ring[0], ring[1], ring[2], ring[3]}, 4}, 1);
    for (std::size_t k = 2; k < ring.size(); ++k) add({{ring[0], ring[k - 1], ring[k], ring[0]}, 3}, 1);
  }
  void cut_worst() {
    std::pop_heap(cells_.begin(), cells_.end());
    const Cell worst = std::move(cells_.back());
    cells_.pop_back();
    value_ -= worst.refined;
    error_ -= worst.error;
    for (std::size_t k = 0; const CellPart& part : four_parts(worst.part.ring()))
      add(part, chance_when_cut * worst.chance, worst.part_value[k++]);
  }
  const Value& value() const { return value_; }
  double error() const { return error_; }
  std::size_t cells() const { return cells_.size(); }

  /// Summed afresh: the running sums carry the rounding of what was taken out.
  Result result() const {
    Result sum{integrand_.zero(), 0};
    for (const Cell& cell : cells_) sum.value += cell.refined, sum.error += cell.error;
    return sum;
  }

 private:
  static constexpr double chance_when_cut = 0.3;

  /// A triangle or quad with its integral by the sum of its four parts', and what that errs by.
  struct Cell {
    CellPart part;
    double chance = 1;  ///< of its error being small by chance: many cells even it out
    Value refined;
    std::array<Value, 4> part_value;
    double error = 0;
    friend bool operator<(const Cell& a, const Cell& b) { return a.error < b.error; }
  };

  void add(const CellPart& part, double chance) { add(part, chance, by_rule(part.ring())); }
  void add(const CellPart& part, double chance, const Value& value) {
    Cell cell{part, chance, integrand_.zero(), {}, 0};
    // How much the parts would differ if they had equal areas.
    Value least = integrand_.zero(), greatest = least;
    double area = 0;
    std::size_t k = 0;
    for (const CellPart& quarter : four_parts(part.ring())) {
      cell.part_value[k] = by_rule(quarter.ring());
      cell.refined += cell.part_value[k];
      if (const double of_quarter = area_of_nodes(); of_quarter > 0) {
        const Value mean = cell.part_value[k] / of_quarter;
        least = area > 0 ? Integrand::least(least, mean) : mean;
        greatest = area > 0 ? Integrand::greatest(greatest, mean) : mean;
        area += of_quarter;
      }
      ++k;
    }
    const double spread = 0.25 * area * Integrand::size(greatest - least);
    cell.error = error_of(part.ring(), Integrand::size(cell.refined - value), chance * spread);
    value_ += cell.refined;
    error_ += cell.error;
    cells_.push_back(std::move(cell));
    std::push_heap(cells_.begin(), cells_.end());
  }
  double error_of(std::span<const Vec3> ring, double difference, double spread) const {
    const double s = standing(ring, outline_).ratio();
    if (!(s < rough_from)) return difference + scheme_.rough_floor * spread;
    return scheme_.smooth * difference + scheme_.smooth_floor * std::pow(s, scheme_.power) * spread;
  }
  /// Of the cell that was last integrated [m²].
  double area_of_nodes() const {
    double sum = 0;
    for (const SurfaceNode& node : nodes_) sum += node.weight;
    return sum;
  }
  Value by_rule(std::span<const Vec3> ring) {
    nodes_.clear();
    append_nodes(ring, scheme_.rules.of(ring.size()), nodes_);
    Value sum = integrand_.zero();
    for (const SurfaceNode& node : nodes_) sum += node.weight * integrand_.at(node.position);
    return sum;
  }

  const Integrand& integrand_;
  std::span<const Vec3> outline_;
  const CellScheme& scheme_;
  std::vector<SurfaceNode> nodes_;
  std::vector<Cell> cells_;
  Value value_;
  double error_ = 0;
};

}  // namespace interflect::fem
