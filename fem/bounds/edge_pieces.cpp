#include "fem/bounds/edge_pieces.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "fem/bounds/line_box.h"
#include "geometry/box_tree.h"

namespace interflect::fem {
namespace {

/// Points that are told apart, and which of them each corner is: the first that is near enough, in their order along a
/// direction in which few corners of any building are level.
class Corners {
 public:
  Corners(std::span<const FacetCell> cells, double tolerance) {
    std::vector<Vec3> all;
    for (const FacetCell& cell : cells) all.insert(all.end(), cell.ring.begin(), cell.ring.end());
    const Vec3 oblique = Vec3(0.5426, 0.6211, 0.5655).normalized();
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::uint32_t k = 0; k < all.size(); ++k) order.emplace_back(oblique.dot(all[k]), k);
    std::sort(order.begin(), order.end());
    number_.resize(all.size());
    std::vector<double> place;  // of the points along the direction
    for (const auto& [along, k] : order) {
      std::size_t point = points_.size();
      while (point > 0 && place[point - 1] >= along - tolerance && (points_[point - 1] - all[k]).norm() > tolerance)
        --point;
      if (point == 0 || place[point - 1] < along - tolerance) {
        point = points_.size() + 1;
        points_.push_back(all[k]);
        place.push_back(along);
      }
      number_[k] = static_cast<std::uint32_t>(point - 1);
    }
  }
  std::span<const Vec3> points() const { return points_; }
  /// Of all cells' rings, one after another.
  std::span<const std::uint32_t> numbers() const { return number_; }

 private:
  std::vector<Vec3> points_;
  std::vector<std::uint32_t> number_;
};

class Cutter {
 public:
  Cutter(std::span<const Vec3> points, double tolerance) : points_(points), tolerance_(tolerance) {
    std::vector<geometry::Box> boxes;
    for (const Vec3& x : points) boxes.emplace_back(x);
    tree_ = geometry::BoxTree(boxes);
  }

  /// Numbers of the pieces between two points.
  const std::vector<std::uint32_t>& pieces(std::uint32_t a, std::uint32_t b) {
    std::vector<std::uint32_t>& pieces = edges_[key(a, b)];
    if (pieces.empty()) cut(std::min(a, b), std::max(a, b), pieces);
    return pieces;
  }
  std::uint32_t count() const { return static_cast<std::uint32_t>(numbers_.size()); }

 private:
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
  }
  void cut(std::uint32_t a, std::uint32_t b, std::vector<std::uint32_t>& pieces) {
    const Vec3 &from = points_[a], along = points_[b] - from;
    const double square = along.squaredNorm();
    std::vector<std::pair<double, std::uint32_t>> between;
    tree_.traverse([&](const geometry::Box& box) { return passes_box(from, along, 0, 1, box, tolerance_); },
                   [&](std::uint32_t k) {
                     const double t = along.dot(points_[k] - from) / square;
                     if (k == a || k == b || t <= 0 || t >= 1) return;
                     if ((from + t * along - points_[k]).norm() <= tolerance_) between.emplace_back(t, k);
                   });
    std::sort(between.begin(), between.end());
    between.emplace_back(1, b);
    std::uint32_t last = a;
    for (const auto& [t, k] : between) {
      pieces.push_back(numbers_.try_emplace(key(last, k), count()).first->second);
      last = k;
    }
  }

  std::span<const Vec3> points_;
  double tolerance_;
  geometry::BoxTree tree_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> edges_;
  std::unordered_map<std::uint64_t, std::uint32_t> numbers_;  ///< of pieces
};

/// What occurs an odd number of times.
std::vector<std::uint32_t> odd_ones(std::vector<std::uint32_t> all) {
  std::sort(all.begin(), all.end());
  std::vector<std::uint32_t> odd;
  for (const std::uint32_t k : all)
    if (!odd.empty() && odd.back() == k)
      odd.pop_back();
    else
      odd.push_back(k);
  return odd;
}

}  // namespace

EdgePieces edge_pieces(std::span<const FacetCell> cells, double tolerance) {
  const Corners corners(cells, tolerance);
  Cutter cutter(corners.points(), tolerance);
  EdgePieces out;
  std::size_t first = 0;
  for (const FacetCell& cell : cells) {
    const std::size_t n = cell.ring.size();
    std::vector<std::uint32_t> around;
    for (std::size_t k = 0; k < n; ++k) {
      const std::uint32_t a = corners.numbers()[first + k], b = corners.numbers()[first + (k + 1) % n];
      if (a == b) continue;
      const std::vector<std::uint32_t>& pieces = cutter.pieces(a, b);
      around.insert(around.end(), pieces.begin(), pieces.end());
    }
    out.of.push_back(odd_ones(std::move(around)));
    first += n;
  }
  out.count = cutter.count();
  return out;
}

}  // namespace interflect::fem
