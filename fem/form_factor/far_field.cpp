#include "fem/form_factor/far_field.h"

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

constexpr double envelope[ElementShapes::levels] = {2.2, 1.1, 0.46, 0.15};

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

double far_field_error(int level, double q, double slope) {
  double power = q;
  for (int k = 0; k < level; ++k) power *= q * q;
  return envelope[level] * power * (q + slope);
}

int far_field_level(double q, double slope, double tolerance) {
  int level = 0;
  while (level < ElementShapes::levels && !(far_field_error(level, q, slope) <= tolerance)) ++level;
  return level;
}

}  // namespace interflect::fem
