#pragma once

#include <optional>
#include <string>
#include <variant>

#include "core/vec.h"

namespace interflect::scene {

/// Straight lines stay straight.
struct Pinhole {
  double fov_y_deg = 50;  ///< full vertical angle of view, in (0, 180)
};

/// A pinhole opened to a disk, which lies across the axis.  What is in the plane of focus, parallel to the disk, is as
/// sharp as a pinhole has it; a point at depth z is a disk on the film whose diameter is the pinhole's picture of
/// 2 radius |z - focus| / focus at z.
struct ThinLens {
  double fov_y_deg = 50;  ///< of a ray through the middle of the lens
  double radius = 0;      ///< of the disk [m], > 0
  double focus = 1;       ///< from the lens to the plane that is sharp, along the axis [m], > 0
};

/// Parallels stay parallel: what stands before the plane through the eye, across the axis.
struct Orthographic {
  double height = 1;  ///< that the picture has in the scene [m], > 0; a pixel is as wide as it is high
};

/// Longitude across, latitude upwards (equirectangular), about the axis that is upwards in the picture's middle.
struct Panoramic {
  double width_deg = 360, height_deg = 180;  ///< in (0, 360] and (0, 180]
};

/// The axis is the middle of a disk that just fits into the picture; outside of it the picture is black.
struct Fisheye {
  enum class Mapping : unsigned char {
    equidistant,  ///< r = R theta / theta_max
    equisolid     ///< r = R sin(theta / 2) / sin(theta_max / 2): equal areas are equal solid angles
  };
  Mapping mapping = Mapping::equidistant;
  double fov_deg = 180;  ///< across the disk, 2 theta_max, in (0, 360]
};

struct Projection : std::variant<Pinhole, ThinLens, Orthographic, Panoramic, Fisheye> {
  using variant::variant;
  Projection(double fov_y_deg) : variant(Pinhole{fov_y_deg}) {}  // NOLINT(google-explicit-constructor): the usual one
};

/// Half a line.
struct CameraRay {
  Vec3 origin, direction;  ///< direction: unit
};

/// A pixel's value is the mean radiance over its area on the film, whose points are (x, y) in pixels from the top left:
/// pixel (i, j) covers [i, i+1) x [j, j+1).  What film is, says the projection: the image plane of a pinhole and of a
/// thin lens (there the mean over the lens too), a plane across the axis, a map of longitude and latitude, or the disk
/// of a fisheye.
struct Camera {
  std::string name;
  Vec3 eye, target;
  Vec3 up;
  Projection projection = Pinhole{};
  int width = 800, height = 600;

  bool is_pinhole() const { return std::holds_alternative<Pinhole>(projection); }
  bool has_lens() const { return std::holds_alternative<ThinLens>(projection); }
  std::string projection_name() const;  ///< as in scene files: "thin-lens"

  /// Through a point of the film; of a thin lens through its middle.  None outside of a fisheye's disk.  For many rays,
  /// and for the way back, see FilmMap.
  std::optional<CameraRay> ray(double x, double y) const;
  /// That ray's direction.  @pre  there is one
  Vec3 direction(double x, double y) const;
};

/// @throws core::InputError  for a camera that no scene file could have: "camera 'a': a lens with a radius above 0
///                           expected"
void require_valid(const Camera& camera);

}  // namespace interflect::scene
