#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fem/bounds/scene_cells.h"

namespace interflect::fem {

/// Backs without elements, which are black, as parts that light ends on beside elements; each place once.
///
/// Of whatever parts P there are, bounds of T b take for granted that every ray from a cell ends on exactly one:
///
///   sum_P F_P = 1,    (T b)(x) = m + sum_P (b_P - m) F_P(x)                                     (cell_transport.h)
///
/// The back of one facet may lie in the same place as a side of another that faces the same way, such as the front of
/// the next room's wall.  Then neither hides the other, since what lies in a part's plane does not (geometry/shaft.h);
/// both would be counted, sum_P F_P = 1 + F_back, and T b be wrong by -m F_back.  So a back is left out where such a
/// side is there: one with an element, or the first of backs.
///
/// - No light is missed.  Backs send none, and elements are never left out: sum_P b_P F_P is what it was.
/// - Every ray still ends on something.  Facets are cut wherever others end in their plane (facet_cells.h), so that a
///   cell lies in another facet of its plane or beside it: what is left out is covered as a whole by what it is left
///   out for.  The first back in a place is left out for elements alone.
/// - No ray ends on two.  Of sides in one place that face one way, one at most is a back, and none beside an element.
///
/// All of this is to the tolerance of the cells (SceneCells), which may be moved and dropped by as much.
///
/// In the same place are planes that no shaft tells apart, within 1e-11 of the scene's size.  Those that every shaft
/// tells apart hide each other as any do, and all are parts.  Between these nothing is known, and nothing is returned:
/// bounds are then those without backs, for which sum_P F_P <= 1 is enough (m = 0).
/// Test: tests/fem/bounds/black_backs.cpp
class BlackBacks {
 public:
  BlackBacks(const scene::Scene& scene, const SceneCells& cells) : scene_(scene), all_(cells) {}

  /// Whether a side with elements, or an earlier back, lies where the back of a cell does and faces its way.
  enum class Covered : std::uint8_t { no, yes, unknown };
  Covered covered(const FacetCell& cell, scene::Side side) const;

  /// The side of a cell, in triangles.
  void append(const FacetCell& cell, scene::Side side, std::vector<scene::SurfacePatch>& out) const;

  /// All that there are: facets as a whole where nothing covers any of them.
  std::optional<std::vector<scene::SurfacePatch>> all() const;

 private:
  Covered covered_by(std::uint32_t facet, const Vec3& normal, const FacetCell& cell, scene::Side side) const;
  bool append_facet(std::uint32_t facet, scene::Side side, std::span<const FacetCell> cells,
                    std::vector<scene::SurfacePatch>& out) const;

  const scene::Scene& scene_;
  const SceneCells& all_;
};

}  // namespace interflect::fem
