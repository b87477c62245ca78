#pragma once

#include <functional>
#include <span>
#include <string>

#include "geometry/triangulate.h"
#include "scene/scene.h"

namespace interflect::scene {

/// Puts a scene together surface by surface: what every reader, and a program without a file, builds with.
class SceneBuilder {
 public:
  enum class Facing { outward, inward };

  /// @param channels  names; weights are sRGB luminance for three, else 1/n each
  explicit SceneBuilder(std::vector<std::string> channels, Quantity quantity = Quantity::photometric);

  Scene& scene() { return scene_; }  ///< for what has no method here: cameras, sensors, notes

  MaterialId add_material(Material material);
  /// @throws geometry::Defect  if it is not a planar polygon with an area
  SurfaceId add_polygon(const std::string& name, const geometry::PlanarPolygon& polygon, MaterialId material);
  /// Triangles of a mesh as one surface; none may be degenerate.
  SurfaceId add_facets(const std::string& name, std::span<const geometry::TriangleCorners> triangles,
                       MaterialId material);
  /// Six surfaces NAME/x-, NAME/x+, .. NAME/z+.
  /// @param place  moves each corner, keeping orientation; nothing: they stay
  void add_box(const std::string& name, const geometry::Box& box, MaterialId material, Facing facing = Facing::outward,
               const std::function<Vec3(const Vec3&)>& place = {});
  /// `flux` [W | lm] shared by area over the surfaces that bear the material becomes its exitance.
  void share_flux(MaterialId material, const Spectrum& flux);

  /// The finished scene.  Polygons that are not flat beyond rounding are flattened (flattening.h), which is noted among
  /// its repairs.  Names are made unique by numbers, so that each active side's is (Scene::side_name); a surface
  /// that only a back stands in the way of is warned of.
  /// @param shown  the scene in that warning
  Scene finish(const std::string& shown = "scene");

 private:
  Scene scene_;
};

}  // namespace interflect::scene
