#pragma once

#include <array>

#include "fem/form_factor/hemicube_grid.h"
#include "fem/form_factor/sight.h"

namespace interflect::fem {

/// A hemisphere of directions projected on the five faces of half a cube, each a Z-buffer [Cohen, Greenberg 1985].
class HemicubeSight final : public Sight {
 public:
  explicit HemicubeSight(const HemicubeGrid& grid);  ///< which outlives it

  void look(const ViewScene& scene, const Eye& eye, Index element, SeenItems& seen) override;

  /// What `look` is made of, for polygons of any origin: `clear`, `add` each, `count`.
  void clear();
  /// @return  the form factor that it would have if nothing hid it
  double add(std::span<const Vec3> local_ring, const geometry::Plane& local_plane, std::int32_t item);
  void count(SeenItems& seen) const;

  static constexpr std::size_t faces = 5;
  const ViewPlane& plane(std::size_t face) const { return planes_[face]; }
  const ItemBuffer& buffer(std::size_t face) const { return buffers_[face]; }

 private:
  double missed_cell(const FrontingPolygon& polygon) const;

  std::array<ViewPlane, faces> planes_;
  std::array<ItemBuffer, faces> buffers_;
  std::vector<Index> uncovered_;
};

}  // namespace interflect::fem
