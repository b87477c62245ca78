#include "scene/light.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace interflect::scene {

double Sun::squared_sine() const {
  const double sine = std::sin(angular_radius);
  return sine * sine;
}

double Sun::one_minus_cosine() const {
  const double half = std::sin(angular_radius / 2);
  return 2 * half * half;
}

Spectrum Sun::radiance() const { return irradiance / (pi * squared_sine()); }

bool Sun::shines_from(const Vec3& towards) const {
  if (towards.dot(direction) > 0) return false;
  return (towards + direction).squaredNorm() <= 2 * one_minus_cosine();  // |a - b|² = 2 (1 - cos)
}

EnvironmentMap::EnvironmentMap(const Vec3& up, const Vec3& middle, int rows, int columns,
                               std::vector<Spectrum> radiance)
    : up_(up),
      middle_(middle),
      right_(middle.cross(up)),
      rows_(rows),
      columns_(columns),
      radiance_(std::move(radiance)) {
  if (rows < 1 || columns < 1 || radiance_.size() != static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns))
    throw core::PreconditionError("an environment map has rows * columns texels");
}

double EnvironmentMap::row_cosine(int row) const {
  // Exact where it matters, and symmetric about the horizon.
  if (row == 0) return 1;
  if (row == rows_) return -1;
  if (2 * row == rows_) return 0;
  return std::cos(pi * row / rows_);
}

double EnvironmentMap::solid_angle(int row) const {
  // cos a - cos b = 2 sin((a + b) / 2) sin((b - a) / 2): no cancellation at the poles.
  return 2 * std::sin(pi * (row + .5) / rows_) * std::sin(pi / (2. * rows_)) * 2 * pi / columns_;
}

double EnvironmentMap::turns(const Vec3& towards) const {
  const double turns = std::atan2(right_.dot(towards), middle_.dot(towards)) / (2 * pi) + .5;
  return turns < 1 ? turns : 0;
}

EnvironmentMap::Texel EnvironmentMap::at(const Vec3& towards) const {
  const double theta = std::acos(std::clamp(cosine(towards), -1., 1.));
  return {std::min(rows_ - 1, static_cast<int>(theta / pi * rows_)),
          std::min(columns_ - 1, static_cast<int>(turns(towards) * columns_))};
}

Vec3 EnvironmentMap::direction(double cosine, double turns) const {
  const double azimuth = 2 * pi * (turns - .5), sine = std::sqrt(std::max(0., (1 - cosine) * (1 + cosine)));
  return (sine * std::cos(azimuth) * middle_ + sine * std::sin(azimuth) * right_ + cosine * up_).normalized();
}

std::string Lights::first_name() const {
  const auto name_of = [](const auto& list) { return "'" + list.front().name + "'"; };
  if (!points.empty()) return name_of(points);
  if (!spots.empty()) return name_of(spots);
  if (!spheres.empty()) return name_of(spheres);
  if (!suns.empty()) return name_of(suns);
  return "the sky";
}

}  // namespace interflect::scene
