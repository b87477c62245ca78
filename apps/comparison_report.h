#pragma once

#include <string>
#include <vector>

#include "apps/comparison_pictures.h"
#include "apps/integrators_compared.h"
#include "apps/options.h"
#include "results/record.h"
#include "scene/scene.h"

namespace interflect::apps {

/// Whether no comparison of a pair is beyond what chance allows.
bool all_agree(const std::vector<IntegratorsCompared>& all);

/// The tables, a line each of who has no efficiency, misses the target by a bound, refuses, or has samples to be told
/// of, and the verdict.
/// @param target  relative standard error that was asked for
/// @param z_max   the largest z that chance allows
std::string comparison_text(const scene::Scene& scene, const std::vector<IntegratorsCompared>& all, double target,
                            double z_max);

/// All values with their errors: mean irradiances [W/m² | lx] and pixels' radiances [W/(m² sr) | cd/m²].
std::string comparison_csv(const scene::Scene& scene, const std::vector<IntegratorsCompared>& all);

/// A line for each picture of a part of what was asked for.
std::string pictures_text(const PicturesDrawn& pictures);

/// @param pictures  that lie beside it
results::Record comparison_record(const scene::Scene& scene, const std::vector<IntegratorsCompared>& all,
                                  const CompareOptions& options, double z_max, bool stopped,
                                  const PicturesDrawn& pictures);

}  // namespace interflect::apps
