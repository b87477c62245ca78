#include "apps/equation_residual.h"

#include "core/error.h"
#include "core/format.h"
#include "core/log.h"

namespace interflect::apps {

std::optional<fem::ResidualNorms> equation_residual(const SolvedScene& solved, Run& run) {
  try {
    return fem::residual_norms(solved.scene, solved.solution, run);
  } catch (const core::Interrupted&) {
    core::log::shortfall("stopped before the residual was found: the solution is written without");
    return std::nullopt;
  }
}

std::string residual_text(const SolvedScene& solved, const fem::ResidualNorms& residual) {
  const auto weighed = [&](const Spectrum& norm) { return solved.scene.weigh(norm); };
  const std::string radiosity_unit = std::string(solved.scene.flux_unit()) + "/m2";
  const char* unit = radiosity_unit.c_str();
  return core::format("residual    E + rho T B_h - B_h: %.2g %s (L2), %.2g (largest)\n", weighed(residual.rms), unit,
                      weighed(residual.largest)) +
         core::format("            so that |B - B_h| <= %.2g %s (L2), %.2g (largest), estimated\n",
                      weighed(residual.rms_bound), unit, weighed(residual.largest_bound));
}

results::Record residual_record(const SolvedScene& solved, const fem::ResidualNorms& residual) {
  results::Record record;
  return record.add("claim", "estimated")
      .add("l2", solved.scene.weigh(residual.rms))
      .add("largest", solved.scene.weigh(residual.largest))
      .add("error_l2", solved.scene.weigh(residual.rms_bound))
      .add("error_largest", solved.scene.weigh(residual.largest_bound));
}

}  // namespace interflect::apps
