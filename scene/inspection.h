#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace interflect::scene {

/// What is odd about a scene's geometry, found without a single ray, before an hour of work is spent.
struct Inspection {
  struct Finding {
    enum class Kind { gap, inconsistent_normals, duplicate_faces, coplanar_overlap };
    Kind kind;
    std::string surface, other;  ///< names; `other` empty where one surface is concerned
    Vec3 where;                  ///< a point of it [m]
    double size;                 ///< length of the gap or edge [m], or area of the overlap [m²]
  };
  std::vector<Finding> findings;  ///< the largest first within a kind
  double open_edge_length = 0;    ///< [m] of edges that no other facet continues
  bool closed() const;            ///< no gap: every edge is covered by neighbours
};

/// Gaps (open edges) are found geometrically, T-junctions allowed: an edge is closed where collinear edges of other facets cover it
/// (within 1e-6 of the scene's diagonal).  Normals are inconsistent where two one-sided neighbours run along their common edge
/// in the same direction.
Inspection inspect(const Scene& scene);

std::string describe(Inspection::Finding::Kind kind);

}  // namespace interflect::scene
