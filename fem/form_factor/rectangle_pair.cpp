#include "fem/form_factor/rectangle_pair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "fem/form_factor/scaled_rings.h"

namespace interflect::fem {

namespace {

constexpr double rounding = 0.5 * std::numeric_limits<double>::epsilon();
constexpr double box_tolerance = 1e-12;

struct Interval {
  double low = 0, high = 0;
  double operator[](std::size_t k) const { return k == 0 ? low : high; }
  double length() const { return high - low; }
};
using Extents = std::array<Interval, 3>;

/// Both rectangles in the axes of the first, whose corner is the origin, in a unit of length 2^exponent m.
struct CommonBox {
  Extents a, b;
  double skew;  ///< how far a corner is from the box's
  int exponent;
};

/// The box around four corners; `skew` grows to how far inside it, along any axis, a corner lies.
Extents extents_of(const std::array<Vec3, 4>& corners, double& skew) {
  Extents box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto at = [&](std::size_t k) { return corners[k][static_cast<Index>(axis)]; };
    const auto [low, high] = std::minmax({at(0), at(1), at(2), at(3)});
    box[axis] = {low, high};
    for (std::size_t k = 0; k < 4; ++k) skew = std::max(skew, std::min(at(k) - low, high - at(k)));
  }
  return box;
}

/// The one axis along which a box has no extent; nothing where it has none, or more.
std::optional<std::size_t> flat_axis(const Extents& box) {
  std::optional<std::size_t> found;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (box[axis].length() > box_tolerance) continue;
    if (found) return std::nullopt;
    found = axis;
  }
  return found;
}

std::optional<CommonBox> common_box(std::span<const Vec3> a, std::span<const Vec3> b) {
  if (a.size() != 4 || b.size() != 4) return std::nullopt;
  CommonBox box{{}, {}, 0.0, unit_exponent(a, b)};
  const double scale = std::ldexp(1.0, -box.exponent);
  Eigen::Matrix3d axes;
  axes.row(0) = (a[1] - a[0]).normalized();
  axes.row(1) = (a[3] - a[0]).normalized();
  axes.row(2) = axes.row(0).cross(axes.row(1));
  if (!(std::abs(axes.row(0).dot(axes.row(1))) <= box_tolerance)) return std::nullopt;
  const auto in_axes = [&](std::span<const Vec3> ring) -> std::array<Vec3, 4> {
    const auto at = [&](std::size_t k) -> Vec3 { return axes * (scale * (ring[k] - a[0])); };
    return {at(0), at(1), at(2), at(3)};
  };
  box.a = extents_of(in_axes(a), box.skew);
  box.b = extents_of(in_axes(b), box.skew);
  if (!(box.skew <= box_tolerance)) return std::nullopt;
  return box;
}

/// t a atan(t / a), 0 with a.
double angle_term(double t, double a) { return a > 0.0 ? t * a * std::atan(t / a) : 0.0; }

/// Of 2 pi G.
void add_parallel(double sign, double x, double y, double z, SizedSum& sum) {
  const double x2 = x * x, y2 = y * y, z2 = z * z;
  sum.add(sign * angle_term(y, std::sqrt(x2 + z2)));
  sum.add(sign * angle_term(x, std::sqrt(y2 + z2)));
  if (z > 0.0) sum.add(-sign * 0.5 * z2 * std::log(x2 + y2 + z2));
}
void add_perpendicular(double sign, double y, double d2, SizedSum& sum) {
  const double r2 = y * y + d2;
  sum.add(sign * angle_term(y, std::sqrt(d2)));
  if (r2 > 0.0) sum.add(sign * 0.25 * (y * y - d2) * std::log(r2));
}

/// f(sign, i, k) over the ends of two intervals.
template <class F>
void over_ends(const F& f) {
  f(1.0, 0U, 0U), f(-1.0, 0U, 1U), f(-1.0, 1U, 0U), f(1.0, 1U, 1U);
}

SizedSum parallel(const Extents& a, const Extents& b) {
  SizedSum sum;
  const double z = std::abs(b[2].low);
  over_ends([&](double sign_x, std::size_t i, std::size_t k) {
    over_ends([&](double sign_y, std::size_t j, std::size_t l) {
      add_parallel(sign_x * sign_y, a[0][i] - b[0][k], a[1][j] - b[1][l], z, sum);
    });
  });
  return sum;
}

/// Distances of an interval's ends from a place that is not inside, the nearer first.
Interval distances(const Interval& of, double from) {
  const double low = std::abs(of.low - from), high = std::abs(of.high - from);
  return {std::min(low, high), std::max(low, high)};
}

/// @param across, along  a's axis across b's plane, and that along both
SizedSum perpendicular(const Extents& a, const Extents& b, std::size_t across, std::size_t along) {
  SizedSum sum;
  const Interval x = distances(a[across], b[across].low), z = distances(b[2], a[2].low);
  over_ends([&](double sign_d, std::size_t i, std::size_t k) {
    const double d2 = x[i] * x[i] + z[k] * z[k];
    over_ends([&](double sign_y, std::size_t j, std::size_t l) {
      add_perpendicular(sign_d * sign_y, a[along][j] - b[along][l], d2, sum);
    });
  });
  return sum;
}

}  // namespace

std::optional<Integral> rectangle_pair(std::span<const Vec3> a, std::span<const Vec3> b) {
  const auto box = common_box(a, b);
  if (!box) return std::nullopt;
  const auto flat = flat_axis(box->b), flat_of_a = flat_axis(box->a);
  if (!flat || flat_of_a != 2U) return std::nullopt;
  const SizedSum sum = *flat == 2 ? parallel(box->a, box->b) : perpendicular(box->a, box->b, *flat, 1 - *flat);
  const double error = rounding * sum.size + box->skew + box->a[2].length() + box->b[*flat].length();
  return in_square_metres({sum.value, error}, box->exponent);
}

}  // namespace interflect::fem
