#include "scene/io/view3d_scene.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "core/format.h"
#include "geometry/box.h"
#include "scene/io/placement.h"

namespace interflect::scene::io {
namespace {

using geometry::Ring;
using Kind = View3dSurface::Kind;

/// Lengths below it, in units of a polygon's diameter, are rounding: as planarity_tolerance has it.
constexpr double slack = geometry::planarity_tolerance;

/// The part of a convex ring in front of a plane; corners nearer than `tolerance` lie on it.  Empty where that has no
/// corner inside.
Ring in_front(const Ring& ring, const geometry::Plane& plane, double tolerance) {
  std::vector<double> distance;
  for (const Vec3& x : ring) {
    const double d = plane.distance(x);
    distance.push_back(std::abs(d) <= tolerance ? 0 : d);
  }
  if (std::none_of(distance.begin(), distance.end(), [](double d) { return d > 0; })) return {};
  Ring kept;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const std::size_t next = (k + 1) % ring.size();
    const double d = distance[k], e = distance[next];
    if (d >= 0) kept.push_back(ring[k]);
    if (d * e < 0) kept.push_back(ring[k] + (d / (d - e)) * (ring[next] - ring[k]));
  }
  return kept;
}

/// A polygon as convex rings.
std::vector<Ring> convex_parts(const Ring& ring) {
  const Vec3 normal = geometry::vector_area(ring);
  const std::size_t n = ring.size();
  bool convex = true;
  for (std::size_t k = 0; k < n; ++k)
    convex &= (ring[(k + 1) % n] - ring[k]).cross(ring[(k + 2) % n] - ring[(k + 1) % n]).dot(normal) > 0;
  if (convex) return {ring};
  std::vector<Ring> parts;
  for (const auto& t : geometry::triangulate({ring, {}})) parts.push_back({t.begin(), t.end()});
  return parts;
}

/// What of convex rings lies outside of another in their plane (of either orientation).
std::vector<Ring> outside(const std::vector<Ring>& rings, const Ring& cut, double tolerance) {
  const Vec3 normal = geometry::vector_area(cut).normalized();
  std::vector<Ring> out;
  for (Ring rest : rings)
    for (std::size_t k = 0; k < cut.size() && !rest.empty(); ++k) {
      const Vec3 across = (cut[(k + 1) % cut.size()] - cut[k]).cross(normal).normalized();
      const geometry::Plane beyond{across, across.dot(cut[k])}, within{-across, -across.dot(cut[k])};
      if (Ring part = in_front(rest, beyond, tolerance); !part.empty()) out.push_back(std::move(part));
      rest = in_front(rest, within, tolerance);
    }
  return out;
}

double area_of(const Ring& ring) { return geometry::vector_area(ring).norm(); }

std::string material_name(double emittance) { return core::format("emittance %.6g", emittance); }

class View3dImport {
 public:
  View3dImport(SceneBuilder& builder, ExchangeScene& out, const std::vector<View3dSurface>& surfaces, Sides sides,
               const std::string& shown)
      : builder_(builder), out_(out), surfaces_(surfaces), sides_(sides), shown_(shown), covers_(surfaces.size()) {}

  void run() {
    for (std::size_t k = 0; k < surfaces_.size(); ++k) {
      require_polygon(k);
      if (surfaces_[k].base != 0) covers_[surfaces_[k].base - 1].push_back(k);
    }
    for (std::size_t k = 0; k < surfaces_.size(); ++k) require_within_base(k);
    std::vector<std::optional<SurfaceId>> id(surfaces_.size());
    for (std::size_t k = 0; k < surfaces_.size(); ++k)
      if (surfaces_[k].kind == Kind::radiating || surfaces_[k].kind == Kind::obstruction) id[k] = add(k);
    for (std::size_t k = 0; k < surfaces_.size(); ++k)
      if (surfaces_[k].kind == Kind::mask) add_mask(k, id[surfaces_[k].base - 1]);
    note("%zu surface(s) left out: others cover them", covered_);
    note("%zu emittance(s) of 0 taken for 0.001", black_mirrors_);
  }

 private:
  [[noreturn]] void fail(std::size_t k, const std::string& message) const {
    throw core::InputError(core::format("%s:%d", shown_.c_str(), surfaces_[k].line),
                           core::format("surface %zu ('%s') ", k + 1, surfaces_[k].name.c_str()) + message);
  }
  void note(const char* pattern, std::size_t count) {
    if (count == 0) return;
    std::string text = pattern;
    text.replace(text.find("%zu"), 3, std::to_string(count));
    builder_.scene().repairs.push_back({shown_, text});
  }

  void require_polygon(std::size_t k) const {
    for (const Vec3& x : surfaces_[k].ring)
      if (!is_within_reach(x)) fail(k, "cannot be used: a corner " + out_of_reach(x));
    try {
      geometry::require_valid({surfaces_[k].ring, {}});
    } catch (const geometry::Defect& defect) {
      fail(k, std::string("cannot be used: ") + defect.what());
    }
  }

  double tolerance(std::size_t k) const { return slack * geometry::box_of(surfaces_[k].ring).diagonal().norm(); }

