#include "apps/scene_questions.h"

#include "measure/surface_measurements.h"

namespace interflect::apps {

SceneQuestions questions_about(const scene::Scene& scene) {
  SceneQuestions questions;
  for (const scene::SurfaceId id : scene.surface_ids())
    for (const scene::Side side : {scene::Side::front, scene::Side::back})
      if (scene.material(id).active(side)) {
        questions.sides.emplace_back(id, side);
        questions.on_sides.emplace_back(measure::Flux{measure::patches_of(scene, id, side)});
      }
  questions.points = measure::sensor_points(scene);
  for (const measure::SensorPoint& point : questions.points) questions.at_points.emplace_back(point.at);
  return questions;
}

std::vector<Estimate> mean_irradiances(const scene::Scene& scene, const SceneQuestions& questions,
                                       std::span<const Estimate> fluxes) {
  std::vector<Estimate> means;
  for (std::size_t k = 0; k < questions.sides.size(); ++k)
    means.push_back(scaled(fluxes[k], 1 / scene.area(questions.sides[k].first)));
  return means;
}

std::string name_of(const scene::Scene& scene, const std::pair<scene::SurfaceId, scene::Side>& side) {
  return scene.surface(side.first).name + (side.second == scene::Side::back ? "/back" : "");
}

}  // namespace interflect::apps
