#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "fem/bounds/scene_cells.h"

namespace interflect::fem {

/// The parts of space that a scene's elements look into, and what is around them, proved from the facets alone.
///
/// Facets are cut where others touch them (facet_cells.h).  A place has a label: which cycles modulo 2 of these cells
/// (surface_cycles.h) a ray from it crosses an odd number of times.  It is the same along any path that no facet
/// crosses: a ray arrives where the label is that of where it began.  So
///
/// - a label other than 0 says that no light escapes: far away it is 0;
/// - a side with another label is not seen.
///
/// In front of a cell it is that of its middle, by a ray that starts beyond all that lies in the cell's plane, as rays
/// from elements do.  All facets block light; every active side has elements.
///
/// What is proved is that no opening is wider than 1e-8 of the scene's size: edges that are within 1e-9 of it, or what
/// coordinates resolve if that is more, count as one, as do planes.  A ray that passes an edge within 1e-8 is not
/// trusted, but another is taken; where all do, or where it takes too many cells, nothing is proved.
/// Test: tests/fem/bounds/lit_regions.cpp
class LitRegions {
 public:
  explicit LitRegions(const scene::Scene& scene);

  /// Whether it is proved that no light that leaves an element can escape, and known what covers each black back.
  bool closed() const { return closed_; }
  /// Of a closed scene, the sides without elements that there are around the elements' regions, in triangles; they are
  /// black.  Where an active side lies in the same place, that is what is seen (black_backs.h).
  std::span<const scene::SurfacePatch> black_sides() const { return black_; }
  /// Those, or of an open scene all backs: what light may end on beside elements, but for a box around it.  Nothing
  /// where that is not known.
  std::optional<std::vector<scene::SurfacePatch>> black_ones(const scene::Scene& scene) const;
  /// Of a closed scene: whether a point, or what is just in front of it, is proved to be in a region that elements look
  /// into.
  bool contain(const Vec3& x, const Vec3& normal) const;

 private:
  using Label = std::vector<std::uint32_t>;  ///< cycles, ascending
  /// What a ray does at a cell.
  enum class Meeting : std::uint8_t { none, crossing, unclear };

  std::optional<Label> label(const Vec3& x, const Vec3& normal) const;
  std::optional<Label> label_along(const Vec3& x, const Vec3& normal, const Vec3& direction) const;
  Meeting meeting(const FacetCell& cell, const Vec3& x, const Vec3& normal, const Vec3& direction) const;
  std::optional<Label> label_of(const FacetCell& cell, scene::Side side) const;
  bool find_labels(const scene::Scene& scene);
  bool find_black_sides(const scene::Scene& scene);

  std::optional<SceneCells> all_;
  std::vector<Label> cycles_;  ///< that a cell is in
  std::set<Label> labels_;     ///< in front of elements
  bool closed_ = false;
  std::vector<scene::SurfacePatch> black_;
};

}  // namespace interflect::fem
