#include "scene/io/light_reader.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/format.h"
#include "scene/io/checked_spectrum.h"
#include "scene/io/text_file.h"
#include "scene/luminance.h"

namespace interflect::scene::io {
namespace {

void require_emission(const JsonNode& node) {
  if (node.number() < 0) node.fail(core::format("%.9g is negative: light is not less than nothing", node.number()));
}

/// A light's key by key.
class LightNode {
 public:
  LightNode(const JsonNode& node, const LengthUnit& unit, Scene& scene) : node_(node), scene_(scene) {
    placement_.unit = unit;
  }

  Vec3 place(const char* key) const { return read_place(node_.at(key), placement_); }
  Spectrum emission(const char* key) const {
    return read_checked(node_.at(key), scene_.channel_count(), require_emission);
  }
  /// What a key says, or a flux shared by what one unit of it would send.
  Spectrum emission_or_flux(const char* key, double flux_of_one) const {
    if (node_.has(key) == node_.has("flux")) node_.fail(std::string("one of '") + key + "' and 'flux' is expected");
    return node_.has(key) ? emission(key) : emission("flux") / flux_of_one;
  }
  /// By 'direction', or by a place that it aims at.
  Vec3 aim(const Vec3& from) const {
    if (node_.has("direction") == node_.has("target")) node_.fail("one of 'direction' and 'target' is expected");
    if (node_.has("direction")) return read_direction(node_.at("direction"));
    const Vec3 way = place("target") - from;
    if (!(way.stableNorm() > 0)) node_.at("target").fail("the light aims at itself");
    return way.stableNormalized();
  }
  std::string name() const {
    const Lights& lights = scene_.lights;
    std::vector<std::string> taken;
    for (const auto& l : lights.points) taken.push_back(l.name);
    for (const auto& l : lights.spots) taken.push_back(l.name);
    for (const auto& l : lights.spheres) taken.push_back(l.name);
    for (const auto& l : lights.suns) taken.push_back(l.name);
    const std::string name =
        node_.has("name") ? node_.at("name").string() : core::format("light-%zu", taken.size() + 1);
    if (name.empty()) node_.at("name").fail("a light needs a name, or none");
    if (std::find(taken.begin(), taken.end(), name) != taken.end())
      (node_.has("name") ? node_.at("name") : node_).fail("the name '" + shown_word(name) + "' is taken");
    return name;
  }

  void read_point() {
    node_.only({"type", "name", "position", "intensity", "flux"});
    scene_.lights.points.push_back({name(), place("position"), emission_or_flux("intensity", 4 * pi)});
  }

  void read_spot() {
    node_.only({"type", "name", "position", "direction", "target", "intensity", "flux", "beam_half_angle_deg",
                "field_half_angle_deg"});
    SpotLight spot{name(), place("position"), {}, {}, 1, 0};
    spot.direction = aim(spot.position);
    const double beam = node_.at("beam_half_angle_deg").number_in(0, 180),
                 field = node_.has("field_half_angle_deg") ? node_.at("field_half_angle_deg").number_in(0, 180) : beam;
    if (field < beam) node_.at("field_half_angle_deg").fail("the field holds the beam: it is no narrower");
    if (field == 0) node_.at("beam_half_angle_deg").fail("a cone of 0 degrees holds no light");
    spot.cos_beam = cosine_sine(beam)[0], spot.cos_field = cosine_sine(field)[0];
    if (!(spot.cos_field < 1)) node_.at("beam_half_angle_deg").fail("this cone is too narrow for double precision");
    spot.intensity = emission_or_flux("intensity", pi * (2 - spot.cos_beam - spot.cos_field));
    scene_.lights.spots.push_back(std::move(spot));
  }

  void read_sphere() {
    node_.only({"type", "name", "centre", "radius", "exitance", "flux"});
    SphereLight sphere{name(), place("centre"), placement_.unit.metres(node_.at("radius").positive()), {}};
    if (!is_within_reach(Vec3(sphere.radius, 0, 0)) || !(sphere.radius > smallest))
      node_.at("radius").fail("a radius between 1e-15 and 1e15 m is expected");
    sphere.exitance = emission_or_flux("exitance", sphere.area());
    scene_.lights.spheres.push_back(std::move(sphere));
  }

  void read_sun() {
    node_.only({"type", "name", "direction", "irradiance", "angular_radius_deg"});
    Sun sun{name(), read_direction(node_.at("direction")), emission("irradiance")};
    if (node_.has("angular_radius_deg")) {
      const JsonNode radius = node_.at("angular_radius_deg");
      sun.angular_radius = radius.number_in(0, 89) * pi / 180;
      if (sun.angular_radius > 0 && sun.angular_radius < 1e-6)
        radius.fail("less than 1e-6 rad: give 0, parallel light");
    }
    scene_.lights.suns.push_back(std::move(sun));
  }

