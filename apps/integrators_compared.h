#pragma once

#include <string>
#include <vector>

#include "montecarlo/integrator_comparison.h"
#include "validation/agreement.h"

namespace interflect::apps {

/// What several integrators are asked, of one kind.
struct ComparedKind {
  std::string name;
  std::vector<std::string> names;  ///< one a measurement
  std::vector<measure::Measurement> asked;
};

/// What they answered, and how that agrees.
struct IntegratorsCompared {
  ComparedKind kind;
  montecarlo::IntegratorComparison comparison;
  std::vector<validation::Agreement> agreements;  ///< by pair
  std::vector<validation::MeanAgreement> means;   ///< by pair
};

}  // namespace interflect::apps
