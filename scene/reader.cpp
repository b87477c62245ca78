#include "scene/reader.h"

#include <algorithm>

#include "core/error.h"
#include "core/format.h"
#include "scene/io/geometry_reader.h"
#include "scene/io/light_reader.h"
#include "scene/io/mesh_reader.h"
#include "scene/io/question_reader.h"
#include "scene/io/text_file.h"

namespace interflect::scene {
namespace {

void require_format(const io::JsonNode& root) {
  if (!root.is_object()) root.fail("a scene is a JSON object");
  for (const char* key : {"luminaires", "photometry"})
    if (root.has(key)) root.at(key).fail(std::string("this version does not know \"") + key + "\"");
  root.only({"$schema", "format", "units", "up", "quantity", "channels", "weights", "north_deg", "materials",
             "geometry", "lights", "sky", "sensors", "cameras", "expected"});
  if (root.at("format").string() != "interflect/scene/1")
    root.at("format").fail("\"interflect/scene/1\" is expected, not \"" + io::shown_word(root.at("format").string()) +
                           "\"");
}

void read_weights(const io::JsonNode& node, Scene& scene) {
  scene.weights = io::read_spectrum(node, scene.channel_count());
  double sum = 0;
  for (int c = 0; c < scene.channel_count(); ++c) {
    if (scene.weights[c] < 0) node.fail("a weight is not negative");
    sum += scene.weights[c];
  }
  if (!(sum > 0)) node.fail("a weight must be positive");
}

void read_conventions(const io::JsonNode& root, Scene& scene) {
  if (root.has("up") && root.at("up").one_of({"z", "y"}) == 1) scene.up = Vec3::UnitY();
  if (root.has("weights")) read_weights(root.at("weights"), scene);
  if (root.has("north_deg")) scene.north_deg = root.at("north_deg").number();
}

void warn_of_oddities(Scene& scene, const std::string& name) {
  const Vec3 size = scene.box().sizes();
  const auto odd = [](double length) { return length > 0 && (length < 0.1 || length > 1000); };
  if (odd(size.x()) || odd(size.y()) || odd(size.z()))
    scene.warnings.push_back(
        {name, core::format("the scene measures %.4g x %.4g x %.4g m: a side outside 0.1 m .. 1 km; are its "
                            "\"units\" right?",
                            size.x(), size.y(), size.z())});
}

/// Other commands read meshes; here one would be called broken JSON.
void require_no_mesh(const std::filesystem::path& file) {
  std::vector<std::string> known = io::mesh_extensions();
  known.emplace_back(".vs3");
  const std::string extension = core::lower_case(file.extension().string());
  if (std::find(known.begin(), known.end(), extension) != known.end())
    throw core::InputError(file.string(),
                           "a scene file (.json) is expected, which gives surfaces their materials, not "
                           "geometry alone (docs/scene.md)");
}

}  // namespace

Scene parse_scene(std::string_view text, const std::string& name, const std::filesystem::path& folder,
                  const PictureReader& read_picture) {
  const io::JsonDocument document(text, name);
  const io::JsonNode root = document.root();
  require_format(root);
  const io::LengthUnit unit = io::read_unit(root.at("units"));
  Quantity quantity = Quantity::photometric;
  if (root.has("quantity") && root.at("quantity").one_of({"photometric", "radiometric"}) == 1)
    quantity = Quantity::radiometric;

  SceneBuilder builder(io::read_channels(root), quantity);
  read_conventions(root, builder.scene());
  io::MaterialLibrary materials(root.at("materials"), builder.scene().channel_count());
  io::GeometryReader(builder, materials, unit, folder, name).read(root.at("geometry"));
  if (builder.scene().surfaces.empty()) root.at("geometry").fail("a scene has at least one surface");
  materials.finish(builder, name);
  if (root.has("lights")) io::read_lights(root.at("lights"), unit, builder.scene());
  if (root.has("sky")) io::read_sky(root.at("sky"), folder, read_picture, builder.scene());
  if (root.has("sensors")) io::read_sensors(root.at("sensors"), unit, builder.scene());
  if (root.has("cameras")) io::read_cameras(root.at("cameras"), unit, builder.scene());
  if (root.has("expected")) io::read_expected(root.at("expected"), builder.scene());
  Scene scene = builder.finish(name);
  io::require_extent(scene, name);
  warn_of_oddities(scene, name);
  return scene;
}

Scene read_scene(const std::filesystem::path& file, const PictureReader& read_picture) {
  require_no_mesh(file);
  const std::string text = io::read_bytes(file, file.string());
  Scene scene = parse_scene(text, file.string(), file.parent_path(), read_picture);
  scene.file = file;
  return scene;
}

void warn_of_darkness(Scene& scene) {
  if (scene.emitted_flux().is_zero() && scene.lights.empty())
    scene.warnings.push_back({scene.file.string(), "nothing emits: everything will be dark"});
  for (const Material& material : scene.materials)
    if (material.thermal && !material.thermal->temperature)
      scene.warnings.push_back({scene.file.string(), "material '" + material.name +
                                                         "' has a heat flux and no temperature: it emits nothing here; "
                                                         "interflect exchange finds both"});
}

}  // namespace interflect::scene
