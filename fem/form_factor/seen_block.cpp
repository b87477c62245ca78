#include "fem/form_factor/seen_block.h"

#include <numeric>

namespace interflect::fem {

PairMoments seen_block(PairMoments unoccluded, double K_00, const SampledVisibility& V,
                       const VisibilitySampler::Workspace& rays, const PlaneBasis& of_i, const PlaneBasis& of_j,
                       const Vec3& origin) {
  PairMoments block = std::move(unoccluded);
  block.value *= V.visible;
  block.error *= V.visible;
  if (V.rays == 0 || V.visible == 0 || V.visible == 1) return block;
  const double all = std::accumulate(rays.weights.begin(), rays.weights.end(), 0.0);
  Moments where = Moments::Zero(block.value.rows(), block.value.cols());
  for (std::size_t k = 0; k < rays.segments.size(); ++k) {
    const raycast::Segment& ray = rays.segments[k];
    const double seen = rays.blocked[k] == 0 ? 1 : 0;
    where += (rays.weights[k] / all * (seen - V.visible)) * of_i.at(ray.from - origin).head(where.rows()) *
             of_j.at(ray.to - origin).head(where.cols()).transpose();
  }
  where(0, 0) = 0;  // but for rounding
  block.value += K_00 * where;
  block.error *= 1 + where.cwiseAbs().maxCoeff() / V.visible;
  return block;
}

}  // namespace interflect::fem
