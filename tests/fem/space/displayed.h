#pragma once

#include <array>
#include <cmath>
#include <functional>

#include "fem/quadrature.h"
#include "mesh/smooth_mesh.h"

namespace interflect::fem::test {

using OnElements = std::function<double(std::uint32_t element, const Vec3& x)>;

/// sqrt(int (displayed - f)²): what is looked at is a field made continuous, as quadratic triangles.
inline double displayed_distance(const mesh::ElementMesh& mesh, const OnElements& field, const OnElements& f) {
  const mesh::SmoothMesh smooth = mesh::smooth_mesh(mesh);
  const auto values = mesh::smoothed<double>(smooth, field);
  double sum = 0;
  for (std::size_t k = 0; k < smooth.triangles.size(); ++k) {
    const mesh::SmoothMesh::Triangle& t = smooth.triangles[k];
    const std::array<Vec3, 3> p{smooth.points[t[0]], smooth.points[t[1]], smooth.points[t[2]]};
    const double area = 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
    for (const RuleNode& node : triangle_rule(8)) {
      const std::array<double, 3> l{1 - node.u - node.v, node.u, node.v};
      double shown = 0;
      for (std::size_t m = 0; m < 3; ++m)
        shown += l[m] * (2 * l[m] - 1) * values[t[m]] + 4 * l[m] * l[(m + 1) % 3] * values[t[3 + m]];
      const double off = shown - f(smooth.element[k], l[0] * p[0] + l[1] * p[1] + l[2] * p[2]);
      sum += node.weight * area * off * off;
    }
  }
  return std::sqrt(sum);
}

}  // namespace interflect::fem::test
