#include "fem/goal/goal.h"

#include <algorithm>

#include "core/error.h"
#include "fem/point_view_factors.h"
#include "fem/space/plane_basis.h"

namespace interflect::fem {
namespace {

class Weigher {
 public:
  Weigher(const scene::Scene& scene, const mesh::ElementMesh& mesh, const raycast::RayCaster& rays, int order, Run& run)
      : scene_(scene), mesh_(mesh), rays_(rays), order_(order), run_(run) {}

  GoalWeights operator()(const Goal::AtPoints& goal) const {
    GoalWeights weights = none();
    const PointViewFactors factors(scene_, mesh_.patches(), order_);
    const auto unknowns = static_cast<Index>(weights.direct.size());
    std::vector<Eigen::VectorXd> rows(goal.points.size());
    run_.threads.for_blocks(static_cast<Index>(goal.points.size()), 1, [&](Index s, Index) {
      run_.throw_if_stopped("goal");
      Eigen::VectorXd& F = rows[static_cast<std::size_t>(s)];
      F.resize(unknowns);
      std::vector<double> rounding(mesh_.patches().size());
      factors(goal.points[static_cast<std::size_t>(s)], {F.data(), weights.direct.size()}, rounding);
    });
    Eigen::Map<Eigen::VectorXd> sum(weights.direct.data(), unknowns);
    for (const Eigen::VectorXd& row : rows) sum += row / static_cast<double>(rows.size());
    return weights;
  }

  GoalWeights operator()(const Goal::OnSurface& goal) const {
    GoalWeights weights = none();
    weights.arriving.assign(mesh_.patches().size(), 0.0);
    double area = 0;
    for (const scene::SurfacePatch& patch : mesh_.patches())
      if (patch.surface == goal.surface && patch.side == goal.side) area += patch.area;
    for (std::size_t i = 0; i < weights.arriving.size(); ++i) {
      const scene::SurfacePatch& patch = mesh_.patches()[i];
      if (patch.surface == goal.surface && patch.side == goal.side) weights.arriving[i] = 1 / area;
    }
    return weights;
  }

  GoalWeights operator()(const Goal::InView& goal) const {
    GoalWeights weights = none();
    const scene::Camera& camera = scene_.camera(goal.camera);
    const auto functions = static_cast<std::size_t>(plane_functions(order_));
    const double each = inv_pi / (static_cast<double>(camera.width) * camera.height);
    for (int y = 0; y < camera.height; ++y)
      for (int x = 0; x < camera.width; ++x) {
        const auto hit = rays_.closest({camera.eye, camera.direction(x + 0.5, y + 0.5)});
        const auto found = hit ? mesh_.locate(*hit) : std::nullopt;
        if (!found) continue;
        const scene::SurfacePatch& patch = mesh_.patch(found->element);
        const PlaneBasis::Values N = PlaneBasis(order_, patch.ring(), patch.normal()).at(hit->position);
        for (std::size_t a = 0; a < functions; ++a)
          weights.direct[found->element.value * functions + a] += each * N[static_cast<Index>(a)];
      }
    return weights;
  }

 private:
  GoalWeights none() const {
    const std::size_t unknowns = mesh_.patches().size() * static_cast<std::size_t>(plane_functions(order_));
    return {order_, std::vector<double>(unknowns, 0.0), {}};
  }

  const scene::Scene& scene_;
  const mesh::ElementMesh& mesh_;
  const raycast::RayCaster& rays_;
  int order_;
  Run& run_;
};

bool all_zero(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return v == 0; });
}

}  // namespace

GoalWeights weights_of(const Goal& goal, const scene::Scene& scene, const mesh::ElementMesh& mesh,
                       const raycast::RayCaster& rays, int order, Run& run) {
  GoalWeights weights = std::visit(Weigher(scene, mesh, rays, order, run), goal.what);
  if (all_zero(weights.direct) && all_zero(weights.arriving))
    throw core::InputError("goal '" + goal.name + "'", "no surface that could reflect light to it");
  return weights;
}

}  // namespace interflect::fem
