#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/box.h"
#include "geometry/polygon.h"
#include "scene/camera.h"
#include "scene/light.h"
#include "scene/material.h"
#include "scene/place.h"
#include "scene/sensor.h"

namespace interflect::scene {

enum class Quantity : std::uint8_t { photometric, radiometric };

/// A triangle of the scene as it was given: what rays meet.
struct Facet {
  SurfaceId surface;
  std::array<Vec3, 3> corner;  ///< counter-clockwise around the front
  Vec3 normal;                 ///< unit, out of the front
  double area;                 ///< [m²]
};
/// With the normal and area that these corners have; a normal of 0 where they have none.
Facet make_facet(SurfaceId surface, const std::array<Vec3, 3>& corner);

/// An input surface: what a person names and asks about.  Its facets are scene.facets[first_facet .. first_facet +
/// facets).
struct Surface {
  std::string name;  ///< its sides' names (Scene::side_name) are unique in the scene
  MaterialId material;
  std::uint32_t first_facet = 0, facets = 0;
  std::optional<geometry::PlanarPolygon> outline;  ///< where it is one planar polygon: elements may ignore its facets
};

/// What a back's name ends in.
inline constexpr const char* back_suffix = "/back";

/// A repair or a finding of the reader, counted; nothing is repaired silently.
struct Note {
  std::string place;    ///< "room.obj"
  std::string message;  ///< "12 degenerate faces dropped"
  std::string line() const { return place + ": " + message; }
};

/// What is lit and what is asked, in SI units, as read and checked.  It does not change after reading.
struct Scene {
  std::filesystem::path file;
  Quantity quantity = Quantity::photometric;
  Vec3 up = Vec3::UnitZ();
  double north_deg = 0;
  std::vector<std::string> channels;  ///< their names; 1 .. Spectrum::capacity
  Spectrum weights;  ///< one number from a spectrum (lx, or W/m²): sum_c weights[c] value[c]; 0 beyond the channels
  std::vector<Material> materials;
  std::vector<Surface> surfaces;
  std::vector<Facet> facets;
  Lights lights;  ///< beside surfaces that emit
  std::vector<Sensor> sensors;
  std::vector<Camera> cameras;
  std::vector<Expected> expected;
  std::vector<Note> repairs, warnings;

  int channel_count() const { return static_cast<int>(channels.size()); }
  const Surface& surface(SurfaceId id) const { return surfaces[id.value]; }
  const Material& material(SurfaceId id) const { return materials[surfaces[id.value].material.value]; }
  const Camera& camera(CameraId id) const { return cameras[id.value]; }
  std::span<const Facet> facets_of(SurfaceId id) const {
    return std::span(facets).subspan(surface(id).first_facet, surface(id).facets);
  }
  std::vector<SurfaceId> surface_ids() const;
  std::string side_name(SurfaceId id, Side side) const;  ///< "NAME", or "NAME/back" for a back: unique in the scene
  std::optional<CameraId> find_camera(const std::string& name) const;

  double area(SurfaceId id) const;  ///< of one side [m²]
  geometry::Box box() const;        ///< of all facets [m]
  double weigh(
      const Spectrum& s) const;   ///< sum_c weights[c] s[c], where a weight of 0 leaves out what is infinite too
  Spectrum emitted_flux() const;  ///< sum of A E over the surfaces [W | lm]
  const char* irradiance_unit() const { return quantity == Quantity::photometric ? "lx" : "W/m2"; }
  const char* radiance_unit() const { return quantity == Quantity::photometric ? "cd/m2" : "W/(m2 sr)"; }
  const char* flux_unit() const { return quantity == Quantity::photometric ? "lm" : "W"; }

  /// Linear red, green, blue of a spectrum, for looking: the channels themselves where they are r, g, b, else grey.
  std::array<double, 3> rgb(const Spectrum& s) const;
};

}  // namespace interflect::scene
