#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fem/radiosity.h"
#include "measure/measurement.h"
#include "scene/scene.h"
#include "validation/judged.h"

namespace interflect::apps {

/// What `validate` asks of both methods; judged[k] says what asked[k] is, without its estimates.
struct Questions {
  std::vector<measure::Measurement> asked;
  std::vector<validation::Judged> judged;
};

/// Every active side of every surface, every sensor point, and `elements` elements (all of them where that is not below their
/// number), chosen by strata.
Questions questions_about(const scene::Scene& scene, const fem::RadiositySolution& solution, std::size_t elements, std::uint64_t seed);

}  // namespace interflect::apps
