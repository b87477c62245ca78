#include "fem/form_factor/far_field.h"

#include <algorithm>
#include <cmath>

namespace interflect::fem {

namespace {

/// One row of the product: sum_a w_a h_a / |x_a - y_b|^4 for a fixed number of y_b, so that the compiler vectorises it.
template <int columns>
double product_rule(const NodeArrays& a, const double* height_a, const NodeArrays& b, const double* height_b) {
  double sum[columns] = {};
  for (int i = 0; i < a.count; ++i) {
    const double x = a.x[i], y = a.y[i], z = a.z[i], numerator = height_a[i];
    for (int j = 0; j < columns; ++j) {
      const double dx = b.x[j] - x, dy = b.y[j] - y, dz = b.z[j] - z;
      const double square = dx * dx + dy * dy + dz * dz;
      sum[j] += numerator / (square * square);
    }
  }
  double total = 0.0;
  for (int j = 0; j < columns; ++j) total += sum[j] * height_b[j];
  return total;
}

/// Weight times height over the other's plane.
void weigh(const NodeArrays& nodes, const geometry::Plane& other, double* out) {
  const double nx = other.normal.x(), ny = other.normal.y(), nz = other.normal.z(), offset = other.offset;
  for (int k = 0; k < nodes.padded; ++k)
    out[k] = nodes.weight[k] * (nx * nodes.x[k] + ny * nodes.y[k] + nz * nodes.z[k] - offset);
}

/// What was fitted: by how much errors are larger than their leading terms, mostly.
constexpr double quad_factor = 1.5, triangle_factor[ElementShapes::levels] = {2.1, 2.5, 3.8, 13};

/// g_n of Gauss rules of n = level + 1 nodes.
constexpr double of_gauss[ElementShapes::levels] = {1.0 / 3, 4.0 / 45, 4.0 / 175, 64.0 / 11025};

/// C_m(1) of the Gegenbauer polynomial of index 2.
constexpr double at_end(int m) { return (m + 3) * (m + 2) * (m + 1) / 6.0; }

/// Of C_m(cos phi) = sum_j (j + 1) (m - j + 1) cos((m - 2j) phi) what swings k times a turn, over C_m(1).
constexpr double share(int m, int k) { return (k == 0 ? 1 : 2) * ((m - k) / 2 + 1) * ((m + k) / 2 + 1) / at_end(m); }

/// Of a rule of degree m - 1 on the equilateral triangle of circumradius 1: its errors on r^m cos k phi and on the same
/// of degree m + 1, times their share of C_m; k = 0 or 3, and `steep` 6 or 9, which only a line near the plane has.
struct TriangleRule {
  int m;
  double lower, lower_steep, upper, upper_steep;
};
constexpr TriangleRule of_triangles[ElementShapes::levels] = {
    {2, 0.25 * share(2, 0), 0, 0.1 * share(3, 3), 0},
    {5, 6.103e-3 * share(5, 3), 0, 2.780e-3 * share(6, 0), 1.329e-2 * share(6, 6)},
    {7, 2.864e-4 * share(7, 3), 0, 8.036e-4 * share(8, 0), 1.504e-3 * share(8, 6)},
    {9, 1.446e-4 * share(9, 3), 1.787e-3 * share(9, 9), 3.716e-4 * share(10, 0), 2.100e-5 * share(10, 6)}};

constexpr double least_cosine = 1e-300;

template <int exponent>
double power(double q) {
  double product = 1;
  for (int k = 0; k < exponent; ++k) product *= q;
  return product;
}

/// Of |C_m|: m + 2 over 2 sin² where it swings, C_m(1) at its end.
double envelope(int m, double sine2) { return (m + 2) / (2 * sine2 + (m + 2) / at_end(m)); }

/// Of the axes first .. end, by Gauss rules of n nodes.
template <int n>
double error_of_quads(const FarPair& pair, std::size_t first, std::size_t end) {
  double error = 0;
  for (std::size_t k = first; k < end; ++k)
    error += power<2 * n>(pair.reach[k]) * envelope(2 * n, pair.sine2[k]) * pair.slope[k];
  return quad_factor * of_gauss[n - 1] * error;
}

template <int level>
double error_of_triangle(const FarPair& pair, std::size_t first) {
  constexpr TriangleRule rule = of_triangles[level];
  double error = 0;
  for (std::size_t k = first; k < first + 3; ++k) {
    const double steep = power<rule.m / 2>(1 - pair.sine2[k]), lower = rule.lower + steep * rule.lower_steep,
                 upper = rule.upper + steep * rule.upper_steep;
    error += power<rule.m>(pair.reach[k]) * (lower + upper * pair.reach[k]) * envelope(rule.m + 1, pair.sine2[k]) *
             pair.slope[k];
  }
  return triangle_factor[level] * error;
}

template <int level>
double error_of(const FarPair& pair) {
  if (!pair.triangles[0] && !pair.triangles[1]) return error_of_quads<level + 1>(pair, 0, pair.count);
  return (pair.triangles[0] ? error_of_triangle<level>(pair, 0) : error_of_quads<level + 1>(pair, 0, pair.of_first)) +
         (pair.triangles[1] ? error_of_triangle<level>(pair, pair.of_first)
                            : error_of_quads<level + 1>(pair, pair.of_first, pair.count));
}

/// @param d         unit vector from its centroid to the other's
/// @param cosine    H of the pair's axes: 0 or less is rounding, and what is steep there has no far field
/// @param distance  of the centroids, as it counts [m]
void append_axes(const ElementShape& of, const ElementShape& other, const Vec3& d, double cosine, double distance,
                 FarPair& pair) {
  const double per_cosine = 1 / std::max(cosine, least_cosine), per_distance = 1 / distance,
               share = (of.corners == 3 ? 1.0 : 2.0) / static_cast<double>(of.axis_count);
  for (std::size_t k = 0; k < of.axis_count; ++k, ++pair.count) {
    const HalfAxis& axis = of.axis[k];
    const double along = axis.direction.dot(d), slope = std::abs(axis.direction.dot(other.plane.normal));
    pair.reach[pair.count] = axis.length * per_distance;
    pair.sine2[pair.count] = 1 - along * along;
    pair.slope[pair.count] = share * (1 + slope * per_cosine) * (1 + axis.widening * distance);
  }
}

}  // namespace

double far_field(const NodeArrays& a, const geometry::Plane& plane_a, const NodeArrays& b,
                 const geometry::Plane& plane_b) {
  double height_a[16], height_b[16];
  weigh(a, plane_b, height_a);
  weigh(b, plane_a, height_b);
  switch (b.padded) {
    case 4:
      return inv_pi * product_rule<4>(a, height_a, b, height_b);
    case 8:
      return inv_pi * product_rule<8>(a, height_a, b, height_b);
    case 12:
      return inv_pi * product_rule<12>(a, height_a, b, height_b);
    default:
      return inv_pi * product_rule<16>(a, height_a, b, height_b);
  }
}

FarPair far_pair(const ElementShape& a, const ElementShape& b) {
  const Vec3 line = b.centroid - a.centroid;
  const double distance = line.norm(), q = (a.radius + b.radius) / distance, nearer = distance * (1 - 0.3 * q * q);
  const Vec3 d = line / distance;
  FarPair pair;
  pair.q = q;
  pair.count = 0;
  append_axes(a, b, d, b.plane.distance(a.centroid) / distance, nearer, pair);
  pair.of_first = pair.count;
  append_axes(b, a, d, a.plane.distance(b.centroid) / distance, nearer, pair);
  pair.triangles[0] = a.corners == 3;
  pair.triangles[1] = b.corners == 3;
  return pair;
}

double far_field_error(int level, const FarPair& pair) {
  switch (level) {
    case 0:
      return error_of<0>(pair);
    case 1:
      return error_of<1>(pair);
    case 2:
      return error_of<2>(pair);
    default:
      return error_of<3>(pair);
  }
}

std::optional<FarRule> far_rule(const FarPair& pair, double tolerance) {
  if (!(pair.q < 0.7)) return std::nullopt;
  for (int level = 0; level < ElementShapes::levels; ++level)
    if (const double error = far_field_error(level, pair); error <= tolerance) return FarRule{level, error};
  return std::nullopt;
}

}  // namespace interflect::fem
