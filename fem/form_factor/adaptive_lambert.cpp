#include "fem/form_factor/adaptive_lambert.h"

#include <algorithm>
#include <array>
#include <vector>

#include "fem/form_factor/point_to_polygon.h"
#include "fem/quadrature.h"
#include "scene/place.h"

namespace interflect::fem {

namespace {

constexpr std::size_t most_cells = 4000;

/// A triangle or quad with its integral by one rule, that by its quarters, and the difference.
struct Cell {
  std::array<Vec3, 4> corner;
  std::size_t corners;
  double refined = 0, error = 0;
  std::array<double, 4> quarter_value{};

  std::span<const Vec3> ring() const { return {corner.data(), corners}; }
  friend bool operator<(const Cell& a, const Cell& b) { return a.error < b.error; }
};

class Refinement {
 public:
  Refinement(const Vec3& normal, std::span<const Vec3> inner) : normal_(normal), inner_(inner) {}

  void add(const Cell& cell) { add(cell, by_rule(cell.ring())); }
  void cut_worst() {
    std::pop_heap(cells_.begin(), cells_.end());
    const Cell worst = cells_.back();
    cells_.pop_back();
    value_ -= worst.refined;
    error_ -= worst.error;
    const auto parts = scene::quarters_of(worst.ring());
    for (std::size_t k = 0; k < 4; ++k) add({parts[k], worst.corners}, worst.quarter_value[k]);
  }
  bool within(double tolerance) const { return error_ <= tolerance * value_ || value_ <= 0.0; }
  std::size_t cells() const { return cells_.size(); }

  /// Summed afresh: the running sums carry the rounding of what was taken out.
  Integral result() const {
    Integral sum;
    for (const Cell& cell : cells_) sum.value += cell.refined, sum.error += cell.error;
    return sum;
  }

 private:
  void add(Cell cell, double value) {
    for (std::size_t k = 0; const auto& part : scene::quarters_of(cell.ring()))
      cell.refined += cell.quarter_value[k++] = by_rule({part.data(), cell.corners});
    cell.error = std::abs(cell.refined - value);
    value_ += cell.refined;
    error_ += cell.error;
    cells_.push_back(cell);
    std::push_heap(cells_.begin(), cells_.end());
  }
  double by_rule(std::span<const Vec3> cell) {
    nodes_.clear();
    append_nodes(cell, rules_.of(cell.size()), nodes_);
    double sum = 0.0;
    for (const SurfaceNode& node : nodes_)
      sum += node.weight * point_to_polygon_above_horizon(node.position, normal_, inner_);
    return sum;
  }

  static const RulePair& shared_rules() {
    static const RulePair rules{triangle_rule(5), quad_rule(3)};
    return rules;
  }

  Vec3 normal_;
  std::span<const Vec3> inner_;
  const RulePair& rules_ = shared_rules();
  std::vector<SurfaceNode> nodes_;
  std::vector<Cell> cells_;
  double value_ = 0, error_ = 0;
};

}  // namespace

Integral adaptive_lambert(std::span<const Vec3> outer, const Vec3& normal, std::span<const Vec3> inner,
                          double tolerance) {
  Refinement refinement(normal, inner);
  if (outer.size() == 4) {
    refinement.add(Cell{{outer[0], outer[1], outer[2], outer[3]}, 4});
  } else {
    for (std::size_t k = 2; k < outer.size(); ++k) refinement.add(Cell{{outer[0], outer[k - 1], outer[k]}, 3});
  }
  while (!refinement.within(tolerance) && refinement.cells() < most_cells) refinement.cut_worst();
  return refinement.result();
}

}  // namespace interflect::fem
