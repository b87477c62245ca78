#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace interflect::scene {

/// What is odd about a scene's geometry, found without a single ray, before an hour of work is spent.
struct Inspection {
  struct Finding {
    enum class Kind { gap, rim, inconsistent_normals, duplicate_faces, coplanar_overlap };
    Kind kind;
    std::string surface, other;  ///< names; `other` empty where one surface is concerned
    Vec3 where;                  ///< a point of it [m]
    double size;                 ///< length of the gap or edge [m], or area of the overlap [m²]
    double same_way = 0;         ///< area of the overlap where both fronts look the same way [m²]
    double twice = 0;            ///< area of the overlap where active sides of both look the same way [m²]
  };
  std::vector<Finding> findings;  ///< the largest first within a kind
  double open_edge_length = 0;    ///< [m] of edges that no other facet continues: gaps and rims
  bool closed() const;            ///< neither gap nor rim: every edge is covered by neighbours
  bool has(Finding::Kind kind) const;
};

/// Open edges are found geometrically, T-junctions allowed: an edge is closed where collinear edges of other facets
/// cover it, or where it lies on another facet, as the foot of a wall on a floor (within 1e-6 of the scene's diagonal).
/// What is open is a gap, but the rim of a two-sided surface is told apart: a sheet that stands free has one.  Normals
/// are inconsistent where two one-sided neighbours run along their common edge in the same direction.
Inspection inspect(const Scene& scene);

/// Duplicate faces and coplanar overlaps alone: within 1e-9 of the scene's size, or what its coordinates resolve if that
/// is more, planes count as one, and strips that are no wider do not count.
std::vector<Inspection::Finding> overlaps(const Scene& scene);

std::string describe(Inspection::Finding::Kind kind);

/// "'a' and 'b' lie in one plane and overlap in 2 m2 at (0, 0, 1)", with the area that is there twice.
std::string overlap_text(const Inspection::Finding& overlap);

/// What may look the same way from one place.
enum class Twice { nothing, parts_of_a_surface };

/// Of surfaces in one place none hides the other.  Where two look the same way there (`overlaps`), both would be seen as
/// a whole, or now this one and now that: what is seen is not defined.  Of parts of one surface it is, but they count
/// twice.
/// @return  what is there twice and may be
/// @throws core::InputError  which they are, and where
std::vector<Inspection::Finding> require_each_place_once(const Scene& scene, Twice may_be = Twice::nothing);

}  // namespace interflect::scene