  void require_within_base(std::size_t k) const {
    const View3dSurface& s = surfaces_[k];
    if (s.base == 0) return;
    const Ring& base = surfaces_[s.base - 1].ring;
    const geometry::Plane plane = geometry::plane_of(base);
    for (const Vec3& x : s.ring)
      if (std::abs(plane.distance(x)) > 10 * tolerance(s.base - 1))
        fail(k, core::format("does not lie in the plane of its base, surface %zu", s.base));
    const bool same_way = geometry::plane_of(s.ring).normal.dot(plane.normal) > 0;
    if (same_way != (s.kind == Kind::radiating))
      fail(k, core::format(
                  same_way ? "must face its base, surface %zu" : "must face the way that its base faces, surface %zu",
                  s.base));
  }

  /// What is left of a surface beside those that cover it, as convex rings.
  std::vector<Ring> uncovered(std::size_t k) const {
    const Ring& ring = surfaces_[k].ring;
    std::vector<Ring> rest = convex_parts(ring);
    double expected = area_of(ring);
    for (const std::size_t cover : covers_[k]) {
      for (const Ring& part : convex_parts(surfaces_[cover].ring)) rest = outside(rest, part, tolerance(k));
      expected -= area_of(surfaces_[cover].ring);
      double left = 0;
      for (const Ring& part : rest) left += area_of(part);
      if (std::abs(left - expected) > 10 * slack * area_of(ring))
        fail(cover, core::format("does not lie within its base, surface %zu, or overlaps another one there", k + 1));
    }
    return rest;
  }

  MaterialId material(double emittance, bool neutral) {
    if (!neutral && emittance < 1e-3) {  // a reflectance is below 1; View3D does the same
      emittance = 1e-3;
      ++black_mirrors_;
    }
    const auto [at, is_new] = materials_.try_emplace(neutral ? -1 : emittance);
    if (!is_new) return at->second;
    Material material;
    material.name = neutral ? "obstruction" : material_name(emittance);
    for (int c = 0; c < builder_.scene().channel_count(); ++c) material.reflectance[c] = neutral ? 0.5 : 1 - emittance;
    material.sides = sides_;
    return at->second = builder_.add_material(material);
  }

  std::optional<SurfaceId> add(std::size_t k) {
    const View3dSurface& s = surfaces_[k];
    const bool obstruction = s.kind == Kind::obstruction;
    const std::vector<Ring> rest = uncovered(k);  // complains where the parts do not fit
    std::vector<geometry::TriangleCorners> triangles;
    for (const Ring& ring : rest)
      for (std::size_t c = 1; c + 1 < ring.size(); ++c)
        if (area_of({ring[0], ring[c], ring[c + 1]}) > slack * slack * area_of(s.ring))
          triangles.push_back({ring[0], ring[c], ring[c + 1]});
    if (triangles.empty()) {
      ++covered_;
      return std::nullopt;
    }
    const SurfaceId id = add_shape(k, triangles, material(s.emittance, obstruction));
    ExchangeSurface about;
    about.group = s.combined_with != 0 ? surfaces_[s.combined_with - 1].name : s.name;
    about.role = obstruction ? ExchangeRole::only_occludes : ExchangeRole::radiates;
    if (!obstruction) about.emittance = s.emittance;
    out_.surfaces.push_back(std::move(about));
    return id;
  }

  /// A polygon with holes where the covers do not touch, else the triangles beside them.
  SurfaceId add_shape(std::size_t k, std::span<const geometry::TriangleCorners> triangles, MaterialId material) {
    geometry::PlanarPolygon polygon{surfaces_[k].ring, {}};
    for (const std::size_t cover : covers_[k]) polygon.holes.push_back(surfaces_[cover].ring);
    try {
      return builder_.add_polygon(surfaces_[k].name, polygon, material);
    } catch (const geometry::Defect&) {
      return builder_.add_facets(surfaces_[k].name, triangles, material);
    }
  }

  void add_mask(std::size_t k, const std::optional<SurfaceId>& base) {
    if (!base) fail(k, core::format("covers all that is left of its base, surface %zu", surfaces_[k].base));
    const View3dSurface& s = surfaces_[k];
    out_.masks.push_back({s.name, *base, area_of(s.ring), std::max(s.emittance, 1e-3), s.ring,
                          material_name(std::max(s.emittance, 1e-3))});
  }

  SceneBuilder& builder_;
  ExchangeScene& out_;
  const std::vector<View3dSurface>& surfaces_;
  Sides sides_;
  const std::string& shown_;
  std::vector<std::vector<std::size_t>> covers_;  ///< of a surface: what lies on it
  std::map<double, MaterialId> materials_;        ///< by emittance; -1: of obstructions
  std::size_t covered_ = 0, black_mirrors_ = 0;
};

}  // namespace

void import_view3d(SceneBuilder& builder, ExchangeScene& out, const std::vector<View3dSurface>& surfaces, Sides sides,
                   const std::string& shown) {
  View3dImport(builder, out, surfaces, sides, shown).run();
}

}  // namespace interflect::scene::io
