#include "scene/io/geometry_reader.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "core/format.h"
#include "scene/io/mesh_import.h"
#include "scene/io/text_file.h"

namespace interflect::scene::io {
namespace {

geometry::Ring read_ring(const JsonNode& node, const Placement& placement) {
  geometry::Ring ring;
  for (const JsonNode& corner : node.items(3)) ring.push_back(read_place(corner, placement));
  return ring;
}

MeshRepair read_repair(const JsonNode& entry, const LengthUnit& unit) {
  MeshRepair repair;
  if (!entry.has("repair")) return repair;
  const JsonNode node = entry.at("repair");
  node.only({"weld", "drop_degenerate", "drop_duplicate"});
  if (node.has("weld")) {
    repair.weld = unit.metres(node.at("weld").number());
    if (repair.weld < 0) node.at("weld").fail("a length is not negative");
  }
  if (node.has("drop_degenerate")) repair.drop_degenerate = node.at("drop_degenerate").boolean();
  if (node.has("drop_duplicate")) repair.drop_duplicate = node.at("drop_duplicate").boolean();
  return repair;
}

/// What becomes of a mesh's materials that are not mapped.
enum class Unmapped : std::uint8_t { error, mtl, material };

Unmapped unmapped_kind(const JsonNode& entry) {
  if (!entry.has("unmapped") || entry.at("unmapped").string() == "error") return Unmapped::error;
  return entry.at("unmapped").string() == "mtl" ? Unmapped::mtl : Unmapped::material;
}

void require_unmapped(const JsonNode& entry, const MaterialLibrary& materials) {
  const Unmapped kind = unmapped_kind(entry);
  if (kind == Unmapped::error) return;
  const JsonNode node = entry.at("unmapped");
  if (kind == Unmapped::material) return materials.require(node);
  if (core::lower_case(std::filesystem::path(entry.at("file").string()).extension().string()) != ".obj")
    node.fail("MTL files belong to OBJ files: a material of the scene is expected");
  if (materials.has("mtl")) node.fail("the scene has a material 'mtl': is that meant, or the mesh's MTL files?");
}

}  // namespace

void GeometryReader::read(const JsonNode& geometry) {
  const auto entries = geometry.items();
  std::map<std::string, std::size_t> given;  // names, and to how many
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const JsonNode& entry = entries[k];
    const bool file = entry.has("file"), polygon = entry.has("polygon"), box = entry.has("box");
    if (file + polygon + box != 1) {
      if (file + polygon + box == 0) entry.only({"file", "polygon", "box", "name", "material", "transform"});
      entry.fail("one of 'file', 'polygon' and 'box' is expected");
    }
    const auto name = [&] {
      return entry.has("name") ? entry.at("name").string() : core::format("%s-%zu", polygon ? "polygon" : "box", k);
    };
    if (entry.has("name") && !file) ++given[name()];
    if (file) read_file(entry);
    if (polygon) read_polygon(entry, name());
    if (box) read_box(entry, name());
  }
  for (const auto& [name, count] : given)
    if (count > 1)
      builder_.scene().warnings.push_back(
          {shown_,
           core::format("the name '%s' is given to %zu surfaces: they are numbered", shown_word(name).c_str(), count)});
}

void GeometryReader::read_polygon(const JsonNode& entry, const std::string& name) {
  entry.only({"polygon", "holes", "material", "name", "transform"});
  const Placement placement = read_placement(entry, unit_);
  geometry::PlanarPolygon polygon{read_ring(entry.at("polygon"), placement), {}};
  if (entry.has("holes"))
    for (const JsonNode& hole : entry.at("holes").items()) polygon.holes.push_back(read_ring(hole, placement));
  const MaterialId material = materials_.use(builder_, entry.at("material"), Sides::front);
  try {
    builder_.add_polygon(name, polygon, material);
  } catch (const geometry::Defect& defect) {
    entry.at("polygon").fail(defect.what());
  }
}

