#pragma once

#include "apps/options.h"
#include "core/run.h"

namespace interflect::apps {

/// What a command ended with: the program's exit status.  Bad input throws core::InputError, which is 2.
enum ExitStatus : int {
  success = 0,
  not_met = 1,  ///< it ran, and the answer is no: not validated, findings, not converged, stopped early
  bad_input = 2
};

/// What a command is told that only lists what there is: nothing.
struct ListOptions {};

ExitStatus solve(const SolveOptions& options, const CommonOptions& common, Run& run);
ExitStatus validate(const ValidateOptions& options, const CommonOptions& common, Run& run);
ExitStatus render(const RenderOptions& options, const CommonOptions& common, Run& run);
ExitStatus trace(const TraceOptions& options, const CommonOptions& common, Run& run);
ExitStatus compare(const CompareOptions& options, const CommonOptions& common, Run& run);
ExitStatus view_factors(const ViewFactorOptions& options, const CommonOptions& common, Run& run);
ExitStatus compare_form_factors(const CompareFormFactorsOptions& options, const CommonOptions& common, Run& run);
ExitStatus solvers(const SolversOptions& options, const CommonOptions& common, Run& run);
ExitStatus integrators(const ListOptions& options, const CommonOptions& common, Run& run);
ExitStatus compare_solvers(const CompareSolversOptions& options, const CommonOptions& common, Run& run);
ExitStatus shoot(const ShootOptions& options, const CommonOptions& common, Run& run);
ExitStatus dim(const DimOptions& options, const CommonOptions& common, Run& run);
ExitStatus exchange(const ExchangeOptions& options, const CommonOptions& common, Run& run);
ExitStatus info(const InfoOptions& options, const CommonOptions& common, Run& run);
ExitStatus check(const CheckOptions& options, const CommonOptions& common, Run& run);

}  // namespace interflect::apps
