#pragma once

#include <optional>

#include "scene/camera.h"

namespace interflect::scene {

/// A camera made ready for rays: from a point of its film and of its lens to a ray, and from a place in the scene back
/// to the film.
///
/// Film is measured in pixels, so that a pixel has the area 1 and "uniform on a pixel" is a density of 1 on it.  A ray
/// through a uniform point of a pixel and of the lens has the density p = |d film / d sigma| in direction,
///
///   pinhole, thin lens   p = 1 / (A cos³),  A = area of a pixel on the image plane at unit distance
///   panoramic            p = 1 / (dtheta dphi cos latitude)
///   fisheye              p = (R / theta_max)² theta / sin theta  |  (R / (2 sin(theta_max / 2)))²,  R of the disk [pixels]
///   orthographic         one direction; |d film / d area| = 1 / A across it instead, A in m²
///
/// and the pixel's value is int W L cos dsigma dA with the importance W = p / (A_lens cos) [1/(m² sr)]; where light
/// enters by a point A_lens is left out, and cos, of the angle with the axis, where the eye has no plane either
/// (panoramic, fisheye).  int W cos dsigma dA over a pixel is 1, over one that a fisheye's disk cuts its part within.
///
/// Source: [Veach 1997] section 8.2.1 for W; [Kolb, Mitchell, Hanrahan 1995] for thin lenses.
/// Test: tests/scene/film_map.cpp
class FilmMap {
 public:
  explicit FilmMap(const Camera& camera);  ///< keeps no reference.  @pre  require_valid(camera)

  /// The ray through a point of the film, which may lie outside of the picture.
  /// @param lens  in the unit disk; of meaning for thin lenses
  /// @return      none outside of a fisheye's disk
  std::optional<CameraRay> ray(const Vec2& film, const Vec2& lens = Vec2::Zero()) const;

  /// The film point of the ray, the inverse of `ray`; of a ray from the eye plane where orthographic, from the lens
  /// where there is one, else from the eye.  @return  none for what no film sees: behind a pinhole, beyond a disk
  std::optional<Vec2> film_of(const CameraRay& ray) const;

  /// p above [1/sr]; 0 where rays have one direction.  @pre  film_of has a point of it
  double pdf_solid_angle(const Vec3& direction) const;
  /// W above [1/(m² sr)], [1/sr] where light enters by a point; 0 where rays have one direction.
  double importance(const Vec3& direction) const;

  /// A place of the scene as light from there finds the film.
  struct Image {
    Vec2 film;
    CameraRay ray;    ///< to the place
    double distance;  ///< [m]
    double pdf_area;  ///< of the place, across the ray: p / distance², orthographic 1 / A [1/m²]
  };
  /// Light tracing: a place y that sends the radiance L towards the camera gives the pixel of `film`, per area of y,
  ///   L |cos_y| pdf_area        (y in sight of ray.origin; lens uniform on the unit disk)
  std::optional<Image> image_of(const Vec3& place, const Vec2& lens = Vec2::Zero()) const;

  bool has_lens() const { return std::holds_alternative<ThinLens>(projection_); }
  /// There are rays through some points of this rectangle of the film.
  bool in_sight(const Vec2& low, const Vec2& high) const;

 private:
  Vec3 local(const Vec3& v) const { return {v.dot(right_), v.dot(above_), v.dot(forward_)}; }
  Vec3 world(const Vec3& v) const { return v.x() * right_ + v.y() * above_ + v.z() * forward_; }
  Vec2 plane_of(const Vec2& film) const;  ///< on the image plane at unit distance, across the axis [m], or angles
  Vec2 film_on(const Vec2& plane) const;  ///< its inverse
  double pixel_area() const { return 4 * half_.x() * half_.y() / (size_.x() * size_.y()); }  ///< there

  Projection projection_;
  Vec3 eye_, right_, above_, forward_;
  Vec2 size_;                 ///< of the picture [pixels]
  Vec2 half_ = Vec2::Zero();  ///< half of the picture on that plane, or of its angles [rad]
  double radius_ = 0;         ///< of a fisheye's disk [pixels]
  double reach_ = 0;          ///< its theta_max, or 2 sin(theta_max / 2)
};

/// A point uniform on the unit disk from two numbers in [0, 1).
Vec2 uniform_disk(double u, double v);

}  // namespace interflect::scene
