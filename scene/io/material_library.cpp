#include "scene/io/material_library.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/format.h"
#include "scene/io/finish_reader.h"
#include "scene/io/text_file.h"

namespace interflect::scene::io {
namespace {

void require_reflectance(const JsonNode& node) {
  if (node.number_in(0, 1) == 1) node.fail("a reflectance of 1 is not below 1: every surface absorbs some light");
}

void require_emission(const JsonNode& node) {
  if (node.number() < 0)
    node.fail(core::format("%.9g is negative: a surface cannot emit less than nothing", node.number()));
}

/// Of every type; clear bodies shine by what is behind them.
void require_known_keys(const JsonNode& node) {
  std::vector<std::string> keys = keys_of_type(node);
  for (const char* key : {"type", "exitance", "flux", "sides", "group", "opacity"}) keys.emplace_back(key);
  node.only(keys);
}

bool is_clear(const Finish& finish) {
  return std::holds_alternative<Glass>(finish) || std::holds_alternative<Pane>(finish);
}

/// What lets light through has two sides, and no light of its own.
void require_clear(const JsonNode& node) {
  for (const char* key : {"exitance", "flux"})
    if (node.has(key)) node.at(key).fail("what is clear does not emit: give the light a surface of its own");
  if (node.has("sides") && node.at("sides").one_of({"front", "both"}) == 0)
    node.at("sides").fail("light passes both sides of what is clear: \"both\" is expected, or nothing");
}

/// A grey surface that exchanges heat: 1 - emissivity is its reflectance, and what it emits its temperature says.
Thermal read_thermal(const JsonNode& node) {
  for (const char* key : {"reflectance", "exitance", "flux"})
    if (node.has(key)) node.at(key).fail("emissivity and " + std::string(key) + " exclude each other: give one");
  Thermal thermal{node.at("emissivity").number_in(0, 1), std::nullopt, 0};
  if (thermal.emissivity == 0)
    node.at("emissivity").fail("an emissivity of 0 is not above 0: every surface absorbs some radiation");
  if (node.has("temperature") == node.has("heat_flux"))
    node.fail("a temperature [K] or a heat_flux [W/m2] is expected beside an emissivity, one of them");
  if (node.has("heat_flux")) {
    thermal.heat_flux = node.at("heat_flux").number();
    return thermal;
  }
  thermal.temperature = node.at("temperature").number();
  if (*thermal.temperature < 0) node.at("temperature").fail("below absolute zero: kelvin are expected");
  return thermal;
}

/// As a solve sees it: grey, and emitting by Stefan and Boltzmann's law.
void set_thermal(const Thermal& thermal, int channels, Material& material) {
  const double t = thermal.temperature.value_or(0);
  for (int c = 0; c < channels; ++c) {
    material.reflectance[c] = 1 - thermal.emissivity;
    material.exitance[c] = thermal.emissivity * stefan_boltzmann * t * t * t * t;
  }
  material.thermal = thermal;
}

/// Names that an EXR picture can hold beside each other: it has a NAME.error for every NAME, one for the number of
/// samples, and r becomes R.
std::vector<std::string> read_channel_names(const JsonNode& channels) {
  constexpr std::size_t most = Spectrum::capacity;
  const auto nodes = channels.items(1);
  if (nodes.size() > most)
    channels.fail(core::format("%zu channels: this build holds at most %zu", nodes.size(), most));
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const JsonNode& node : nodes) {
    const std::string name = node.string(), lower = core::lower_case(name);
    if (name.empty()) node.fail("a channel needs a name");
    if (lower.ends_with(".error")) node.fail("a channel's name does not end in '.error': pictures keep errors there");
    if (lower == "samples") node.fail("'samples' is what pictures count samples by: another name is expected");
    if (!taken.insert(lower).second)
      node.fail("two channels have the name '" + shown_word(name) + "' (upper and lower case are one)");
    names.push_back(name);
  }
  return names;
}

}  // namespace

Spectrum read_spectrum(const JsonNode& node, int channels) {
  if (node.is_object()) node.fail("this version does not know spectra from files: a number or an array is expected");
  Spectrum out;
  if (node.is_number()) {
    for (int c = 0; c < channels; ++c) out[c] = node.number();
    return out;
  }
  if (!node.is_array()) node.fail("a number or an array of numbers is expected");
  const auto values = node.items();
  if (values.size() != static_cast<std::size_t>(channels))
    node.fail(
        core::format("%zu numbers for a scene of %d channel%s", values.size(), channels, channels == 1 ? "" : "s"));
  for (int c = 0; c < channels; ++c) out[c] = values[static_cast<std::size_t>(c)].number();
  return out;
}

