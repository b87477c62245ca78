#include "fem/form_factor/far_field.h"

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
constexpr Fit fits[2][ElementShapes::levels] = {{{}, {0.60, 2, 0.32, 4}, {0.38, 2, 0.10, 6}, {0.55, 2, 0.010, 8}},
                                                {{}, {0.066, 3, 0.18, 5}, {0.19, 2, 0.0032, 7}, {1.6, 1, 0.00018, 8}}};

const Fit& fit_of(FarPair pair, int level) { return fits[pair == FarPair::of_triangles][level]; }

double power(double q, int exponent) {
  double product = 1;
  for (int k = 0; k < exponent; ++k) product *= q;
  return product;
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

double far_field_error(int level, FarPair pair, double q, double difference, double K) {
  const Fit& fit = fit_of(pair, level);
  return fit.scale * (power(q, fit.gain) * std::abs(difference) + fit.floor * power(q, fit.power) * K);
}

int far_field_level(FarPair pair, double q, double tolerance) {
  if (!(q < 0.7)) return ElementShapes::levels;
  for (int level = 1; level < ElementShapes::levels; ++level)
    if (const Fit& fit = fit_of(pair, level); fit.scale * fit.floor * power(q, fit.power) <= tolerance) return level;
  return ElementShapes::levels;
}

}  // namespace interflect::fem
