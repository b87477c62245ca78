#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "measure/measurement.h"
#include "measure/sensor_points.h"
#include "mesh/element_mesh.h"
#include "scene/scene.h"
#include "validation/judged.h"

namespace interflect::apps {

/// What `validate` asks of both methods; judged[k] says what asked[k] is, without its estimates.
struct Questions {
  std::vector<measure::Measurement> asked;
  std::vector<validation::Judged> judged;
};

/// Every active side of every surface, the sensor points, and `elements` elements (all of them where that is not below
/// their number), chosen by strata.
Questions questions_about(const scene::Scene& scene, const mesh::ElementMesh& mesh,
                          std::span<const measure::SensorPoint> points, std::size_t elements, std::uint64_t seed);

}  // namespace interflect::apps
