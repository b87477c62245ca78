#include "fem/neighbour_error.h"

#include <algorithm>
#include <cmath>

#include "fem/error_estimate.h"

namespace interflect::fem {
namespace {

constexpr double near = 1.5;  ///< in sums of radii between centroids
constexpr Index rows_at_once = 32;

struct Ball {
  Vec3 centre;
  double radius;
};

std::vector<Ball> balls_of(const mesh::ElementMesh& mesh) {
  std::vector<Ball> balls;
  for (const scene::SurfacePatch& patch : mesh.patches()) {
    const Vec3 centre = patch.centroid();
    double radius = 0;
    for (const Vec3& corner : patch.ring()) radius = std::max(radius, (corner - centre).norm());
    balls.push_back({centre, radius});
  }
  return balls;
}

}  // namespace

std::vector<Spectrum> neighbour_errors(const RadiositySolution& solution, const DenseSymmetric& K, const Run& run) {
  const std::vector<Ball> balls = balls_of(solution.mesh);
  std::vector<Spectrum> at_edge, errors(balls.size());
  for (std::size_t j = 0; j < balls.size(); ++j)
    at_edge.push_back(std::sqrt(3.0) * solution.reflectance[j] * irradiance_variation(solution, j));
  run.threads.for_blocks(K.size(), rows_at_once, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const auto row = static_cast<std::size_t>(i);
      for (std::size_t j = 0; j < balls.size(); ++j) {
        const double reach = near * (balls[row].radius + balls[j].radius);
        if ((balls[row].centre - balls[j].centre).squaredNorm() >= reach * reach) continue;
        errors[row] += K.entry(i, static_cast<Index>(j)) / K.gram()[row] * at_edge[j];
      }
    }
  });
  return errors;
}

}  // namespace interflect::fem
