#include "montecarlo/warp/spherical_rectangle.h"

#include <algorithm>
#include <cmath>

namespace interflect::montecarlo {
namespace {

using Complex = std::complex<double>;

/// e^(i g) of the angle g within the rectangle at a corner: cos g ~ xy, sin g ~ |z| r.
Complex corner_angle(double xy, double x, double y, double z) {
  const Complex g(xy, std::abs(z) * std::sqrt(x * x + y * y + z * z));
  const double length = std::sqrt(std::norm(g));
  return length > 0 ? g / length : Complex(1, 0);
}

double angle_of(const Complex& c) {
  const double angle = std::atan2(c.imag(), c.real());
  return angle < -1e-12 ? angle + 2 * pi : std::max(0., angle);
}

}  // namespace

SphericalRectangle::SphericalRectangle(const Vec3& from, const Vec3& corner, const Vec3& x, const Vec3& y, double a,
                                       double b) {
  const Vec3 d = corner - from;
  x0_ = d.dot(x), y0_ = d.dot(y), z_ = -std::abs(d.dot(x.cross(y)));
  x1_ = x0_ + a, y1_ = y0_ + b;
  const Complex g0 = corner_angle(y0_ * x1_, x1_, y0_, z_), g1 = corner_angle(-x1_ * y1_, x1_, y1_, z_),
                g2 = corner_angle(y1_ * x0_, x0_, y1_, z_), g3 = corner_angle(-x0_ * y0_, x0_, y0_, z_);
  const Complex last = g2 * g3;
  solid_angle_ = angle_of(g0 * g1 * last);
  start_ = std::conj(last);
  const double to0 = std::sqrt(z_ * z_ + y0_ * y0_), to1 = std::sqrt(z_ * z_ + y1_ * y1_);
  b0_ = to0 > 0 ? -y0_ / to0 : 0;
  b1_ = to1 > 0 ? y1_ / to1 : 0;
}

Vec2 SphericalRectangle::point(double u, double v) const {
  const Complex at = start_ * std::polar(1., u * solid_angle_);
  const double f = (at.real() * b0_ - b1_) / at.imag();
  // x / sqrt(x² + z²) = c / sqrt(...) of the line that cuts u Omega off.
  const double c = std::clamp((f > 0 ? 1 : -1) / std::sqrt(f * f + b0_ * b0_), -1., 1.);
  const double x = std::clamp(-c * z_ / std::sqrt(std::max(0x1p-1000, (1 - c) * (1 + c))), x0_, x1_);
  const double d2 = x * x + z_ * z_;
  const double h0 = y0_ / std::sqrt(d2 + y0_ * y0_), h1 = y1_ / std::sqrt(d2 + y1_ * y1_), h = h0 + v * (h1 - h0);
  const double y = (1 - h) * (1 + h) > 0 ? h * std::sqrt(d2 / ((1 - h) * (1 + h))) : y1_;
  return {x - x0_, std::clamp(y, y0_, y1_) - y0_};
}

Complex SphericalRectangle::left_of(double x) const {
  const Complex g0 = corner_angle(y0_ * x, x, y0_, z_), g1 = corner_angle(-x * y1_, x, y1_, z_);
  return g0 * g1 * std::conj(start_);
}

Vec2 SphericalRectangle::inverse(const Vec2& point) const {
  const double x = x0_ + point.x(), y = y0_ + point.y(), d2 = x * x + z_ * z_;
  const double h0 = y0_ / std::sqrt(d2 + y0_ * y0_), h1 = y1_ / std::sqrt(d2 + y1_ * y1_),
               h = y / std::sqrt(d2 + y * y);
  return {std::clamp(angle_of(left_of(x)) / solid_angle_, 0., 1.), std::clamp((h - h0) / (h1 - h0), 0., 1.)};
}

}  // namespace interflect::montecarlo
