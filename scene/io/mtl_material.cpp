#include "scene/io/mtl_material.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/format.h"
#include "scene/io/text_file.h"
#include "scene/luminance.h"

namespace interflect::scene::io {
namespace {

using Statement = MtlEntry::Statement;

/// Largest part that is left out beside one that is kept, of the latter.
constexpr double negligible = 0.05;

/// Read where they count, or of no meaning here: ambience is no light, and exponents shape highlights alone.
constexpr std::array understood{"Ka", "Kd", "Ks", "Ke",    "Tf", "Ni",        "Ns",
                                "d",  "Tr", "Pm", "illum", "Pr", "sharpness", "map_aat"};

class MtlReading {
 public:
  MtlReading(const MtlEntry& entry, const std::vector<std::string>& channels) : entry_(entry), channels_(channels) {}

  MtlMaterial run() {
    Material& m = out_.material;
    m.name = m.group = entry_.name;
    m.sides = Sides::both;
    const double illum = number("illum").value_or(2);
    if (!is_metal() && !is_mirror(illum) && !is_clear(illum)) set_diffuse(illum);
    if (!std::holds_alternative<Glass>(m.finish)) set_opacity();
    leave_out_if(is_some("Ke"), "Ke");
    for (const Statement& s : entry_.statements)
      if (std::find(understood.begin(), understood.end(), s.key) == understood.end())
        leave_out_if(!is_zero(s), shown_word(s.key));
    return std::move(out_);
  }

 private:
  bool is_metal() {
    const double metallic = number("Pm").value_or(0);
    const auto roughness = number("Pr");
    if (metallic != 1 || !roughness) {
      leave_out_if(metallic != 0, "Pm");
      leave_out_if(roughness.has_value(), "Pr");
      return false;
    }
    const double part = require_part(*entry_.find("Pr"), *roughness);
    out_.material.finish = Metal{part_of(required("Kd")), part * part};
    return true;
  }

  bool is_mirror(double illum) {
    if ((illum != 3 && illum != 5) || !is_some("Ks")) return false;
    const double diffuse = most("Kd"), specular = most("Ks");
    if (diffuse > negligible * specular) return false;
    leave_out_if(diffuse > 0, "Kd");
    const Spectrum reflectance = part_of(required("Ks"));
    if (illum == 3)
      out_.material.finish = Mirror{reflectance};
    else
      out_.material.finish = Metal{reflectance, 0};
    return true;
  }

  bool is_clear(double illum) {
    if (illum != 7) return false;
    const double index = number("Ni").value_or(1), diffuse = most("Kd");
    const bool clear = diffuse <= negligible && (!entry_.find("Tf") || *colour("Tf") == Vec3::Ones()) &&
                       (!entry_.find("d") || dissolve() == 1);
    if (index == 1 || index < 0.2 || index > 5 || !clear) return false;
    leave_out_if(diffuse > 0, "Kd");
    out_.material.finish = Glass{index, 0};
    return true;
  }

  void set_diffuse(double illum) {
    const Statement& kd = required("Kd");
    out_.material.reflectance = part_of(kd);
    if (!(out_.material.reflectance.max() < 1)) fail(kd, "a reflectance of 1 is not below 1");
    const bool has_highlights = illum == 2 || illum == 3 || illum == 5;
    if (has_highlights)
      leave_out_if(is_some("Ks"), "Ks");
    else
      leave_out_if(illum != 0 && illum != 1, core::format("illum %g", illum));
  }

  /// Of Tr some programs write 1 - d, and some d: it says nothing where it is not 0.
  void set_opacity() {
    if (entry_.find("d"))
      out_.material.opacity = dissolve();
    else
      leave_out_if(is_some("Tr"), "Tr");
  }

  double dissolve() {
    const Statement& d = *entry_.find("d");
    if (d.words.empty() || d.words[0] != "-halo") return require_part(d, *number("d"));
    leave_out_if(true, "d -halo");
    return 1;
  }

  void leave_out_if(bool condition, const std::string& key) {
    auto& all = out_.left_out;
    if (condition && std::find(all.begin(), all.end(), key) == all.end()) all.push_back(key);
  }

  [[noreturn]] void fail(const Statement& s, const std::string& message) const { fail_at(s.place, message); }
  [[noreturn]] void fail_at(const std::string& place, const std::string& message) const {
    throw core::InputError(
        place, message + " (the scene's \"materials\" may map '" + shown_word(entry_.name) + "' to one of its own)");
  }

  const Statement& required(const char* key) const {
    const Statement* s = entry_.find(key);
    if (!s) fail_at(entry_.place, "the material has no " + std::string(key));
    return *s;
  }

  double number_in(const Statement& s, std::size_t word) const {
    const auto value = number_of(s.words[word]);
    if (!value || !std::isfinite(*value))
      fail(s, s.key + ": '" + shown_word(s.words[word]) + "' is not a finite number");
    return *value;
  }
  std::optional<double> number(const char* key) const {
    const Statement* s = entry_.find(key);
    if (!s) return std::nullopt;
    if (s->words.size() != 1) fail(*s, s->key + ": one number is expected");
    return number_in(*s, 0);
  }
  /// One number is a grey.
  Vec3 colour(const Statement& s) const {
    if (s.words.size() == 1) return Vec3::Constant(number_in(s, 0));
    if (s.words.size() != 3) fail(s, s.key + ": one number or three are expected");
    return {number_in(s, 0), number_in(s, 1), number_in(s, 2)};
  }
  std::optional<Vec3> colour(const char* key) const {
    const Statement* s = entry_.find(key);
    return s ? std::optional(colour(*s)) : std::nullopt;
  }
  double most(const char* key) const { return colour(key).value_or(Vec3::Zero()).maxCoeff(); }
  bool is_some(const char* key) const { return colour(key).value_or(Vec3::Zero()) != Vec3::Zero(); }
  static bool is_zero(const Statement& s) {
    return !s.words.empty() &&
           std::all_of(s.words.begin(), s.words.end(), [](const std::string& w) { return number_of(w) == 0.; });
  }

  double require_part(const Statement& s, double value) const {
    if (!(value >= 0 && value <= 1)) fail(s, s.key + core::format(": %.9g is outside 0..1", value));
    return value;
  }
  Spectrum part_of(const Statement& s) const {
    const Vec3 rgb = colour(s);
    for (const double value : rgb) require_part(s, value);
    return in_channels(s, rgb);
  }
  Spectrum in_channels(const Statement& s, const Vec3& rgb) const {
    Spectrum out;
    const bool grey = rgb == Vec3::Constant(rgb[0]);
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      const std::string name = core::lower_case(channels_[c]);
      const std::size_t at = std::string("rgb").find(name);
      const int channel = static_cast<int>(c);
      if (grey)
        out[channel] = rgb[0];
      else if (name.size() == 1 && at != std::string::npos)
        out[channel] = rgb[static_cast<Eigen::Index>(at)];
      else if (channels_.size() == 1)
        out[channel] = rgb.dot(Vec3(srgb_luminance[0], srgb_luminance[1], srgb_luminance[2]));
      else
        fail(s, s.key + ": a colour is of red, green and blue, and the scene has the channel '" +
                    shown_word(channels_[c]) + "'");
    }
    return out;
  }

  const MtlEntry& entry_;
  const std::vector<std::string>& channels_;
  MtlMaterial out_;
};

}  // namespace

MtlMaterial mtl_material(const MtlEntry& entry, const std::vector<std::string>& channels) {
  return MtlReading(entry, channels).run();
}

}  // namespace interflect::scene::io
