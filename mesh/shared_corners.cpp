#include "mesh/shared_corners.h"

#include <map>
#include <optional>
#include <utility>

#include "mesh/shared_points.h"

namespace interflect::mesh {
namespace {

/// One side of a surface.
class Side {
 public:
  Side(const ElementMesh& mesh, const ElementMesh::Part& part, SharedCorners& out)
      : mesh_(mesh), first_(part.first), end_(part.first + part.count), out_(out) {}

  void append() {
    for (std::uint32_t i = first_; i < end_; ++i) number_corners(i);
    for (std::uint32_t i = first_; i < end_; ++i) find_hanging(i);
    means_.resize(corners_.size());
    for (std::uint32_t i = first_; i < end_; ++i) {
      const auto ring = mesh_.patches()[i].ring();
      for (std::size_t k = 0; k < ring.size(); ++k) out_.of[i][k] = mean_of(numbers_[i - first_][k]);
    }
  }

 private:
  struct Corner {
    Vec3 position;
    std::uint32_t element;
    std::optional<std::array<std::uint32_t, 2>> hangs_between;
  };

  void number_corners(std::uint32_t i) {
    const scene::SurfacePatch& patch = mesh_.patches()[i];
    const Vec3 normal = patch.normal();
    std::array<std::uint32_t, 4> numbers{};
    for (std::size_t k = 0; k < patch.ring().size(); ++k) {
      const Vec3& p = patch.ring()[k];
      const auto known = points_.find(p, normal);
      numbers[k] = known.value_or(static_cast<std::uint32_t>(corners_.size()));
      if (known) continue;
      points_.add(p, normal, numbers[k]);
      corners_.push_back({p, i, std::nullopt});
    }
    numbers_.push_back(numbers);
  }

  void find_hanging(std::uint32_t i) {
    const std::size_t count = mesh_.patches()[i].ring().size();
    const Vec3 normal = mesh_.patches()[i].normal();
    const auto& numbers = numbers_[i - first_];
    for (std::size_t k = 0; k < count; ++k) find_between(numbers[k], numbers[(k + 1) % count], normal, 0);
  }
  /// Where an edge was halved on its other side, its middle is a corner there.
  void find_between(std::uint32_t a, std::uint32_t b, const Vec3& normal, int depth) {
    constexpr int deepest = 40;  // halvings of a length that doubles can tell apart
    const auto middle = points_.find(0.5 * (corners_[a].position + corners_[b].position), normal);
    if (depth == deepest || !middle || *middle == a || *middle == b) return;
    corners_[*middle].hangs_between = {a, b};
    find_between(a, *middle, normal, depth + 1);
    find_between(*middle, b, normal, depth + 1);
  }

  /// In terms of corners that do not hang, which are numbered as they come.
  const SharedCorners::Mean& mean_of(std::uint32_t corner) {
    SharedCorners::Mean& mean = means_[corner];
    if (!mean.empty()) return mean;
    // Taken out: of corners that hang on each other's edges all round, as on a zip, one is free.
    const auto ends = std::exchange(corners_[corner].hangs_between, std::nullopt);
    if (!ends) {
      mean = {{static_cast<std::uint32_t>(out_.position.size()), 1.0}};
      out_.position.push_back(corners_[corner].position);
      out_.element.push_back(corners_[corner].element);
      return mean;
    }
    std::map<std::uint32_t, double> weights;
    for (const std::uint32_t end : *ends)
      for (const SharedCorners::Part& part : mean_of(end)) weights[part.corner] += 0.5 * part.weight;
    if (!mean.empty()) return mean;  // that one
    for (const auto& [free, weight] : weights) mean.push_back({free, weight});
    return mean;
  }

  const ElementMesh& mesh_;
  std::uint32_t first_, end_;
  SharedCorners& out_;
  SharedPoints points_;
  std::vector<Corner> corners_;
  std::vector<std::array<std::uint32_t, 4>> numbers_;  ///< of elements' corners
  std::vector<SharedCorners::Mean> means_;
};

}  // namespace

SharedCorners shared_corners(const ElementMesh& mesh) {
  SharedCorners out;
  out.of.resize(mesh.patches().size());
  for (const ElementMesh::Part& part : mesh.parts()) Side(mesh, part, out).append();
  return out;
}

}  // namespace interflect::mesh
