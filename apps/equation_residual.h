#pragma once

#include <optional>
#include <string>

#include "apps/solved_scene.h"
#include "fem/residual.h"

namespace interflect::apps {

/// How well a solution satisfies its equation (`--residual`).  Nothing where the run was stopped, which is said.
std::optional<fem::ResidualNorms> equation_residual(const SolvedScene& solved, Run& run);

/// "residual    E + rho T B_h - B_h: 0.3 lm/m2 (L2), 2.1 (largest)", and what that bounds B's error by, in a second
/// line.
std::string residual_text(const SolvedScene& solved, const fem::ResidualNorms& residual);
results::Record residual_record(const SolvedScene& solved, const fem::ResidualNorms& residual);

}  // namespace interflect::apps
