#include "scene/film_map.h"

#include <algorithm>
#include <cmath>

#include "core/overloaded.h"

namespace interflect::scene {
namespace {

constexpr double radians(double degrees) { return degrees * (pi / 180); }

/// From the axis, in [0, pi], and exact near both ends.
double angle_from_axis(const Vec3& local) { return std::atan2(std::hypot(local.x(), local.y()), local.z()); }

double over_sine(double theta) { return theta < 1e-8 ? 1 : theta / std::sin(theta); }

}  // namespace

FilmMap::FilmMap(const Camera& camera)
    : projection_(camera.projection), eye_(camera.eye), size_(camera.width, camera.height) {
  forward_ = (camera.target - camera.eye).normalized();
  right_ = forward_.cross(camera.up).normalized();
  above_ = right_.cross(forward_);
  const double aspect = size_.x() / size_.y();
  const auto perspective = [&](double fov_y_deg) {
    const double half_height = std::tan(fov_y_deg * (pi / 360));
    half_ = {half_height * camera.width / camera.height, half_height};
  };
  std::visit(core::Overloaded{[&](const Pinhole& p) { perspective(p.fov_y_deg); },
                              [&](const ThinLens& l) { perspective(l.fov_y_deg); },
                              [&](const Orthographic& o) {
                                half_ = {o.height / 2 * aspect, o.height / 2};
                              },
                              [&](const Panoramic& p) {
                                half_ = {radians(p.width_deg / 2), radians(p.height_deg / 2)};
                              },
                              [&](const Fisheye& f) {
                                radius_ = size_.minCoeff() / 2;
                                const double half = radians(f.fov_deg / 2);
                                reach_ = f.mapping == Fisheye::Mapping::equidistant ? half : 2 * std::sin(half / 2);
                              }},
             projection_);
}

Vec2 FilmMap::plane_of(const Vec2& film) const {
  return {(2 * film.x() / size_.x() - 1) * half_.x(), (1 - 2 * film.y() / size_.y()) * half_.y()};
}

Vec2 FilmMap::film_on(const Vec2& plane) const {
  return {(1 + plane.x() / half_.x()) * size_.x() / 2, (1 - plane.y() / half_.y()) * size_.y() / 2};
}

std::optional<CameraRay> FilmMap::ray(const Vec2& film, const Vec2& lens) const {
  using Ray = std::optional<CameraRay>;
  return std::visit(
      core::Overloaded{
          [&](const Pinhole&) -> Ray {
            const Vec2 at = plane_of(film);
            return CameraRay{eye_, (forward_ + at.x() * right_ + at.y() * above_).normalized()};
          },
          [&](const ThinLens& l) -> Ray {
            const Vec2 from = l.radius * lens, to = l.focus * plane_of(film) - from;
            return CameraRay{eye_ + world({from.x(), from.y(), 0}), world({to.x(), to.y(), l.focus}).normalized()};
          },
          [&](const Orthographic&) -> Ray {
            const Vec2 at = plane_of(film);
            return CameraRay{eye_ + world({at.x(), at.y(), 0}), forward_};
          },
          [&](const Panoramic&) -> Ray {
            const Vec2 at = plane_of(film);  // longitude, latitude
            return CameraRay{eye_, world({std::cos(at.y()) * std::sin(at.x()), std::sin(at.y()),
                                          std::cos(at.y()) * std::cos(at.x())})
                                       .normalized()};
          },
          [&](const Fisheye& f) -> Ray {
            const Vec2 at((film.x() - size_.x() / 2) / radius_, (size_.y() / 2 - film.y()) / radius_);
            const double r = at.norm();
            if (!(r <= 1)) return {};
            const double theta =
                f.mapping == Fisheye::Mapping::equidistant ? r * reach_ : 2 * std::asin(r * reach_ / 2);
            const Vec2 aside = r > 0 ? Vec2(std::sin(theta) / r * at) : Vec2(Vec2::Zero());
            return CameraRay{eye_, world({aside.x(), aside.y(), std::cos(theta)}).normalized()};
          }},
      projection_);
}

std::optional<Vec2> FilmMap::film_of(const CameraRay& ray) const {
  using Film = std::optional<Vec2>;
  const Vec3 d = local(ray.direction);
  return std::visit(
      core::Overloaded{[&](const Pinhole&) -> Film {
                         if (!(d.z() > 0)) return {};
                         return film_on({d.x() / d.z(), d.y() / d.z()});
                       },
                       [&](const ThinLens& l) -> Film {
                         if (!(d.z() > 0)) return {};
                         const Vec3 from = local(ray.origin - eye_);
                         return film_on({from.x() / l.focus + d.x() / d.z(), from.y() / l.focus + d.y() / d.z()});
                       },
                       [&](const Orthographic&) -> Film {
                         const Vec3 from = local(ray.origin - eye_);
                         return film_on({from.x(), from.y()});
                       },
                       [&](const Panoramic&) -> Film {
                         return film_on({std::atan2(d.x(), d.z()), std::atan2(d.y(), std::hypot(d.x(), d.z()))});
                       },
                       [&](const Fisheye& f) -> Film {
                         const double theta = angle_from_axis(d), aside = std::hypot(d.x(), d.y());
                         const bool equidistant = f.mapping == Fisheye::Mapping::equidistant;
                         const double r = (equidistant ? theta : 2 * std::sin(theta / 2)) / reach_;
                         if (!(r <= 1)) return {};
                         const Vec2 to = aside > 0 ? Vec2(d.x() / aside, d.y() / aside) : Vec2(Vec2::Zero());
                         return Vec2(size_.x() / 2 + radius_ * r * to.x(), size_.y() / 2 - radius_ * r * to.y());
                       }},
      projection_);
}

double FilmMap::pdf_solid_angle(const Vec3& direction) const {
  const Vec3 d = local(direction);
  const double pixel = pixel_area();
  return std::visit(core::Overloaded{[&](const Pinhole&) { return 1 / (pixel * d.z() * d.z() * d.z()); },
                                     [&](const ThinLens&) { return 1 / (pixel * d.z() * d.z() * d.z()); },
                                     [](const Orthographic&) { return 0.0; },
                                     [&](const Panoramic&) { return 1 / (pixel * std::hypot(d.x(), d.z())); },
                                     [&](const Fisheye& f) {
                                       const double scale = radius_ * radius_ / (reach_ * reach_);
                                       const bool equal_areas = f.mapping == Fisheye::Mapping::equisolid;
                                       return equal_areas ? scale : scale * over_sine(angle_from_axis(d));
                                     }},
                    projection_);
}

double FilmMap::importance(const Vec3& direction) const {
  const double p = pdf_solid_angle(direction);
  const auto* lens = std::get_if<ThinLens>(&projection_);
  const bool flat = lens != nullptr || std::holds_alternative<Pinhole>(projection_);
  return p / ((lens ? pi * lens->radius * lens->radius : 1) * (flat ? direction.dot(forward_) : 1));
}

std::optional<FilmMap::Image> FilmMap::image_of(const Vec3& place, const Vec2& lens) const {
  const Vec3 from_eye = local(place - eye_);
  Vec3 origin = eye_;
  const bool parallel = std::holds_alternative<Orthographic>(projection_);
  if (parallel) origin += world({from_eye.x(), from_eye.y(), 0});
  if (const auto* l = std::get_if<ThinLens>(&projection_)) {
    const Vec2 from = l->radius * lens;
    origin += world({from.x(), from.y(), 0});
  }
  const Vec3 way = place - origin;
  const double distance = way.norm();
  if (!(distance > 0) || (parallel && !(from_eye.z() > 0))) return {};
  const CameraRay ray{origin, parallel ? forward_ : Vec3(way / distance)};
  const std::optional<Vec2> film = film_of(ray);
  if (!film) return {};
  return Image{*film, ray, distance,
               parallel ? 1 / pixel_area() : pdf_solid_angle(ray.direction) / (distance * distance)};
}

bool FilmMap::in_sight(const Vec2& low, const Vec2& high) const {
  if (!std::holds_alternative<Fisheye>(projection_)) return true;
  const Vec2 middle = size_ / 2, nearest = middle.cwiseMax(low).cwiseMin(high);
  return (nearest - middle).norm() < radius_;
}

Vec2 uniform_disk(double u, double v) {
  const double r = std::sqrt(u), phi = 2 * pi * v;
  return {r * std::cos(phi), r * std::sin(phi)};
}

}  // namespace interflect::scene
