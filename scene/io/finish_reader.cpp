#include "scene/io/finish_reader.h"

#include "core/format.h"
#include "scene/io/checked_spectrum.h"
#include "scene/io/text_file.h"

namespace interflect::scene::io {
namespace {

struct Type {
  const char* name;
  std::vector<std::string> keys;
  Finish (*read)(const JsonNode& material, int channels);
};

void require_part(const JsonNode& node) { node.number_in(0, 1); }
void require_index(const JsonNode& node) { node.positive(); }

double number_or(const JsonNode& material, const char* key, double otherwise, double low, double high) {
  return material.has(key) ? material.at(key).number_in(low, high) : otherwise;
}
double roughness_of(const JsonNode& material) { return number_or(material, "roughness", 0, 0, 1); }
/// Of clear bodies: from the rarest gas that bends light to what is denser than any gem.
double index_of(const JsonNode& material) { return number_or(material, "index", 1.5, 0.2, 5); }

Finish read_diffuse(const JsonNode&, int) { return Lambertian{}; }

Finish read_mirror(const JsonNode& material, int channels) {
  return Mirror{read_checked(material.at("reflectance"), channels, require_part)};
}

Finish read_metal(const JsonNode& material, int channels) {
  const bool by_index = material.has("eta") || material.has("k");
  if (by_index == material.has("reflectance"))
    material.fail("a reflectance at normal incidence is expected of a metal, or eta and k");
  if (!by_index) return Metal{read_checked(material.at("reflectance"), channels, require_part), roughness_of(material)};
  return Metal{Metal::Index{read_checked(material.at("eta"), channels, require_index),
                            read_checked(material.at("k"), channels, require_index)},
               roughness_of(material)};
}

Finish read_dielectric(const JsonNode& material, int) { return Glass{index_of(material), roughness_of(material)}; }

Finish read_pane(const JsonNode& material, int channels) {
  const double index = index_of(material), most = most_transmitted(index);
  if (index < 1) material.at("index").fail("a pane is of a glass, whose index is 1 at least");
  const auto require_transmittance = [&](const JsonNode& node) {
    if (node.number_in(0, 1) > most * (1 + 1e-9))
      node.fail(core::format("%.9g: clear glass of index %.9g transmits %.6g, what is left is reflected", node.number(),
                             index, most));
  };
  return Pane{read_checked(material.at("transmittance"), channels, require_transmittance), index};
}

Finish read_plastic(const JsonNode& material, int) {
  const double index = index_of(material);
  if (index < 1) material.at("index").fail("a coat has an index of 1 at least");
  return Plastic{index};
}

const std::vector<Type>& types() {
  static const std::vector<Type> all{
      {"diffuse", {"reflectance", "emissivity", "temperature", "heat_flux"}, read_diffuse},
      {"mirror", {"reflectance"}, read_mirror},
      {"metal", {"reflectance", "eta", "k", "roughness"}, read_metal},
      {"dielectric", {"index", "roughness"}, read_dielectric},
      {"glass", {"transmittance", "index"}, read_pane},
      {"plastic", {"reflectance", "index"}, read_plastic}};
  return all;
}

const Type& type_in(const JsonNode& material) {
  const std::string name = material.has("type") ? material.at("type").string() : types().front().name;
  std::vector<std::string> names;
  for (const Type& type : types()) {
    if (type.name == name) return type;
    names.emplace_back(type.name);
  }
  material.at("type").fail(unknown_word("the type", name, names));
}

}  // namespace

Finish read_finish(const JsonNode& material, int channels) { return type_in(material).read(material, channels); }

std::vector<std::string> keys_of_type(const JsonNode& material) { return type_in(material).keys; }

}  // namespace interflect::scene::io
