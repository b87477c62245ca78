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

/// c, m, f, p of the estimate for one level.
struct Fit {
  double scale;
  int gain;
  double floor;
  int power;
};
constexpr Fit of_quads[ElementShapes::levels] = {{}, {0.53, 2, 0.32, 4}, {0.39, 2, 0.18, 6}, {0.071, 1, 1.8, 9}};
constexpr Fit of_triangles[ElementShapes::levels] = {{}, {0.041, 3, 0.32, 5}, {0.84, 3, 0.001, 7}, {6.6, 3, 0.0001, 8}};

const Fit& fit_of(const FarPair::Element& element, int level) {
  return (element.triangle ? of_triangles : of_quads)[level];
}

double power(double q, int exponent) {
  double product = 1;
  for (int k = 0; k < exponent; ++k) product *= q;
  return product;
}

double typical_error(const FarPair::Element& element, int level) {
  const Fit& fit = fit_of(element, level);
  return fit.scale * fit.floor * power(element.q, fit.power);
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
  const double per_distance = 1 / (a.centroid - b.centroid).norm();
  const double cosine =
      std::min(std::abs(a.plane.distance(b.centroid)), std::abs(b.plane.distance(a.centroid))) * per_distance;
  return {{a.radius * per_distance, a.corners == 3}, {b.radius * per_distance, b.corners == 3}, cosine};
}

double far_field_error(int level, const FarPair& pair, double difference, double K) {
  double error = 0;
  for (const FarPair::Element& element : {pair.a, pair.b}) {
    const Fit& fit = fit_of(element, level);
    error += fit.scale * power(element.q, fit.gain) * std::abs(difference);
    error += typical_error(element, level) / pair.steepness() * K;
  }
  return error;
}

int far_field_level(const FarPair& pair, double tolerance) {
  if (!(pair.q() < 0.7)) return ElementShapes::levels;
  const double most = tolerance * pair.steepness();
  for (int level = 1; level < ElementShapes::levels; ++level)
    if (typical_error(pair.a, level) + typical_error(pair.b, level) <= most) return level;
  return ElementShapes::levels;
}

}  // namespace interflect::fem
