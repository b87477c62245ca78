#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fem/form_factor/method.h"

namespace interflect::fem {

/// A method at one setting of its own: what it took, and what it got wrong.
struct MethodScore {
  std::string method, setting;  ///< "hemicube", "resolution 128"
  double seconds = 0;
  double largest_row_error = 0;  ///< max_i sum_j |F_ij - exact|
  double mean_row_error = 0;     ///< area mean of sum_j |F_ij - exact|
  double stated_row_error = 0;   ///< max_i of what the method said of it: bounds + 1.96 standard errors
  double energy_error = 0;       ///< max_i |sum_j F_ij - exact|: flux lost or made
  PairCounts pairs;
};

/// Every method of the catalogue at settings from coarse to fine, against `analytic` with rows to
/// `reference_tolerance`, which comes last, with the errors that it states of itself.
/// @param scored  called with each score when it is there
/// @throws core::Interrupted
std::vector<MethodScore> compare_methods(const FormFactorContext& context, double reference_tolerance, Run& run,
                                         const std::function<void(const MethodScore&)>& scored);

}  // namespace interflect::fem
