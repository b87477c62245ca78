#include "scene/io/mesh_import.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <unordered_map>

#include "core/error.h"
#include "core/format.h"
#include "scene/io/text_file.h"

namespace interflect::scene::io {
namespace {

using Triangles = std::vector<geometry::TriangleCorners>;

/// Area over the squared diameter below which a face has none.
constexpr double flatness = 1e-12;

/// Width of a face below which it may not be cut further, in units of its coordinates' rounding: its quarters would
/// have no area.
constexpr double resolution = 64 * std::numeric_limits<double>::epsilon();

bool has_area(std::span<const Vec3> ring) {
  if (ring.size() < 3) return false;
  const geometry::Box box = geometry::box_of(ring);
  const double diameter = box.diagonal().norm(),
               distance = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  return geometry::vector_area(ring).norm() > diameter * std::max(flatness * diameter, resolution * distance);
}

/// A planar convex quad in two halves at its shorter diagonal; nothing if it is not one.
std::optional<Triangles> split_quad(const geometry::Ring& r) {
  const Vec3 normal = geometry::vector_area(r);
  const double diameter = geometry::box_of(r).diagonal().norm();
  if (geometry::relative_planarity_error({r, {}}) > geometry::planarity_tolerance) return std::nullopt;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 turn = (r[(k + 1) % 4] - r[k]).cross(r[(k + 2) % 4] - r[(k + 1) % 4]);
    if (turn.dot(normal) <= flatness * diameter * diameter * normal.norm()) return std::nullopt;
  }
  if ((r[2] - r[0]).squaredNorm() <= (r[3] - r[1]).squaredNorm())
    return Triangles{{r[0], r[1], r[2]}, {r[0], r[2], r[3]}};
  return Triangles{{r[0], r[1], r[3]}, {r[1], r[2], r[3]}};
}

class MeshImport {
 public:
  MeshImport(SceneBuilder& builder, const MeshFile& mesh, const std::vector<MaterialId>& materials,
             const MeshRepair& repair, const std::string& shown)
      : builder_(builder), mesh_(mesh), materials_(materials), repair_(repair), shown_(shown) {}

  void run() {
    for (const MeshFile::Face& face : mesh_.faces) add(face);
    for (auto& part : parts_) finish(part);
    const auto note = [&](std::size_t count, const char* one, const char* many) {
      if (count > 0)
        builder_.scene().repairs.push_back({shown_, core::format("%zu %s", count, count == 1 ? one : many)});
    };
    note(degenerate_, "degenerate face dropped", "degenerate faces dropped");
    note(duplicate_, "duplicate face dropped", "duplicate faces dropped");
    note(bent_, "face that is not planar split into triangles", "faces that are not planar split into triangles");
    note(crossing_, "face that crosses itself split as a fan", "faces that cross themselves split as fans");
    if (reversed_ > 0)
      builder_.scene().warnings.push_back(
          {shown_, core::format("%zu faces lie on others that face the other way", reversed_)});
    if (builder_.scene().surfaces.size() == first_surface_)
      throw core::InputError(shown_, "no face with an area is left");
  }

 private:
  struct Part {
    std::uint32_t group, material;
    Triangles triangles;
    std::size_t faces = 0;
    geometry::Ring only;  ///< the corners of its face, if it has one and that is a planar polygon
  };

  geometry::Ring ring_of(const MeshFile::Face& face) const {
    geometry::Ring ring;
    for (std::uint32_t k = 0; k < face.corners; ++k) {
      const Vec3& x = mesh_.vertices[mesh_.indices[face.first + k]];
      if (ring.empty() || ring.back() != x) ring.push_back(x);
    }
    while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
    return ring;
  }

  void add(const MeshFile::Face& face) {
    const geometry::Ring ring = ring_of(face);
    if (ring.size() < 3 || !has_area(ring)) return drop_degenerate(face);
    if (repeats_another(face, ring)) return;
    Part& part = part_of(face);
    if (part.faces++ == 0) part.only = ring;
    const std::size_t before = part.triangles.size();
    if (!triangulate(ring, part.triangles)) part.only.clear();
    if (part.triangles.size() == before) drop_degenerate(face);
  }

  void drop_degenerate(const MeshFile::Face& face) {
    if (!repair_.drop_degenerate)
      throw core::InputError(shown_, core::format("face %td has no area (\"drop_degenerate\" would drop it)",
                                                  &face - mesh_.faces.data() + 1));
    ++degenerate_;
  }

