#include "apps/optics_texts.h"

#include <algorithm>
#include <utility>

#include "core/format.h"

namespace interflect::apps {
namespace {

using results::Record;

/// Names and values of what a finish is by, in the words of scene files.
using Parts = std::vector<std::pair<std::string, std::variant<double, Spectrum>>>;

Parts parts_of(const scene::Mirror& mirror) { return {{"reflectance", mirror.reflectance}}; }
Parts parts_of(const scene::Metal& metal) {
  Parts parts;
  if (const auto* index = std::get_if<scene::Metal::Index>(&metal.reflects))
    parts = {{"eta", index->eta}, {"k", index->k}};
  else
    parts = {{"reflectance", std::get<Spectrum>(metal.reflects)}};
  parts.emplace_back("roughness", metal.roughness);
  return parts;
}
Parts parts_of(const scene::Glass& glass) { return {{"index", glass.index}, {"roughness", glass.roughness}}; }
Parts parts_of(const scene::Pane& pane) { return {{"transmittance", pane.transmittance}, {"index", pane.index}}; }
Parts parts_of(const scene::Plastic& plastic) { return {{"index", plastic.index}}; }
Parts parts_of(const scene::Lambertian&) { return {}; }

Parts parts_of(const scene::Material& material) {
  Parts parts = std::visit([](const auto& finish) { return parts_of(finish); }, material.finish);
  if (material.opacity < 1) parts.emplace_back("opacity", material.opacity);
  return parts;
}

std::string place_text(const Vec3& x) { return core::format("(%.4g, %.4g, %.4g)", x.x(), x.y(), x.z()); }
Record::Numbers numbers(const Vec3& x) { return {x.x(), x.y(), x.z()}; }

/// Every light with its type, in the order of their kinds.
template <class Use>
void for_each_light(const scene::Lights& lights, const Use& use) {
  for (const auto& light : lights.points) use("point", light);
  for (const auto& light : lights.spots) use("spot", light);
  for (const auto& light : lights.spheres) use("sphere", light);
  for (const auto& light : lights.suns) use("sun", light);
}

std::string flux_text(const Spectrum& flux, const scene::Scene& scene) {
  return core::format("%.6g %s", scene.weigh(flux), scene.flux_unit());
}

std::string describe(const scene::PointLight& light, const scene::Scene& scene) {
  return flux_text(light.flux(), scene) + ", at " + place_text(light.position);
}
std::string describe(const scene::SpotLight& light, const scene::Scene& scene) {
  return flux_text(light.flux(), scene) + ", at " + place_text(light.position) + ", towards " +
         place_text(light.direction);
}
std::string describe(const scene::SphereLight& light, const scene::Scene& scene) {
  return flux_text(light.flux(), scene) + ", at " + place_text(light.centre) +
         core::format(", radius %.4g m", light.radius);
}
std::string describe(const scene::Sun& sun, const scene::Scene& scene) {
  return core::format("%.6g %s across its rays, towards ", scene.weigh(sun.irradiance), scene.irradiance_unit()) +
         place_text(sun.direction);
}

std::string describe(const scene::Sky& sky, const scene::Scene& scene) {
  return core::format("%.6g %s, and %.6g below the horizon", scene.weigh(sky.radiance), scene.radiance_unit(),
                      scene.weigh(sky.ground));
}
std::string describe(const scene::EnvironmentMap& map, const scene::Scene&) {
  return core::format("a picture of %d x %d texels", map.columns(), map.rows());
}
std::string describe(const std::monostate&, const scene::Scene&) { return ""; }

void add(const scene::PointLight& light, int channels, Record& record) {
  record.add("flux", light.flux(), channels).add("position_m", numbers(light.position));
}
void add(const scene::SpotLight& light, int channels, Record& record) {
  record.add("flux", light.flux(), channels)
      .add("position_m", numbers(light.position))
      .add("direction", numbers(light.direction));
}
void add(const scene::SphereLight& light, int channels, Record& record) {
  record.add("flux", light.flux(), channels).add("centre_m", numbers(light.centre)).add("radius_m", light.radius);
}
void add(const scene::Sun& sun, int channels, Record& record) {
  record.add("irradiance", sun.irradiance, channels).add("direction", numbers(sun.direction));
}
void add(const scene::Sky& sky, int channels, Record& record) {
  record.add("model", "uniform").add("radiance", sky.radiance, channels).add("ground", sky.ground, channels);
}
void add(const scene::EnvironmentMap& map, int, Record& record) {
  record.add("model", "map").add("columns", map.columns()).add("rows", map.rows());
}
void add(const std::monostate&, int, Record&) {}

/// "4 (1 point, 2 spots, 1 sun)".
std::string count_text(const scene::Lights& lights) {
  const std::pair<const char*, std::size_t> kinds[] = {{"point", lights.points.size()},
                                                       {"spot", lights.spots.size()},
                                                       {"sphere", lights.spheres.size()},
                                                       {"sun", lights.suns.size()}};
  std::size_t all = 0;
  std::string text;
  for (const auto& [name, count] : kinds) {
    if (count == 0) continue;
    text += core::format("%s%zu %s%s", all > 0 ? ", " : "", count, name, count == 1 ? "" : "s");
    all += count;
  }
  return core::format("%zu (", all) + text + ")";
}

}  // namespace

std::string spectrum_text(const Spectrum& s, int channels) {
  bool equal = true;
  std::string text;
  for (int c = 0; c < channels; ++c) {
    equal = equal && s[c] == s[0];
    text += (c > 0 ? " " : "") + core::format("%.4g", s[c]);
  }
  return equal ? core::format("%.4g", s[0]) : text;
}

std::string finish_text(const scene::Material& material, int channels) {
  std::string text = type_of(material.finish);
  const char* before = ": ";
  for (const auto& [name, value] : parts_of(material)) {
    const auto* number = std::get_if<double>(&value);
    text += std::exchange(before, ", ") + name + " " +
            (number ? core::format("%.4g", *number) : spectrum_text(std::get<Spectrum>(value), channels));
  }
  return text;
}

results::Record finish_record(const scene::Material& material, int channels) {
  Record record;
  for (const auto& [name, value] : parts_of(material))
    if (const auto* number = std::get_if<double>(&value))
      record.add(name, *number);
    else
      record.add(name, std::get<Spectrum>(value), channels);
  return record;
}

std::string lights_text(const scene::Scene& scene) {
  constexpr std::size_t most = 20;  // lines; the rest is counted
  std::string text;
  std::size_t count = 0;
  for_each_light(scene.lights, [&](const char* type, const auto& light) {
    if (++count <= most) text += "               " + light.name + ", " + type + ": " + describe(light, scene) + "\n";
  });
  if (count > 0) text = "lights         " + count_text(scene.lights) + "\n" + text;
  if (count > most) text += core::format("               and %zu more\n", count - most);
  const std::string sky = std::visit([&](const auto& s) { return describe(s, scene); }, scene.lights.sky);
  return sky.empty() ? text : text + "sky            " + sky + "\n";
}

results::Record::List light_records(const scene::Scene& scene) {
  const int channels = scene.channel_count();
  Record::List list;
  for_each_light(scene.lights, [&](const char* type, const auto& light) {
    Record record;
    record.add("name", light.name).add("type", type);
    add(light, channels, record);
    list.push_back(std::move(record));
  });
  if (!scene.lights.has_sky()) return list;
  Record record;
  record.add("type", "sky");
  std::visit([&](const auto& sky) { add(sky, channels, record); }, scene.lights.sky);
  list.push_back(std::move(record));
  return list;
}

}  // namespace interflect::apps
