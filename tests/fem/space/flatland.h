#pragma once

#include <Eigen/LU>

#include "fem/galerkin.h"
#include "fem/space/space.h"
#include "tests/fem/rooms.h"

/// Flatland by Galerkin's method, solved directly, and what arrives at points there.
namespace interflect::fem::test {

/// Coefficients of B = E + rho H, with one reflectance for all.
inline Eigen::VectorXd solved_in_flatland(const Space& space, double rho, const Space::Field& exitance,
                                          int points_a_side) {
  LastEntrySink sink(space.gram().size());
  core::LocalRun run(1, 2);
  galerkin(space, FlatlandKernel(), SegmentPairRule(points_a_side), sink, run.get());
  const Eigen::Map<const Eigen::VectorXd> G(space.gram().data(), sink.K.rows());
  const Eigen::MatrixXd A =
      Eigen::MatrixXd::Identity(sink.K.rows(), sink.K.rows()) - rho * (G.cwiseInverse().asDiagonal() * sink.K).eval();
  return A.partialPivLu().solve(space.project(exitance, space.order() + 1));
}

struct Segment {
  Vec3 from, to;
  Vec3 at(double u) const { return from + u * (to - from); }
};

/// int k(x, y) B(y) dy of a segment that nothing hides, at a point in front of it.
///
/// Far away by Gauss's rule; near by the same in w, where s = d sinh w is the way along the segment from the foot of x
/// at the distance d: k = cos cos / (2 r) has no pole within pi / 2 of the real w.
/// @param B  smooth, of u along the segment, 0 .. 1
template <class Radiosity>
double sent(const Vec3& x, const Vec3& normal, const Segment& part, const Radiosity& B) {
  static const Rule few = gauss_legendre(8), many = gauss_legendre(16);
  const FlatlandKernel kernel;
  const Panel panel = segment_panel(part.from, part.to);
  const double length = panel.measure;
  double sum = 0;
  if ((part.at(.5) - x).norm() > 3 * length) {
    for (const RuleNode& node : few)
      sum += node.weight * length * kernel(x, normal, part.at(node.u), panel.normal) * B(node.u);
    return sum;
  }
  const Vec3 along = (part.to - part.from) / length;
  const double d = panel.normal.dot(x - part.from), first = along.dot(part.from - x);
  if (d <= 1e-14 * length) return 0;
  const double from = std::asinh(first / d), to = std::asinh((first + length) / d);
  const int pieces = static_cast<int>(std::ceil((to - from) / 2));
  for (int k = 0; k < pieces; ++k)
    for (const RuleNode& node : many) {
      const double w = from + (to - from) * (k + node.u) / pieces, u = (d * std::sinh(w) - first) / length;
      sum += node.weight * (to - from) / pieces * d * std::cosh(w) * kernel(x, normal, part.at(u), panel.normal) * B(u);
    }
  return sum;
}

}  // namespace interflect::fem::test