  /// Appends a face's triangles; false if it is not a planar polygon.
  bool triangulate(const geometry::Ring& ring, Triangles& out) {
    const auto append = [&](const Triangles& triangles) {  // without the slivers beside a corner in mid-edge
      for (const geometry::TriangleCorners& t : triangles)
        if (has_area(t)) out.push_back(t);
    };
    if (ring.size() == 3) {
      out.push_back({ring[0], ring[1], ring[2]});
      return true;
    }
    if (ring.size() == 4)
      if (const auto halves = split_quad(ring)) {
        append(*halves);
        return true;
      }
    const bool planar = geometry::relative_planarity_error({ring, {}}) <= geometry::planarity_tolerance;
    bent_ += !planar;
    try {
      const Triangles cut = geometry::triangulate_face(ring);
      if (planar || cut.size() == ring.size() - 2) {  // fewer: it is bent so far that parts of it stand upright
        append(cut);
        return planar;
      }
    } catch (const geometry::Defect&) {
      ++crossing_;
    }
    Triangles fan;
    for (std::size_t k = 1; k + 1 < ring.size(); ++k) fan.push_back({ring[0], ring[k], ring[k + 1]});
    append(fan);
    return false;
  }

  /// Faces that share their corners, whichever comes first and whichever way they run, have the same key.
  static std::size_t key_of(const geometry::Ring& ring) {
    std::size_t key = ring.size();
    for (const Vec3& x : ring) {  // a sum: the order does not count
      std::size_t h = 0;
      for (int axis = 0; axis < 3; ++axis)
        h = (h ^ std::hash<double>()(x[axis] + 0.0)) * 0x9E3779B97F4A7C15u + (h >> 31);
      key += h;
    }
    return key;
  }

  /// 1: the same corners in the same direction; -1: in the other; 0: another face.
  static int compare(const geometry::Ring& a, const geometry::Ring& b) {
    if (a.size() != b.size()) return 0;
    const std::size_t n = a.size();
    for (std::size_t start = 0; start < n; ++start) {
      if (b[start] != a[0]) continue;
      bool same = true, reversed = true;
      for (std::size_t k = 1; k < n; ++k) {
        same &= a[k] == b[(start + k) % n];
        reversed &= a[k] == b[(start + n - k) % n];
      }
      if (same) return 1;
      if (reversed) return -1;
    }
    return 0;
  }

  bool repeats_another(const MeshFile::Face& face, const geometry::Ring& ring) {
    auto& same_key = seen_[key_of(ring)];
    const auto& all = builder_.scene().materials;
    for (const MeshFile::Face* other : same_key) {
      const int way = compare(ring_of(*other), ring);
      if (way == 0) continue;
      const MaterialId material = materials_[face.material];
      const bool harmless =
          way > 0 || (material == materials_[other->material] && all[material.value].sides == Sides::both);
      if (harmless && repair_.drop_duplicate) {
        ++duplicate_;
        return true;
      }
      reversed_ += way < 0;
      break;
    }
    same_key.push_back(&face);
    return false;
  }

  Part& part_of(const MeshFile::Face& face) {
    const auto [at, is_new] = part_at_.try_emplace({face.group, face.material}, parts_.size());
    if (is_new) parts_.push_back({face.group, face.material, {}, 0, {}});
    return parts_[at->second];
  }

  std::string name_of(const Part& part) const {
    const std::string &group = mesh_.groups[part.group], &material = mesh_.materials[part.material];
    if (group.empty() && material.empty()) return std::filesystem::path(shown_).stem().string();
    if (group.empty() || group == material) return material;
    return material.empty() ? group : group + "/" + material;
  }

  void finish(const Part& part) {
    if (part.triangles.empty()) return;
    const std::string name = one_line(name_of(part));
    const MaterialId material = materials_[part.material];
    if (part.faces == 1 && !part.only.empty()) {
      try {
        builder_.add_polygon(name, {part.only, {}}, material);
        return;
      } catch (const geometry::Defect&) {  // rounding on the verge: its triangles will do
      }
    }
    builder_.add_facets(name, part.triangles, material);
  }

  SceneBuilder& builder_;
  const MeshFile& mesh_;
  const std::vector<MaterialId>& materials_;
  const MeshRepair& repair_;
  const std::string& shown_;
  std::size_t first_surface_ = builder_.scene().surfaces.size();
  std::vector<Part> parts_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> part_at_;
  std::unordered_map<std::size_t, std::vector<const MeshFile::Face*>> seen_;
  std::size_t degenerate_ = 0, duplicate_ = 0, reversed_ = 0, bent_ = 0, crossing_ = 0;
};

}  // namespace

void import_mesh(SceneBuilder& builder, const MeshFile& mesh, const std::vector<MaterialId>& materials,
                 const MeshRepair& repair, const std::string& shown) {
  MeshImport(builder, mesh, materials, repair, shown).run();
}

}  // namespace interflect::scene::io
