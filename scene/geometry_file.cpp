#include "scene/geometry_file.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "core/error.h"
#include "core/format.h"
#include "scene/builder.h"
#include "scene/io/mesh_import.h"
#include "scene/io/placement.h"
#include "scene/io/text_file.h"
#include "scene/io/view3d_scene.h"
#include "scene/reader.h"

namespace interflect::scene {
namespace {

Material neutral(const std::string& name, Sides sides) {
  Material material;
  material.name = name.empty() ? "neutral" : name;
  material.reflectance[0] = 0.5;
  material.sides = sides;
  return material;
}

/// Of factors nothing but areas and distances counts: any one channel does.
SceneBuilder plain_builder() { return SceneBuilder({"y"}, Quantity::radiometric); }

/// Of a mesh, surfaces by groups or by faces; faces are told apart by their numbers in the file.
void import_exchange_mesh(SceneBuilder& builder, const io::MeshFile& mesh, const std::vector<MaterialId>& materials,
                          io::MeshSurfaces kind, const std::string& shown, std::vector<ExchangeSurface>& out) {
  const std::vector<std::size_t> face_of = io::import_mesh(builder, mesh, materials, {}, shown, kind);
  std::vector<Surface>& surfaces = builder.scene().surfaces;
  std::unordered_map<std::string, std::size_t> members;
  for (const Surface& surface : surfaces) {  // each with its group's name so far
    out.push_back({surface.name, ExchangeRole::radiates, std::nullopt});
    ++members[surface.name];
  }
  if (kind == io::MeshSurfaces::of_groups) return;
  for (std::size_t k = 0; k < surfaces.size(); ++k)
    if (members[out[k].group] > 1) surfaces[k].name += "/" + std::to_string(face_of[k] + 1);
}

ExchangeScene read_mesh_scene(const std::filesystem::path& file, const GeometryOptions& options, Sides sides) {
  const std::string shown = file.string();
  io::MeshFile mesh = io::read_mesh(file, shown);
  io::Placement placement;
  if (options.unit) placement.unit = io::unit_named(*options.unit);
  io::place_vertices(mesh, placement, shown);
  SceneBuilder builder = plain_builder();
  std::vector<MaterialId> materials;
  for (const std::string& name : mesh.materials) materials.push_back(builder.add_material(neutral(name, sides)));
  Scene& scene = builder.scene();
  for (const std::string& note : mesh.notes) scene.repairs.push_back({shown, note});
  if (mesh.single_precision)
    scene.warnings.push_back({shown, "coordinates are in single precision, as the format or its reader has them"});
  ExchangeScene out;
  import_exchange_mesh(builder, mesh, materials,
                       options.whole_groups ? io::MeshSurfaces::of_groups : io::MeshSurfaces::of_faces, shown,
                       out.surfaces);
  out.scene = builder.finish(shown);
  io::require_extent(out.scene, shown);
  return out;
}

ExchangeScene read_view3d_scene(const std::filesystem::path& file, const GeometryOptions& options, Sides sides) {
  const std::string shown = file.string();
  std::vector<io::View3dSurface> surfaces = io::read_view3d(file, shown);
  if (options.unit) {
    const io::LengthUnit unit = io::unit_named(*options.unit);
    for (io::View3dSurface& surface : surfaces)
      for (Vec3& x : surface.ring) x = unit.metres(x);
  }
  SceneBuilder builder = plain_builder();
  ExchangeScene out;
  io::import_view3d(builder, out, surfaces, sides, shown);
  out.scene = builder.finish(shown);
  io::require_extent(out.scene, shown);
  return out;
}

ExchangeScene read_scene_file(const std::filesystem::path& file, const GeometryOptions& options) {
  if (options.unit) throw core::InputError(file.string(), "a scene file says its own unit");
  if (options.two_sided)
    throw core::InputError(file.string(), "a scene file says itself which surfaces have two sides");
  ExchangeScene out;
  out.scene = read_scene(file);
  for (const Surface& surface : out.scene.surfaces)
    out.surfaces.push_back({surface.name, ExchangeRole::radiates, std::nullopt});
  return out;
}

bool is_called(const ExchangeScene& from, std::size_t k, const std::string& name) {
  return from.surfaces[k].group == name || from.scene.surfaces[k].name == name;
}

/// What shall occlude cannot all be left out; a part of a group can.
void require_some_left(const ExchangeScene& from, const std::string& name, const std::vector<bool>& left_out,
                       const std::string& shown) {
  for (std::size_t k = 0; k < left_out.size(); ++k)
    if (is_called(from, k, name) && !left_out[k]) return;
  throw core::InputError(
      shown, "'" + io::shown_word(name) + "' is to occlude only, and to be left out: one of the two expected");
}

/// Positions of the surfaces that a list of names and groups means.
std::vector<bool> chosen(const ExchangeScene& from, const std::vector<std::string>& names, const std::string& shown) {
  std::vector<bool> out(from.surfaces.size());
  for (const std::string& name : names) {
    bool found = false;
    for (std::size_t k = 0; k < out.size(); ++k)
      if (is_called(from, k, name)) out[k] = found = true;
    if (found) continue;
    io::NameList known;
    for (const ExchangeSurface& surface : from.surfaces) known.index_of(surface.group);
    throw core::InputError(shown, io::unknown_word("the surface or group", name, known.names()));
  }
  return out;
}

void leave_out(ExchangeScene& from, const std::vector<bool>& left_out, const std::string& shown) {
  Scene& scene = from.scene;
  std::vector<Surface> surfaces;
  std::vector<ExchangeSurface> about;
  std::vector<Facet> facets;
  std::vector<std::optional<SurfaceId>> id(scene.surfaces.size());
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
    if (left_out[k]) continue;
    id[k] = SurfaceId{static_cast<std::uint32_t>(surfaces.size())};
    Surface surface = scene.surfaces[k];
    const auto first = static_cast<std::uint32_t>(facets.size());
    for (std::uint32_t f = 0; f < surface.facets; ++f) {
      facets.push_back(scene.facets[surface.first_facet + f]);
      facets.back().surface = *id[k];
    }
    surface.first_facet = first;
    surfaces.push_back(std::move(surface));
    about.push_back(std::move(from.surfaces[k]));
  }
  if (surfaces.empty()) throw core::InputError(shown, "every surface is left out");
  std::erase_if(from.masks, [&](const ExchangeMask& mask) { return left_out[mask.base.value]; });
  for (ExchangeMask& mask : from.masks) mask.base = *id[mask.base.value];
  scene.surfaces = std::move(surfaces);
  scene.facets = std::move(facets);
  from.surfaces = std::move(about);
}

ExchangeScene read_by_extension(const std::filesystem::path& file, const GeometryOptions& options) {
  const std::string extension = core::lower_case(file.extension().string());
  const Sides sides = options.two_sided ? Sides::both : Sides::front;
  if (extension == ".json") return read_scene_file(file, options);
  if (extension == ".vs3") return read_view3d_scene(file, options, sides);
  std::vector<std::string> known = io::mesh_extensions();
  if (std::find(known.begin(), known.end(), extension) != known.end()) return read_mesh_scene(file, options, sides);
  known.insert(known.end(), {".vs3", ".json"});
  throw core::InputError(file.string(), io::unknown_word("the geometry format", extension, known));
}

}  // namespace

Scene scene_of_masks(const ExchangeScene& geometry) {
  SceneBuilder builder = plain_builder();
  for (const ExchangeMask& mask : geometry.masks)
    builder.add_polygon(mask.name, {mask.ring, {}}, builder.add_material(neutral(mask.material, Sides::front)));
  return builder.finish(geometry.scene.file.string());
}

ExchangeScene read_geometry_as_scene(const std::filesystem::path& file, const GeometryOptions& options) {
  ExchangeScene out = read_by_extension(file, options);
  const std::string shown = file.string();
  out.scene.file = file;
  const std::vector<bool> dark = chosen(out, options.only_occlude, shown), gone = chosen(out, options.left_out, shown);
  for (const std::string& name : options.only_occlude) require_some_left(out, name, gone, shown);
  for (std::size_t k = 0; k < dark.size(); ++k)
    if (dark[k]) out.surfaces[k].role = ExchangeRole::only_occludes;
  if (!options.left_out.empty()) leave_out(out, gone, shown);
  return out;
}

}  // namespace interflect::scene
