#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/error.h"
#include "core/format.h"
#include "scene/io/mesh_import.h"

namespace interflect::scene::io {
namespace {

struct Cell {
  std::int64_t x, y, z;
  friend bool operator==(const Cell&, const Cell&) = default;
};

struct CellHash {
  std::size_t operator()(const Cell& c) const {
    auto h = static_cast<std::uint64_t>(c.x) * 0x9E3779B97F4A7C15u;
    h = (h ^ static_cast<std::uint64_t>(c.y)) * 0xC2B2AE3D27D4EB4Fu;
    h = (h ^ (h >> 29) ^ static_cast<std::uint64_t>(c.z)) * 0x165667B19E3779F9u;
    return static_cast<std::size_t>(h ^ (h >> 32));
  }
};

/// Vertices in cells as wide as the tolerance: what is near lies in one of 27.
class WeldGrid {
 public:
  WeldGrid(const std::vector<Vec3>& vertices, double tolerance) : vertices_(vertices), tolerance_(tolerance) {}

  /// The first vertex kept within the tolerance; `k` itself, kept from now on, where there is none.
  std::uint32_t representative(std::uint32_t k) {
    const Cell home = cell_of(vertices_[k]);
    for (std::int64_t dx = -1; dx <= 1; ++dx)
      for (std::int64_t dy = -1; dy <= 1; ++dy)
        for (std::int64_t dz = -1; dz <= 1; ++dz)
          if (const auto at = kept_.find({home.x + dx, home.y + dy, home.z + dz}); at != kept_.end())
            for (const std::uint32_t other : at->second)
              if ((vertices_[other] - vertices_[k]).norm() <= tolerance_) return other;
    kept_[home].push_back(k);
    return k;
  }

 private:
  Cell cell_of(const Vec3& x) const {
    const auto along = [&](int axis) { return static_cast<std::int64_t>(std::floor(x[axis] / tolerance_)); };
    return {along(0), along(1), along(2)};
  }

  const std::vector<Vec3>& vertices_;
  double tolerance_;
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> kept_;
};

}  // namespace

void place_vertices(MeshFile& mesh, const Placement& placement, const std::string& shown) {
  for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
    Vec3& x = mesh.vertices[k];
    x = placement(x);
    if (!is_within_reach(x)) throw core::InputError(shown, core::format("vertex %zu ", k + 1) + out_of_reach(x));
  }
}

double finest_weld(const MeshFile& mesh) {
  double largest = 0;
  for (const Vec3& x : mesh.vertices) largest = std::max(largest, x.cwiseAbs().maxCoeff());
  return 1e-15 * largest;
}

std::size_t weld_vertices(MeshFile& mesh, double weld) {
  if (weld <= 0) return 0;
  WeldGrid grid(mesh.vertices, weld);
  std::vector<std::uint32_t> representative(mesh.vertices.size());
  std::size_t welded = 0;
  for (std::uint32_t k = 0; k < representative.size(); ++k) {
    representative[k] = grid.representative(k);
    welded += representative[k] != k;
  }
  for (std::uint32_t& index : mesh.indices) index = representative[index];
  return welded;
}

}  // namespace interflect::scene::io
