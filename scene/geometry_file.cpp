#include "scene/geometry_file.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "core/error.h"
#include "core/format.h"
#include "scene/builder.h"
#include "scene/io/mesh_import.h"
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

/// "GROUP/MATERIAL", or what there is of it.
std::string label_of(const io::MeshFile& mesh, const io::MeshFile::Face& face, const std::string& file) {
  const std::string &group = mesh.groups[face.group], &material = mesh.materials[face.material];
  if (group.empty() && material.empty()) return std::filesystem::path(file).stem().string();
  if (group.empty() || group == material) return io::one_line(material);
  return io::one_line(material.empty() ? group : group + "/" + material);
}

/// The mesh with every face in a group of its own, named by its position, and materials without names.
io::MeshFile face_by_face(const io::MeshFile& mesh) {
  io::MeshFile out = mesh;
  out.groups.clear();
  for (io::MeshFile::Face& face : out.faces) {
    face.group = static_cast<std::uint32_t>(out.groups.size());
    out.groups.push_back(std::to_string(face.group));
  }
  for (std::string& name : out.materials) name.clear();
  return out;
}

/// Gives surfaces that are named by positions of faces their names and groups.
void name_faces(Scene& scene, const io::MeshFile& mesh, std::vector<ExchangeSurface>& out, const std::string& file) {
  std::unordered_map<std::string, std::size_t> members;
  std::vector<std::size_t> face_of;
  for (const Surface& surface : scene.surfaces) {
    face_of.push_back(std::stoull(surface.name));
    out.push_back({label_of(mesh, mesh.faces[face_of.back()], file), ExchangeRole::radiates, std::nullopt});
    ++members[out.back().group];
  }
  for (std::size_t k = 0; k < out.size(); ++k)
    scene.surfaces[k].name =
        members[out[k].group] == 1 ? out[k].group : out[k].group + "/" + std::to_string(face_of[k] + 1);
}

ExchangeScene read_mesh_scene(const std::filesystem::path& file, const GeometryOptions& options, Sides sides) {
  const std::string shown = file.string();
  io::MeshFile mesh = io::read_mesh(file, shown);
  io::Placement placement;
  if (options.unit) placement.unit = io::unit_named(*options.unit);
  io::place_vertices(mesh, placement);
  SceneBuilder builder = plain_builder();
  std::vector<MaterialId> materials;
  for (const std::string& name : mesh.materials) materials.push_back(builder.add_material(neutral(name, sides)));
  Scene& scene = builder.scene();
  for (const std::string& note : mesh.notes) scene.repairs.push_back({shown, note});
  if (mesh.single_precision)
    scene.warnings.push_back({shown, "coordinates are in single precision, as the format or its reader has them"});
  ExchangeScene out;
  if (options.whole_groups) {
    io::import_mesh(builder, mesh, materials, {}, shown);
    for (const Surface& surface : scene.surfaces)
      out.surfaces.push_back({surface.name, ExchangeRole::radiates, std::nullopt});
  } else {
    io::import_mesh(builder, face_by_face(mesh), materials, {}, shown);
    name_faces(scene, mesh, out.surfaces, shown);
  }
  out.scene = builder.finish(shown);
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

/// Positions of the surfaces that a list of names and groups means.
std::vector<bool> chosen(const ExchangeScene& from, const std::vector<std::string>& names, const std::string& shown) {
  std::vector<bool> out(from.surfaces.size());
  for (const std::string& name : names) {
    bool found = false;
    for (std::size_t k = 0; k < out.size(); ++k)
      if (from.surfaces[k].group == name || from.scene.surfaces[k].name == name) out[k] = found = true;
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
  for (std::size_t k = 0; k < dark.size(); ++k)
    if (dark[k]) out.surfaces[k].role = ExchangeRole::only_occludes;
  if (!options.left_out.empty()) leave_out(out, gone, shown);
  return out;
}

}  // namespace interflect::scene
