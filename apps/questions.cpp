#include "apps/questions.h"

#include "core/format.h"
#include "validation/element_choice.h"

namespace interflect::apps {
namespace {

using validation::Judged;

struct SideOf {
  std::string name;
  bool emitting;
};

SideOf side_of(const scene::Scene& scene, const mesh::ElementMesh::Part& part) {
  return {scene.side_name(part.surface, part.side), !scene.material(part.surface).exitance_of(part.side).is_zero()};
}

void ask_surfaces(const scene::Scene& scene, const mesh::ElementMesh& mesh, Questions& questions) {
  for (const mesh::ElementMesh::Part& part : mesh.parts()) {
    const auto patches = mesh.patches().subspan(part.first, part.count);
    const auto [name, emitting] = side_of(scene, part);
    double area = 0;
    for (const scene::SurfacePatch& patch : patches) area += patch.area;
    questions.asked.emplace_back(measure::Flux{{patches.begin(), patches.end()}});
    questions.judged.push_back({.name = name,
                                .kind = Judged::Kind::surface,
                                .area = area,
                                .emitting = emitting,
                                .fem = {},
                                .mc = {},
                                .group = name});
  }
}

void ask_elements(const scene::Scene& scene, const mesh::ElementMesh& mesh, std::size_t count, std::uint64_t seed,
                  Questions& questions) {
  std::vector<double> areas;
  std::vector<std::uint32_t> part_of;
  for (std::uint32_t p = 0; p < mesh.parts().size(); ++p) part_of.resize(part_of.size() + mesh.parts()[p].count, p);
  for (const scene::SurfacePatch& patch : mesh.patches()) areas.push_back(patch.area);
  for (const validation::ChosenElement& chosen : validation::choose_elements(areas, part_of, count, seed)) {
    const auto [name, emitting] = side_of(scene, mesh.parts()[part_of[static_cast<std::size_t>(chosen.element)]]);
    questions.asked.emplace_back(measure::PatchIrradiance{mesh.patches()[static_cast<std::size_t>(chosen.element)]});
    questions.judged.push_back(
        {.name = core::format("%s, element %lld", name.c_str(), static_cast<long long>(chosen.element)),
         .kind = Judged::Kind::element,
         .element = chosen.element,
         .area = areas[static_cast<std::size_t>(chosen.element)],
         .emitting = emitting,
         .fem = {},
         .mc = {},
         .group = name,
         .weight = chosen.represented_area});
  }
}

void ask_sensors(std::span<const measure::SensorPoint> points, Questions& questions) {
  for (const measure::SensorPoint& point : points) {
    questions.asked.emplace_back(point.at);
    questions.judged.push_back({.name = core::format("%s[%d]", point.sensor.c_str(), point.index),
                                .kind = Judged::Kind::sensor,
                                .fem = {},
                                .mc = {},
                                .group = point.sensor});
  }
}

}  // namespace

Questions questions_about(const scene::Scene& scene, const mesh::ElementMesh& mesh,
                          std::span<const measure::SensorPoint> points, std::size_t elements, std::uint64_t seed) {
  Questions questions;
  ask_surfaces(scene, mesh, questions);
  ask_elements(scene, mesh, elements, seed, questions);
  ask_sensors(points, questions);
  return questions;
}

}  // namespace interflect::apps
