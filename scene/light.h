#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/spectrum.h"
#include "core/vec.h"

/// What shines beside surfaces (docs/lights.md).  Photometric units stand beside the radiometric ones.
namespace interflect::scene {

/// The same intensity in every direction.
struct PointLight {
  std::string name;
  Vec3 position;
  Spectrum intensity;  ///< I [W/sr | cd]

  Spectrum flux() const { return 4 * pi * intensity; }
};

/// A point that shines into a cone: I within the beam, none beyond the field, and between them, in the cosine c of the
/// angle with the axis,
///
///   I(c) = I t² (3 - 2 t),   t = (c - cos field) / (cos beam - cos field),   so that   Phi = pi I (2 - cos beam - cos
///   field).
struct SpotLight {
  std::string name;
  Vec3 position, direction;    ///< unit: where its axis leads to
  Spectrum intensity;          ///< I within the beam [W/sr | cd]
  double cos_beam, cos_field;  ///< of half angles, cos_beam >= cos_field

  double falloff(double cosine) const {  ///< I(c) / I, 0 .. 1
    if (cosine >= cos_beam) return 1;
    if (cosine <= cos_field) return 0;
    const double t = (cosine - cos_field) / (cos_beam - cos_field);
    return t * t * (3 - 2 * t);
  }
  Spectrum flux() const { return pi * (2 - cos_beam - cos_field) * intensity; }
};

/// A ball that shines diffusely and reflects nothing.  It is a body: rays end on it.
struct SphereLight {
  std::string name;
  Vec3 centre;
  double radius;      ///< [m]
  Spectrum exitance;  ///< E, outwards [W/m² | lm/m²]

  double area() const { return 4 * pi * radius * radius; }
  Spectrum flux() const { return area() * exitance; }
};

/// A disk far away, equally bright all over.
struct Sun {
  static constexpr double seen_from_earth = 0.2665 * pi / 180;  ///< half angle [rad]

  std::string name;
  Vec3 direction;                           ///< unit: where its light goes to
  Spectrum irradiance;                      ///< H on a plane perpendicular to its middle ray [W/m² | lx]
  double angular_radius = seen_from_earth;  ///< half angle alpha [rad], < pi / 2; 0: parallel light

  double squared_sine() const;                  ///< sin² alpha
  double one_minus_cosine() const;              ///< 1 - cos alpha, without cancellation
  Spectrum radiance() const;                    ///< H / (pi sin² alpha) [W/(m² sr) | cd/m²]; not for alpha = 0
  bool shines_from(const Vec3& towards) const;  ///< whether the disk lies that way
};

/// The same radiance from all directions above the horizon, and another from below.
struct Sky {
  Vec3 up;
  Spectrum radiance, ground;  ///< L above and below [W/(m² sr) | cd/m²]

  const Spectrum& seen(const Vec3& towards) const { return towards.dot(up) > 0 ? radiance : ground; }
};

/// Radiance all around by a picture in longitude and latitude, every texel of which is equally bright.
///
/// Row 0 begins at the zenith `up`, the last ends at the nadir, each as high as pi / rows.  Columns go round clockwise
/// as seen from above, and the picture's middle lies towards `middle`.
class EnvironmentMap {
 public:
  /// @param middle  horizontal direction, unit, perpendicular to up
  /// @param radiance  row by row, rows * columns
  EnvironmentMap(const Vec3& up, const Vec3& middle, int rows, int columns, std::vector<Spectrum> radiance);

  int rows() const { return rows_; }
  int columns() const { return columns_; }
  const Spectrum& texel(int row, int column) const {
    return radiance_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                     static_cast<std::size_t>(column)];
  }
  /// Of any texel of a row [sr]: (cos theta_a - cos theta_b) 2 pi / columns.
  double solid_angle(int row) const;
  /// Where a direction lies.
  struct Texel {
    int row, column;
  };
  Texel at(const Vec3& towards) const;
  const Spectrum& seen(const Vec3& towards) const {
    const Texel t = at(towards);
    return texel(t.row, t.column);
  }
  /// Cosine with the zenith, and turns from the picture's left edge (0 .. 1), as a direction and back.
  Vec3 direction(double cosine, double turns) const;
  double turns(const Vec3& towards) const;
  double cosine(const Vec3& towards) const { return up_.dot(towards); }
  double row_cosine(int row) const;  ///< of the upper edge of row 0 .. rows

 private:
  Vec3 up_, middle_, right_;
  int rows_, columns_;
  std::vector<Spectrum> radiance_;
};

/// Everything of a scene that shines and is not a surface.
struct Lights {
  std::vector<PointLight> points;
  std::vector<SpotLight> spots;
  std::vector<SphereLight> spheres;
  std::vector<Sun> suns;
  std::variant<std::monostate, Sky, EnvironmentMap> sky;

  bool has_sky() const { return !std::holds_alternative<std::monostate>(sky); }
  bool empty() const { return points.empty() && spots.empty() && spheres.empty() && suns.empty() && !has_sky(); }
  /// "'lamp'", "the sky": the first there is, for messages.
  std::string first_name() const;
};

}  // namespace interflect::scene
