#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "scene/builder.h"
#include "scene/io/checked_spectrum.h"

namespace interflect::scene::io {

/// Names of the channels: the key "channels", or what the lengths of the materials' arrays ask for: y, or r, g, b, or
/// band_1 ..
std::vector<std::string> read_channels(const JsonNode& root);

/// The key "materials".  A material enters the scene when it is used, once for each meaning of "sides" where it does
/// not say.
class MaterialLibrary {
 public:
  MaterialLibrary(const JsonNode& materials, int channels);

  /// Refuses the name of an unknown material where it stands; a known one stays unused.
  void require(const JsonNode& name) const { index_of(name); }

  bool has(const std::string& name) const { return std::find(names_.begin(), names_.end(), name) != names_.end(); }

  /// @param name      where it is named: an unknown one is refused there
  /// @param fallback  sides of a material that does not say
  MaterialId use(SceneBuilder& builder, const JsonNode& name, Sides fallback);

  /// Shares each flux over the surfaces that bear it, now that they are all there, and notes what was never used.
  void finish(SceneBuilder& builder, const std::string& file) const;

 private:
  struct Entry {
    Material material;
    bool says_sides = false;
    std::optional<Spectrum> flux;                   ///< [W | lm]
    std::array<std::optional<MaterialId>, 2> used;  ///< by Sides
  };
  std::size_t index_of(const JsonNode& name) const;
  static Entry read_entry(const std::string& name, const JsonNode& node, int channels);
  static void share_flux(SceneBuilder& builder, const Entry& entry);

  std::vector<Entry> entries_;
  std::vector<std::string> names_;
};

}  // namespace interflect::scene::io
