#pragma once

#include <filesystem>

#include "apps/factor_request.h"
#include "fem/point_view_factors.h"
#include "raycast/ray_caster.h"

namespace interflect::apps {

/// How factors are found that no file has yet.
struct FactorWork {
  fem::MethodMaker make;
  const fem::PointViewFactors& points;
  const raycast::RayCaster& rays;
  bool talk;  ///< says what is there already
};

/// Most bytes that a run takes on the disk: the store and what is made of it.
double bytes_of(const ViewFactorOptions& options, const FactorRequest& request);

/// A store of the factors that are asked for: one that is there, or filled tile by tile, where an interrupted run
/// stopped.  Where closure is asked for, the store as it was computed is finished first, and then replaced by one that
/// is repaired, with the environment's column where the scene is open: each entry's error grows by its change.
/// @return  the store, and what the computation says (`met`: of errors before a repair)
struct KeptFactors {
  std::filesystem::path file;
  fem::ToleranceReport report;
};
KeptFactors keep_factors(const ViewFactorOptions& options, const FactorRequest& request, const FactorWork& work,
                         Run& run);

}  // namespace interflect::apps
