#include "scene/io/mesh_import.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <unordered_map>

#include "core/error.h"
#include "core/format.h"
#include "geometry/plane_coordinates.h"
#include "scene/io/text_file.h"

namespace interflect::scene::io {
namespace {

using Triangles = std::vector<geometry::TriangleCorners>;

/// Area over the squared diameter below which a face has none.
constexpr double flatness = 1e-12;

/// Width of a face below which it may not be cut further, in units of its coordinates' rounding: its quarters would
/// have no area.
constexpr double resolution = 64 * std::numeric_limits<double>::epsilon();

/// Area at which a ring has none [m²].
double least_area(std::span<const Vec3> ring) {
  const geometry::Box box = geometry::box_of(ring);
  const double diameter = box.diagonal().norm(),
               distance = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  return diameter * std::max(flatness * diameter, resolution * distance);
}

bool has_area(std::span<const Vec3> ring) {
  return ring.size() >= 3 && geometry::vector_area(ring).norm() > least_area(ring);
}

/// Whether a ring without area is no line, but has edges that cross, such that its loops cancel.
bool is_bow_tie(std::span<const Vec3> ring) {
  const std::size_t n = ring.size();
  Vec3 normal = Vec3::Zero();  // of the largest triangle at the first corner
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const Vec3 turn = (ring[k] - ring[0]).cross(ring[k + 1] - ring[0]);
    if (turn.squaredNorm() > normal.squaredNorm()) normal = turn;
  }
  const double least = 2 * least_area(ring);
  if (normal.norm() <= least) return false;
  const geometry::AxisShadow shadow(normal);
  const auto side = [&](std::size_t a, std::size_t b, std::size_t c) {
    const Vec2 ab = shadow(ring[b]) - shadow(ring[a]), ac = shadow(ring[c]) - shadow(ring[a]);
    const double twice = ab.x() * ac.y() - ab.y() * ac.x();
    return twice > least ? 1 : twice < -least ? -1 : 0;
  };
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t c = a + 2; c < n; ++c) {
      const std::size_t b = (a + 1) % n, d = (c + 1) % n;
      if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) return true;
    }
  return false;
}

/// Faces of which something is said: how many, and the names of the first.
class NotedFaces {
 public:
  bool names_more() const { return count_ < most; }
  void add(const std::string& name) {
    if (names_more()) names_ += (count_ == 0 ? "" : ", ") + name;
    ++count_;
  }
  std::size_t count() const { return count_; }
  /// "2 degenerate faces dropped: box/4, box/7".
  std::string text(const char* one, const char* many) const {
    return core::format("%zu %s: ", count_, count_ == 1 ? one : many) + names_ + (count_ > most ? ", .." : "");
  }

