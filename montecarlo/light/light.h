#pragma once

#include <array>
#include <limits>
#include <optional>

#include "core/spectrum.h"
#include "core/vec.h"
#include "geometry/box.h"

namespace interflect::montecarlo {

/// A place that light arrives at.
struct Place {
  Vec3 position;
  Vec3 normal;  ///< unit: light counts from this side alone; zero: from both
};

/// Light that arrives at a place, straight, from a point of a light drawn for it.
struct Arriving {
  Vec3 way;         ///< unit, from the place towards the light
  double distance;  ///< [m]; infinite: from afar
  Vec3 position;    ///< on the light; of no meaning from afar
  Vec3 normal;      ///< unit, of the light's surface there; zero where it has none
  Spectrum light;  ///< radiance L [W/(m² sr)]; where the light is delta, irradiance H perpendicular to the way [W/m²]
  double pdf_solid_angle;  ///< of the way [1/sr]; 0 where the light is delta, and the way the only one
};

/// A particle of light as it leaves.
struct Emission {
  Vec3 position;
  Vec3 normal;      ///< unit, of the light's surface; of light from afar the way itself; zero at a point
  Vec3 way;         ///< unit
  Spectrum weight;  ///< L cos / (pdf_area pdf_solid_angle) [W | lm]: its mean is the flux
  double pdf_area;  ///< of the position [1/m²]; from afar, on the disk perpendicular to the way; 1 if is_delta_position
  double pdf_solid_angle;  ///< of the way, given the position [1/sr]; 1 if is_delta_direction
};

struct EmissionPdfs {
  double area, solid_angle;  ///< as in Emission
};

inline constexpr double infinite = std::numeric_limits<double>::infinity();

/// An irradiance that one sample of all light arriving can find: under the balance heuristic at most pi L, and at most
/// what arrives of the light, over the probability of its pick; infinite where nothing is known [W/m² | lx].
struct LargestFind {
  Spectrum pi_radiance, arriving;
};

/// What a light tree knows of a light, or of many: bounds of what they send where.
struct LightExtent {
  geometry::Box box;
  Vec3 axis = Vec3::UnitZ();  ///< normals lie within `cos_normals` of it,
  double cos_normals = -1;    ///< cosine of that half angle,
  double cos_emission = -1;   ///< and light within this half angle (at most a quarter turn counts) of a normal
  double intensity = 0;       ///< [W/sr] in the brightest direction and channel, of all together
  bool by_cosine = false;     ///< intensities fall as the cosine with the normal does
};

/// Something that shines, as all integrators see it: paths from the eye draw what arrives at a place; paths from
/// lights draw what leaves; and each knows the density with which the other would have drawn the same.
///
/// Measures: pdf_area [1/m²] and pdf_solid_angle [1/sr], and 1 for what is delta.  Light from afar (is_infinite) draws
/// its way first, with the pdf per solid angle, and then a place on the disk perpendicular to it that covers the scene,
/// with pdf_area = 1 / (pi R²): at a surface the density is cos / (pi R²), without a distance.
/// Identities: the mean of Emission::weight is flux();  the mean of L cos / p over sample_arriving is the unoccluded
/// irradiance;  pdfs integrate to 1 over what can be drawn.
/// Tests: tests/montecarlo/lights.cpp
class Light {
 public:
  virtual ~Light() = default;

  virtual Spectrum flux() const = 0;  ///< Phi [W | lm]; from afar, through the disk: pi R² int L d sigma
  /// @param u, v  uniform in [0, 1)
  /// @return      nothing where no light arrives for this draw
  virtual std::optional<Arriving> sample_arriving(const Place& at, double u, double v) const = 0;
  /// Of `sample_arriving` to draw a point of this light that is seen there along `way`; 0 where the light is delta.
  virtual double pdf_arriving_solid_angle(const Place& at, const Vec3& way, const Vec3& position) const = 0;
  /// @param u  uniform in [0, 1): position by the first two, way by the last two
  virtual Emission sample_emission(const std::array<double, 4>& u) const = 0;
  /// Of `sample_emission` to draw a particle that leaves from a point of this light; 0 for what it cannot draw.
  virtual EmissionPdfs pdfs_emission(const Vec3& position, const Vec3& way) const = 0;
  /// L that leaves from a point of the light [W/(m² sr)]; zero where it is delta.
  virtual Spectrum radiance(const Vec3& position, const Vec3& way) const = 0;
  /// Bounds of what one sample can find, for a receiver at the distance `from` of it [m].
  virtual LargestFind largest_find(double from) const = 0;
  /// Of light from nearby.
  virtual LightExtent extent() const = 0;

  virtual bool is_delta_position() const { return false; }
  virtual bool is_delta_direction() const { return false; }
  virtual bool is_infinite() const { return false; }
  bool is_delta() const { return is_delta_position() || is_delta_direction(); }
};

}  // namespace interflect::montecarlo