std::vector<std::string> read_channels(const JsonNode& root) {
  constexpr std::size_t most = Spectrum::capacity;
  if (root.has("channels")) return read_channel_names(root.at("channels"));
  for (const auto& [name, material] : root.at("materials").members())
    for (const char* key : {"reflectance", "exitance", "flux", "transmittance", "eta", "k"}) {
      if (!material.is_object() || !material.has(key) || !material.at(key).is_array()) continue;
      const std::size_t count = material.at(key).items(1).size();
      if (count > most) material.at(key).fail(core::format("%zu channels: this build holds at most %zu", count, most));
      if (count == 3) return {"r", "g", "b"};
      if (count == 1) return {"y"};
      std::vector<std::string> names;
      for (std::size_t c = 1; c <= count; ++c) names.push_back(core::format("band_%zu", c));
      return names;
    }
  return {"y"};
}

MaterialLibrary::MaterialLibrary(const JsonNode& materials, int channels) {
  for (const auto& [name, node] : materials.members()) {
    entries_.push_back(read_entry(name, node, channels));
    names_.push_back(name);
  }
}

MaterialLibrary::Entry MaterialLibrary::read_entry(const std::string& name, const JsonNode& node, int channels) {
  require_known_keys(node);
  Entry entry;
  entry.material.finish = read_finish(node, channels);
  if (node.has("opacity")) entry.material.opacity = node.at("opacity").number_in(0, 1);
  entry.material.name = name;
  entry.material.group = node.has("group") ? node.at("group").string() : name;
  if (entry.material.group.empty()) node.at("group").fail("a light group needs a name");
  if (node.has("emissivity"))
    set_thermal(read_thermal(node), channels, entry.material);
  else if (std::holds_alternative<Lambertian>(entry.material.finish) ||
           std::holds_alternative<Plastic>(entry.material.finish))
    entry.material.reflectance = read_checked(node.at("reflectance"), channels, require_reflectance);
  for (const char* key : {"temperature", "heat_flux"})
    if (node.has(key) && !node.has("emissivity")) node.at(key).fail("an emissivity is expected beside it");
  if (node.has("exitance") && node.has("flux")) node.fail("exitance and flux exclude each other: give one");
  if (node.has("exitance")) entry.material.exitance = read_checked(node.at("exitance"), channels, require_emission);
  if (node.has("flux")) entry.flux = read_checked(node.at("flux"), channels, require_emission);
  entry.says_sides = node.has("sides");
  if (entry.says_sides)
    entry.material.sides = node.at("sides").one_of({"front", "both"}) == 0 ? Sides::front : Sides::both;
  if (entry.material.opacity < 1 && (node.has("exitance") || node.has("flux")))
    node.at("opacity").fail("what emits is all there");
  if (is_clear(entry.material.finish)) {
    require_clear(node);
    entry.says_sides = true;
    entry.material.sides = Sides::both;
  }
  return entry;
}

std::size_t MaterialLibrary::index_of(const JsonNode& name) const {
  const auto at = std::find(names_.begin(), names_.end(), name.string());
  if (at == names_.end()) name.fail(unknown_word("the material", name.string(), names_));
  return static_cast<std::size_t>(at - names_.begin());
}

MaterialId MaterialLibrary::use(SceneBuilder& builder, const JsonNode& name, Sides fallback) {
  Entry& entry = entries_[index_of(name)];
  const Sides sides = entry.says_sides ? entry.material.sides : fallback;
  const std::size_t other = sides == Sides::front ? 1 : 0;
  auto& id = entry.used[static_cast<std::size_t>(sides)];
  if (!id) {
    Material material = entry.material;
    material.sides = sides;
    if (entry.used[other]) material.name += sides == Sides::front ? " (front)" : " (both sides)";
    id = builder.add_material(std::move(material));
  }
  return *id;
}

/// The flux of one name, over the surfaces of both its materials: to each in proportion to its area.
void MaterialLibrary::share_flux(SceneBuilder& builder, const Entry& entry) {
  std::array<double, 2> area{};
  const Scene& scene = builder.scene();
  for (const SurfaceId id : scene.surface_ids())
    for (std::size_t s = 0; s < 2; ++s)
      if (entry.used[s] && scene.surface(id).material == *entry.used[s]) area[s] += scene.area(id);
  for (std::size_t s = 0; s < 2; ++s)
    if (area[s] > 0) builder.share_flux(*entry.used[s], *entry.flux * (area[s] / (area[0] + area[1])));
}

void MaterialLibrary::finish(SceneBuilder& builder, const std::string& file) const {
  for (const Entry& entry : entries_) {
    if (entry.flux) share_flux(builder, entry);
    if (!entry.used[0] && !entry.used[1])
      builder.scene().warnings.push_back({file, "the material '" + shown_word(entry.material.name) + "' is not used"});
  }
}

}  // namespace interflect::scene::io
