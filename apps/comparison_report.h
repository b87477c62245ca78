#pragma once

#include <string>
#include <vector>

#include "apps/comparison_pictures.h"
#include "apps/integrators_compared.h"
#include "apps/options.h"
#include "measure/surface_solution.h"
#include "results/record.h"
#include "scene/scene.h"

namespace interflect::apps {

/// Whether no comparison of a pair is beyond what chance allows.
bool all_agree(const std::vector<IntegratorsCompared>& all);

/// The tables, a line each of who has no efficiency, misses the target by a bound, refuses, or has samples to be told
/// of, and the verdict on the measurements.
/// @param target  relative standard error that was asked for
/// @param z_max   the largest z that chance allows
std::string comparison_text(const scene::Scene& scene, const std::vector<IntegratorsCompared>& all, double target,
                            double z_max);

/// All values with their errors: mean irradiances [W/m² | lx] and pixels' radiances [W/(m² sr) | cd/m²].
std::string comparison_csv(const scene::Scene& scene, const std::vector<IntegratorsCompared>& all);

/// A line for each picture of a part of what was asked for, or with light that its errors do not know of, and for each
/// difference that stated errors do not explain.
std::string pictures_text(const PicturesDrawn& pictures);

/// Processor time of all threads [s], but for `elapsed`, by the clock.
struct TimesSpent {
  double solving = 0;  ///< solutions that integrators start from
  montecarlo::ComparisonTimes comparing = {};
  double pictures = 0;
  double elapsed = 0;
};
/// @param solution  that integrators start from, if any
TimesSpent times_spent(const std::vector<IntegratorsCompared>& all, const measure::SurfaceSolution& solution,
                       const PicturesDrawn& pictures);
/// A line that says what the time went to.
std::string times_text(const TimesSpent& times);

/// @param pictures  that lie beside it
results::Record comparison_record(const scene::Scene& scene, const std::vector<IntegratorsCompared>& all,
                                  const CompareOptions& options, double z_max, bool stopped,
                                  const PicturesDrawn& pictures, const TimesSpent& times);

}  // namespace interflect::apps
