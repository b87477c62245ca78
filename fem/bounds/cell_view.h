#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "fem/bounds/factor_range.h"
#include "fem/form_factor/blockers.h"
#include "fem/form_factor/element_clusters.h"
#include "fem/form_factor/pair_shadow.h"
#include "geometry/clip.h"
#include "scene/scene.h"

namespace interflect::fem {

/// An element's quarters and theirs, as a tree: 0 the whole, 4 n + 1 + k quarter k of n (quarters_of).
struct QuarterTree {
  static constexpr int levels = 2, nodes = 21;
  static int child(int node, int quarter) { return 4 * node + 1 + quarter; }
  static int parent(int node) { return (node - 1) / 4; }
  static bool has(int node) { return node < nodes; }
};

/// An element, or a part of it, that a cell may see.
struct PartSeen {
  Index element;
  int node;    ///< of its quarter tree: what the part is, or is a part of
  bool whole;  ///< all of the node
  FactorRange factor;
  geometry::ConvexRing ring;  ///< what of it is above the cell's horizon
};

/// All elements, to be looked at from cells.  In an open scene black ones are behind them: backs that have no elements
/// (black_backs.h), and a box around all, so that every ray from within it ends on something and sum_j F_j = 1 there
/// too.
class Surroundings {
 public:
  /// @param patches  the elements, and then backs
  /// @param closed   no box: every ray that leaves an element arrives at a patch, or there is nothing to close it by
  Surroundings(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches, bool closed);

  Index elements() const { return shapes_.size(); }  ///< black ones included
  bool within(const Vec3& x) const { return box_.contains(x); }
  /// A cell relative to the origin that all is relative to here.
  Cell cell(std::span<const Vec3> ring) const;
  /// One that is too small to matter.
  Cell cell_at(const Vec3& x, const Vec3& normal) const;

 private:
  friend class CellView;
  Surroundings(const scene::Scene& scene, const geometry::Box& box, std::vector<scene::SurfacePatch> all);

  geometry::Box box_;
  ElementShapes shapes_;
  std::vector<ElementCluster> clusters_;
  Blockers blockers_;
};

/// What may be seen from anywhere in a cell, as parts of elements: `far` ones, proved to be seen by all of the cell (a
/// shaft is empty) with a factor that is nearly quadratic, and `near` ones, of which nothing but the most and the least
/// factor is known: they are near, or may be hidden in part.
///
/// What one convex blocker hides from all of the cell is left out: a point is on one side of the plane through an edge
/// and an eye wherever the corners say so (pair_shadow.h).
class CellView {
 public:
  CellView(const Surroundings& of, const Cell& cell);
  /// Near parts alone of a wider cell's, from a part of that cell.
  CellView(const CellView& wider, const Cell& cell);

  std::span<const PartSeen> far() const { return far_; }
  std::span<const PartSeen> near() const { return near_; }

  /// Cuts near parts into four of which some may be hidden, until
  ///
  ///   sum worth(part) (most - least)  <=  tolerance
  ///
  /// over all such, or `cuts` were made; the largest first.
  void refine(const std::function<double(const PartSeen&)>& worth, double tolerance, std::size_t cuts);

 private:
  using Candidates = std::vector<std::uint32_t>;
  /// What a near part is.
  struct Piece {
    std::array<Vec3, 4> corner;
    std::uint8_t corners;
    int node;
    bool whole;
    Candidates candidates;  ///< that may hide some of it
    std::span<const Vec3> ring() const { return {corner.data(), corners}; }
  };
  enum class Hidden : std::uint8_t { none, some, all };

  void look(const ElementCluster& cluster);
  void look(Index element, const Piece& piece, const Candidates* among);
  void look_at_quarters(Index element, const Piece& piece, const Candidates& among);
  Hidden hidden(std::span<const Vec3> ring, const Candidates* among, Candidates& by);

  const Surroundings& of_;
  const Cell& cell_;
  geometry::Plane horizon_;
  std::vector<PartSeen> far_, near_;
  std::vector<Piece> pieces_;  ///< of the near parts
  PairShadow shadow_;
};

}  // namespace interflect::fem
