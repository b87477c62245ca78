#pragma once

#include <span>
#include <vector>

#include "fem/form_factor/pair_shadow.h"
#include "geometry/hidden_part.h"

namespace interflect::fem {

/// The planes across which the part of `inner` that convex blockers hide from a point of `outer` changes its form:
///
///   through an edge of a blocker and a corner of `inner`,   through a corner of a blocker and an edge of `inner`,
///   and those of blockers' faces, where the outline jumps from some edges to others
///
/// [Heckbert 1992; Lischinski, Tampieri, Greenberg 1992: the events EV and VE of discontinuity meshing].  Between them,
/// and but for the events of two blockers' edges together (EEE), the hidden form factor is a smooth function of the
/// point.  Only planes that cut `outer` where the event takes place are given.
class ShadowEvents {
 public:
  /// @param rounding  of coordinates [m]
  explicit ShadowEvents(double rounding) : rounding_(rounding) {}

  /// A new pair of convex rings, each in front of the other's plane; they stay where they are while events are added.
  void start(std::span<const Vec3> outer, std::span<const Vec3> inner) {
    outer_ = outer, inner_ = inner, planes_.clear();
  }
  void add(const PairShadow& shadow);
  /// Those of two blockers together, through a corner of one and an edge of the other, where both are in line with
  /// `inner`: from beyond such a plane the overlap of the two shadows has other corners.
  void add_between(const PairShadow& a, const PairShadow& b);
  std::span<const geometry::HalfSpace> planes() const { return planes_; }

  /// Cuts parts of the outer ring along the planes.
  void cut(geometry::RingList& parts);

 private:
  void add_face(const geometry::Plane& face);
  void add_corner_and_edge(const Vec3& corner, const Vec3& a, const Vec3& b);
  void add_corners_and_edges(const PairShadow& corners, const PairShadow& edges);
  void collect_corners(const PairShadow& shadow);
  bool in_line(const Vec3& from, const Vec3& to, const Vec3& corner, const Vec3& a, const Vec3& b,
               const Vec3& normal) const;
  bool points_at_inner(const Vec3& from, const Vec3& to, const Vec3& corner) const;
  bool chord(const geometry::HalfSpace& plane, Vec3& from, Vec3& to);

  std::span<const Vec3> outer_, inner_;
  double rounding_;
  std::vector<geometry::HalfSpace> planes_;
  std::vector<double> distance_;
  std::vector<Vec3> corners_;
  geometry::RingList before_;
  std::vector<Vec3> inside_, outside_;
};

}  // namespace interflect::fem