void GeometryReader::read_box(const JsonNode& entry, const std::string& name) {
  entry.only({"box", "facing", "material", "name", "transform"});
  const JsonNode node = entry.at("box");
  node.only({"min", "max"});
  const geometry::Box box(node.at("min").vec3(), node.at("max").vec3());
  if (!(box.max().array() > box.min().array()).all()) node.fail("'min' must be below 'max' in all three coordinates");
  using Facing = SceneBuilder::Facing;
  Facing facing = Facing::outward;
  if (entry.has("facing"))
    facing = entry.at("facing").one_of({"outward", "inward"}) == 0 ? Facing::outward : Facing::inward;
  const MaterialId material = materials_.use(builder_, entry.at("material"), Sides::front);
  const Placement placement = read_placement(entry, unit_);
  for (const char* corner : {"min", "max"}) read_place(node.at(corner), placement);
  try {
    builder_.add_box(name, box, material, facing, [&](const Vec3& x) { return placement(x); });
  } catch (const geometry::Defect& defect) {
    node.fail(defect.what());
  }
}

void GeometryReader::read_file(const JsonNode& entry) {
  entry.only({"file", "transform", "materials", "unmapped", "repair"});
  const JsonNode node = entry.at("file");
  const std::filesystem::path path = folder_ / node.string();
  const std::string shown = path.lexically_normal().string();
  std::error_code error;
  if (!std::filesystem::exists(path, error)) node.fail("there is no file '" + shown_word(shown) + "'");
  const Placement placement = read_placement(entry, unit_);
  const MeshRepair repair = read_repair(entry, unit_);

  MeshFile mesh = read_mesh(path, shown);
  place_vertices(mesh, placement, shown);
  if (repair.weld > 0 && repair.weld < finest_weld(mesh))
    entry.at("repair").at("weld").fail("a weld of less than 1e-15 of the coordinates is below their rounding");
  const auto materials = map_materials(entry, mesh, shown);
  auto& repairs = builder_.scene().repairs;
  for (const std::string& note : mesh.notes) repairs.push_back({shown, note});
  if (const std::size_t welded = weld_vertices(mesh, repair.weld); welded > 0)
    repairs.push_back({shown, core::format("%zu vertices welded to others", welded)});
  if (mesh.single_precision)
    builder_.scene().warnings.push_back(
        {shown, "coordinates are in single precision, as the format or its reader has them"});
  import_mesh(builder_, mesh, materials, repair, shown);
}

std::optional<MaterialId> GeometryReader::unmapped(const JsonNode& entry, const MeshFile& mesh, const std::string& name,
                                                   const std::string& shown) {
  switch (unmapped_kind(entry)) {
    case Unmapped::error:
      return std::nullopt;
    case Unmapped::material:
      return materials_.use(builder_, entry.at("unmapped"), Sides::both);
    case Unmapped::mtl:
      break;
  }
  std::vector<std::filesystem::path> files;
  for (const std::string& named : mesh.material_files)
    for (auto& file : mtl_files(std::filesystem::path(folder_ / entry.at("file").string()).parent_path(), named))
      files.push_back(std::move(file));
  return mtl_.use(builder_, files, name, shown);
}

std::vector<MaterialId> GeometryReader::map_materials(const JsonNode& entry, const MeshFile& mesh,
                                                      const std::string& shown) {
  const std::vector<std::string>& names = mesh.materials;
  std::vector<MaterialId> out;
  std::string missing;
  const bool mapped = entry.has("materials");
  // Every target is looked up, whether a face asks for it or not: a slip shall not wait for its face.
  require_unmapped(entry, materials_);
  if (mapped)
    for (const auto& [name, target] : entry.at("materials").members()) materials_.require(target);
  for (const std::string& name : names) {
    if (mapped && entry.at("materials").has(name))
      out.push_back(materials_.use(builder_, entry.at("materials").at(name), Sides::both));
    else if (const auto other = unmapped(entry, mesh, name, shown))
      out.push_back(*other);
    else
      missing += (missing.empty() ? "'" : ", '") + shown_word(name) + "'";
  }
  if (!missing.empty())
    entry.fail("materials of the file without one of the scene" +
               std::string(unmapped_kind(entry) == Unmapped::mtl ? " or of its MTL files: " : ": ") + missing +
               " (map them in \"materials\", or name one as \"unmapped\")");
  mtl_.say_left_out(builder_, shown);
  if (mapped)
    for (const auto& [name, target] : entry.at("materials").members())
      if (std::find(names.begin(), names.end(), name) == names.end())
        builder_.scene().warnings.push_back(
            {shown, "no face bears the material '" + shown_word(name) + "' that is mapped"});
  return out;
}

}  // namespace interflect::scene::io
