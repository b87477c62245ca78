#include "fem/goal/goal.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "fem/point_of_view.h"
#include "fem/point_view_factors.h"
#include "fem/space/plane_basis.h"
#include "scene/film_map.h"

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
    const auto points = static_cast<Index>(goal.points.size());
    constexpr Index together = 16;  // points whose rows are added by one thread: not all are to be in memory
    const Eigen::VectorXd none_of_them = Eigen::VectorXd::Zero(unknowns);
    Eigen::Map<Eigen::VectorXd>(weights.direct.data(), unknowns) =
        core::reduce_in_blocks(run_.threads, points, together, none_of_them, [&](Index begin, Index end) {
          Eigen::VectorXd F(unknowns), sum = none_of_them;
          std::vector<double> rounding(mesh_.patches().size());
          for (Index s = begin; s < end; ++s) {
            run_.throw_if_stopped("goal");
            factors(goal.points[static_cast<std::size_t>(s)], {F.data(), weights.direct.size()}, rounding);
            sum += F / static_cast<double>(points);
          }
          return sum;
        });
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
    require_point_of_view(camera);
    const scene::FilmMap film(camera);
    const auto functions = static_cast<std::size_t>(plane_functions(order_));
    const double each = inv_pi / (static_cast<double>(camera.width) * camera.height);
    std::vector<std::optional<PlaneBasis>> bases(mesh_.patches().size());  // of elements in view
    for (int y = 0; y < camera.height; ++y) {
      run_.throw_if_stopped("goal");
      for (int x = 0; x < camera.width; ++x) {
        const auto ray = film.ray({x + 0.5, y + 0.5});
        const auto hit = ray ? rays_.closest({ray->origin, ray->direction}) : std::nullopt;
        const auto found = hit ? mesh_.locate(*hit) : std::nullopt;
        if (!found) continue;
        const scene::SurfacePatch& patch = mesh_.patch(found->element);
        std::optional<PlaneBasis>& basis = bases[found->element.value];
        if (!basis) basis.emplace(order_, patch.ring(), patch.normal());
        const PlaneBasis::Values N = basis->at(hit->position);
        for (std::size_t a = 0; a < functions; ++a)
          weights.direct[found->element.value * functions + a] += each * N[static_cast<Index>(a)];
      }
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