 private:
  static constexpr std::size_t most = 3;
  std::size_t count_ = 0;
  std::string names_;
};

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
             const MeshRepair& repair, const std::string& shown, MeshSurfaces surfaces)
      : builder_(builder), mesh_(mesh), materials_(materials), repair_(repair), shown_(shown), surfaces_(surfaces) {}

  std::vector<std::size_t> run() {
    for (const MeshFile::Face& face : mesh_.faces) add(face);
    for (auto& part : parts_) finish(part);
    const auto say = [&](std::vector<Note>& notes, const NotedFaces& faces, const char* one, const char* many) {
      if (faces.count() > 0) notes.push_back({shown_, faces.text(one, many)});
    };
    auto& repairs = builder_.scene().repairs;
    say(repairs, degenerate_, "degenerate face dropped", "degenerate faces dropped");
    say(repairs, duplicate_, "duplicate face dropped", "duplicate faces dropped");
    say(repairs, bent_, "face that is not planar split into triangles",
        "faces that are not planar split into triangles");
    say(builder_.scene().warnings, reversed_, "face lies on another that faces the other way",
        "faces lie on others that face the other way");
    if (first_face_.empty()) throw core::InputError(shown_, "no face with an area is left");
    return std::move(first_face_);
  }

 private:
  struct Part {
    const MeshFile::Face* first;
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

  std::size_t position_of(const MeshFile::Face& face) const {
    return static_cast<std::size_t>(&face - mesh_.faces.data());
  }
  /// With its number in the file.
  std::string name_of(const MeshFile::Face& face) const {
    return shown_word(label_of(mesh_, face, shown_)) + core::format("/%zu", position_of(face) + 1);
  }
  void note(NotedFaces& faces, const MeshFile::Face& face) const {
    faces.add(faces.names_more() ? name_of(face) : std::string());
  }

  void add(const MeshFile::Face& face) {
    const geometry::Ring ring = ring_of(face);
    if (!has_area(ring)) {
      if (ring.size() > 3 && is_bow_tie(ring)) fail_crossing(face);
      return drop_degenerate(face);
    }
    if (repeats_another(face, ring)) return;
    Part& part = part_of(face);
    if (part.faces++ == 0) part.only = ring;
    const std::size_t before = part.triangles.size();
    if (!triangulate(face, ring, part.triangles)) part.only.clear();
    if (part.triangles.size() == before) drop_degenerate(face);
  }

  void drop_degenerate(const MeshFile::Face& face) {
    if (!repair_.drop_degenerate)
      throw core::InputError(shown_, "the face " + name_of(face) + " has no area (\"drop_degenerate\" would drop it)");
    note(degenerate_, face);
  }

  [[noreturn]] void fail_crossing(const MeshFile::Face& face) const {
    throw core::InputError(shown_, "the face " + name_of(face) +
                                       " crosses itself: what it encloses is not defined; are its corners in order?");
  }

  /// Appends a face's triangles; false if it is not a planar polygon.
  bool triangulate(const MeshFile::Face& face, const geometry::Ring& ring, Triangles& out) {
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
    if (!planar) note(bent_, face);
    try {
      const Triangles cut = geometry::triangulate_face(ring);
      if (planar || cut.size() == ring.size() - 2) {  // fewer: it is bent so far that parts of it stand upright
        append(cut);
        return planar;
      }
    } catch (const geometry::Defect&) {
      fail_crossing(face);
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
        note(duplicate_, face);
        return true;
      }
      if (way < 0) note(reversed_, face);
      break;
    }
    same_key.push_back(&face);
    return false;
  }

  Part& part_of(const MeshFile::Face& face) {
    std::size_t at = parts_.size();
    if (surfaces_ == MeshSurfaces::of_groups) at = part_at_.try_emplace({face.group, face.material}, at).first->second;
    if (at == parts_.size()) parts_.push_back({&face, {}, 0, {}});
    return parts_[at];
  }

  void finish(const Part& part) {
    if (part.triangles.empty()) return;
    first_face_.push_back(position_of(*part.first));
    const std::string name = label_of(mesh_, *part.first, shown_);
    const MaterialId material = materials_[part.first->material];
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
  const MeshSurfaces surfaces_;
  std::vector<Part> parts_;
  std::vector<std::size_t> first_face_;  ///< of each new surface
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> part_at_;
  std::unordered_map<std::size_t, std::vector<const MeshFile::Face*>> seen_;
  NotedFaces degenerate_, duplicate_, reversed_, bent_;
};

}  // namespace

std::string label_of(const MeshFile& mesh, const MeshFile::Face& face, const std::string& shown) {
  const std::string &group = mesh.groups[face.group], &material = mesh.materials[face.material];
  if (group.empty() && material.empty()) return one_line(std::filesystem::path(shown).stem().string());
  if (group.empty() || group == material) return one_line(material);
  return one_line(material.empty() ? group : group + "/" + material);
}

std::vector<std::size_t> import_mesh(SceneBuilder& builder, const MeshFile& mesh,
                                     const std::vector<MaterialId>& materials, const MeshRepair& repair,
                                     const std::string& shown, MeshSurfaces surfaces) {
  return MeshImport(builder, mesh, materials, repair, shown, surfaces).run();
}

}  // namespace interflect::scene::io