 private:
  const JsonNode& node_;
  Scene& scene_;
  Placement placement_;
};

Sky read_uniform_sky(const JsonNode& node, const Scene& scene) {
  node.only({"model", "radiance", "horizontal_illuminance", "ground_reflectance"});
  if (node.has("radiance") == node.has("horizontal_illuminance"))
    node.fail("one of 'radiance' and 'horizontal_illuminance' is expected");
  Sky sky{scene.up, {}, {}};
  sky.radiance = node.has("radiance")
                     ? read_checked(node.at("radiance"), scene.channel_count(), require_emission)
                     : read_checked(node.at("horizontal_illuminance"), scene.channel_count(), require_emission) / pi;
  if (node.has("ground_reflectance")) sky.ground = node.at("ground_reflectance").number_in(0, 1) * sky.radiance;
  return sky;
}

/// Which channel of the picture each of the scene's is: by name (r is R), or all by one, or luminance by R, G and B.
Spectrum spectrum_of(const core::Image& picture, int x, int y, const std::vector<int>& channel, bool luminance) {
  Spectrum out;
  if (luminance) {
    for (std::size_t c = 0; c < 3; ++c) out[0] += srgb_luminance[c] * double{picture.at(x, y, channel[c])};
    return out;
  }
  for (std::size_t c = 0; c < channel.size(); ++c) out[static_cast<int>(c)] = double{picture.at(x, y, channel[c])};
  return out;
}

std::optional<std::vector<int>> channels_named(const core::Image& picture, const std::vector<std::string>& names) {
  std::vector<int> found;
  for (const std::string& name : names)
    for (std::size_t c = 0; c < picture.channels.size(); ++c)
      if (core::lower_case(picture.channels[c]) == core::lower_case(name)) found.push_back(static_cast<int>(c));
  if (found.size() != names.size()) return std::nullopt;
  return found;
}

EnvironmentMap read_map(const JsonNode& node, const std::filesystem::path& folder, const PictureReader& read_picture,
                        const Scene& scene) {
  node.only({"model", "file", "scale", "rotation_deg"});
  const JsonNode file = node.at("file");
  if (!read_picture) file.fail("this program reads no pictures");
  const core::Image picture = [&] {
    try {
      return read_picture(folder / file.string());
    } catch (const core::InputError& error) {
      file.fail(error.what());
    }
  }();
  std::optional<std::vector<int>> channels = channels_named(picture, scene.channels);
  bool luminance = false;
  if (!channels && picture.channels.size() == 1)
    channels = std::vector<int>(scene.channels.size(), 0);
  else if (!channels && scene.channels.size() == 1)
    luminance = (channels = channels_named(picture, {"r", "g", "b"})).has_value();
  if (!channels) file.fail("the picture has not the scene's channels");
  const double scale = node.has("scale") ? node.at("scale").number() : 1;
  if (scale < 0) node.at("scale").fail("light is not less than nothing");
  std::vector<Spectrum> radiance;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const Spectrum texel = spectrum_of(picture, x, y, *channels, luminance) * scale;
      for (int c = 0; c < scene.channel_count(); ++c)
        if (!(texel[c] >= 0 && std::isfinite(texel[c])))
          file.fail(core::format("texel (%d, %d) is %g: radiance is finite and not negative", x, y, texel[c]));
      radiance.push_back(texel);
    }
  // The picture's middle: +y of a scene whose z is up, -z of one whose y is; turned clockwise, seen from above.
  const bool z_up = scene.up.z() > 0;
  const Vec3 ahead = z_up ? Vec3(Vec3::UnitY()) : Vec3(-Vec3::UnitZ()), right = ahead.cross(scene.up);
  const auto [cosine, sine] = cosine_sine(node.has("rotation_deg") ? node.at("rotation_deg").number() : 0);
  return {scene.up, cosine * ahead + sine * right, picture.height, picture.width, std::move(radiance)};
}

}  // namespace

void read_lights(const JsonNode& lights, const LengthUnit& unit, Scene& scene) {
  constexpr std::array readers{&LightNode::read_point, &LightNode::read_spot, &LightNode::read_sphere,
                               &LightNode::read_sun};
  for (const JsonNode& node : lights.items()) {
    LightNode light(node, unit, scene);
    (light.*readers[node.at("type").one_of({"point", "spot", "sphere", "sun"})])();
  }
}

void read_sky(const JsonNode& sky, const std::filesystem::path& folder, const PictureReader& read_picture,
              Scene& scene) {
  switch (sky.at("model").one_of({"none", "uniform", "map"})) {
    case 0:
      sky.only({"model"});
      break;
    case 1:
      scene.lights.sky = read_uniform_sky(sky, scene);
      break;
    default:
      scene.lights.sky = read_map(sky, folder, read_picture, scene);
  }
}

}  // namespace interflect::scene::io
