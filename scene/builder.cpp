#include "scene/builder.h"

#include <algorithm>
#include <set>

#include "core/error.h"
#include "core/format.h"
#include "scene/flattening.h"
#include "scene/luminance.h"

namespace interflect::scene {
namespace {

Spectrum default_weights(std::size_t channels) {
  Spectrum weights;
  if (channels == 3) {
    for (int c = 0; c < 3; ++c) weights[c] = srgb_luminance[static_cast<std::size_t>(c)];
    return weights;
  }
  for (std::size_t c = 0; c < channels; ++c) weights[static_cast<int>(c)] = 1.0 / static_cast<double>(channels);
  return weights;
}

}  // namespace

SceneBuilder::SceneBuilder(std::vector<std::string> channels, Quantity quantity) {
  if (channels.empty() || channels.size() > static_cast<std::size_t>(Spectrum::capacity))
    throw core::PreconditionError("a scene has 1 .. Spectrum::capacity channels");
  scene_.quantity = quantity;
  scene_.weights = default_weights(channels.size());
  scene_.channels = std::move(channels);
}

MaterialId SceneBuilder::add_material(Material material) {
  scene_.materials.push_back(std::move(material));
  return MaterialId{static_cast<std::uint32_t>(scene_.materials.size() - 1)};
}

SurfaceId SceneBuilder::add_polygon(const std::string& name, const geometry::PlanarPolygon& polygon,
                                    MaterialId material) {
  const auto triangles = geometry::triangulate(polygon);
  const SurfaceId id{static_cast<std::uint32_t>(scene_.surfaces.size())};
  scene_.surfaces.push_back({name, material, static_cast<std::uint32_t>(scene_.facets.size()),
                             static_cast<std::uint32_t>(triangles.size()), polygon});
  const Vec3 normal = geometry::plane_of(polygon.outer).normal;
  for (const auto& corners : triangles) {
    Facet facet = make_facet(id, corners);
    facet.normal = normal;  // not its own: that of a sliver beside a corner in mid-edge would be noise
    scene_.facets.push_back(facet);
  }
  return id;
}

SurfaceId SceneBuilder::add_facets(const std::string& name, std::span<const geometry::TriangleCorners> triangles,
                                   MaterialId material) {
  const SurfaceId id{static_cast<std::uint32_t>(scene_.surfaces.size())};
  const auto first = static_cast<std::uint32_t>(scene_.facets.size());
  for (const auto& corners : triangles) {
    scene_.facets.push_back(make_facet(id, corners));
    if (!(scene_.facets.back().area > 0)) {
      scene_.facets.resize(first);
      throw geometry::Defect("a facet of '" + name + "' has no area");
    }
  }
  scene_.surfaces.push_back({name, material, first, static_cast<std::uint32_t>(triangles.size()), std::nullopt});
  return id;
}

void SceneBuilder::add_box(const std::string& name, const geometry::Box& box, MaterialId material, Facing facing,
                           const std::function<Vec3(const Vec3&)>& place) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool upper : {false, true}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      geometry::Ring ring(4, upper ? box.max() : box.min());
      for (int k = 0; k < 4; ++k) {
        ring[static_cast<std::size_t>(k)][u] = (k == 1 || k == 2 ? box.max() : box.min())[u];
        ring[static_cast<std::size_t>(k)][v] = (k >= 2 ? box.max() : box.min())[v];
      }
      if (place)
        for (Vec3& x : ring) x = place(x);
      if (upper != (facing == Facing::outward)) std::reverse(ring.begin(), ring.end());
      add_polygon(name + "/" + "xyz"[axis] + (upper ? "+" : "-"), {ring, {}}, material);
    }
  }
}

void SceneBuilder::share_flux(MaterialId material, const Spectrum& flux) {
  double area = 0;
  for (const SurfaceId id : scene_.surface_ids())
    if (scene_.surface(id).material == material) area += scene_.area(id);
  if (!(area > 0)) throw core::PreconditionError("flux is shared over surfaces, and none bears the material");
  scene_.materials[material.value].exitance = flux / area;
}

Scene SceneBuilder::finish(const std::string& shown) {
  if (const Flattened flattened = flatten_polygons(scene_); flattened.polygons > 0)
    scene_.repairs.push_back(
        {shown, core::format("%zu %s flattened, by %.2g m at most", flattened.polygons,
                             flattened.polygons == 1 ? "polygon" : "polygons", flattened.furthest)});
  std::multiset<std::string> given;
  for (const Surface& surface : scene_.surfaces) given.insert(surface.name);
  std::set<std::string> used;  // by sides
  for (Surface& surface : scene_.surfaces) {
    const bool two_sided = scene_.materials[surface.material.value].sides == Sides::both;
    const auto is_free = [&](const std::string& name) {
      return !used.contains(name) && !(two_sided && used.contains(name + back_suffix));
    };
    const std::string stem = surface.name.empty() ? "surface" : surface.name;
    std::string name = stem;
    for (int k = 2; !is_free(name) || (name != surface.name && given.contains(name)); ++k)
      name = stem + "-" + std::to_string(k);
    used.insert(name);
    if (two_sided) used.insert(name + back_suffix);
    if (name != surface.name && !surface.name.empty() && given.count(surface.name) == 1)
      scene_.warnings.push_back({shown, "the surface '" + surface.name + "' is called '" + name +
                                            "': the back of a surface is called NAME/back, and that name is taken"});
    surface.name = std::move(name);
  }
  return std::move(scene_);
}

}  // namespace interflect::scene
