#include "fem/neighbour_error.h"

#include <algorithm>
#include <cmath>

#include "fem/element_point.h"
#include "fem/form_factor/point_to_polygon.h"

namespace interflect::fem {
namespace {

constexpr double near = 1.5;      ///< in sums of radii between centroids
constexpr double spot = 1.0 / 6;  ///< of an element: smaller ones are not resolved by its siblings' means
constexpr Index rows_at_once = 32;
const double concave_edge = 1 + std::sqrt(2.0);  ///< deviation at an edge over that of a linear field

/// What is asked of an element again and again.
struct Ball {
  Vec3 centre, normal;
  double radius;
};

std::vector<Ball> balls_of(const mesh::ElementMesh& mesh) {
  std::vector<Ball> balls;
  for (const scene::SurfacePatch& patch : mesh.patches()) {
    const Vec3 centre = patch.centroid();
    double radius = 0;
    for (const Vec3& corner : patch.ring()) radius = std::max(radius, (corner - centre).norm());
    balls.push_back({centre, patch.normal(), radius});
  }
  return balls;
}

/// What a point sees of an element.
struct Seen {
  Vec3 centroid;    ///< weighted by what its parts send there
  double fraction;  ///< of its area, as if evenly: 1/16 where one part is all that counts
};

Seen seen_of(const scene::SurfacePatch& element, const Ball& from, const Vec3& otherwise) {
  Vec3 sum = Vec3::Zero();
  double weight = 0, squares = 0;
  for (const scene::SurfacePatch& quarter : quarters_of(element))
    for (const scene::SurfacePatch& part : quarters_of(quarter)) {
      const double factor = point_to_polygon(from.centre, from.normal, part.ring());
      sum += factor * part.centroid();
      weight += factor;
      squares += factor * factor;
    }
  if (!(weight > 0)) return {otherwise, 1};
  return {sum / weight, weight * weight / (16 * squares)};
}

}  // namespace

Spectrum linear_deviation(const RadiositySolution& solution, std::size_t j, const Vec3& x) {
  const std::span<const scene::SurfacePatch> patches = solution.mesh.patches();
  const std::size_t first = j / 4 * 4;
  const Vec3 normal = patches[j].normal(), u = normal.unitOrthogonal(), v = normal.cross(u);
  std::array<Vec2, 4> offset;  // of the children's centroids from their mean, in the plane
  Vec3 mean_position = Vec3::Zero();
  Spectrum mean;
  for (std::size_t k = 0; k < 4; ++k) {
    mean_position += patches[first + k].centroid() / 4;
    mean += solution.irradiance[first + k] / 4;
  }
  Eigen::Matrix2d normal_equations = Eigen::Matrix2d::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 d = patches[first + k].centroid() - mean_position;
    offset[k] = {u.dot(d), v.dot(d)};
    normal_equations += offset[k] * offset[k].transpose();
  }
  const double determinant = normal_equations.determinant(), trace = normal_equations.trace();
  if (!(determinant > 1e-12 * trace * trace)) return Spectrum::zero();  // a needle: its children lie on a line
  const Vec3 d = x - patches[j].centroid();
  const Vec2 weights = normal_equations.inverse() * Vec2(u.dot(d), v.dot(d));
  Spectrum deviation;
  for (std::size_t k = 0; k < 4; ++k) deviation += offset[k].dot(weights) * (solution.irradiance[first + k] - mean);
  return deviation;
}

std::vector<Spectrum> neighbour_errors(const RadiositySolution& solution, const SymmetricOperator& K, const Run& run) {
  const std::vector<Ball> balls = balls_of(solution.mesh);
  std::vector<Spectrum> errors(balls.size());
  run.threads.for_blocks(K.size(), rows_at_once, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const Ball& here = balls[static_cast<std::size_t>(i)];
      Spectrum linear, unresolved;
      for (std::size_t j = 0; j < balls.size(); ++j) {
        const double reach = near * (here.radius + balls[j].radius);
        if ((here.centre - balls[j].centre).squaredNorm() >= reach * reach) continue;
        const double form_factor = K.entry(i, static_cast<Index>(j)) / K.gram()[static_cast<std::size_t>(i)];
        if (form_factor == 0 || solution.reflectance[j].is_zero()) continue;
        const Seen seen = seen_of(solution.mesh.patches()[j], here, balls[j].centre);
        linear += form_factor * (solution.reflectance[j] * linear_deviation(solution, j, seen.centroid));
        unresolved +=
            form_factor * std::max(0.0, 1 - seen.fraction / spot) * (solution.reflectance[j] * solution.irradiance[j]);
      }
      errors[static_cast<std::size_t>(i)] = concave_edge * abs(linear) + unresolved;
    }
  });
  return errors;
}

}  // namespace interflect::fem
