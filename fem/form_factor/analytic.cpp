#include "fem/form_factor/analytic.h"

#include "fem/form_factor/exact_occlusion.h"

namespace interflect::fem {

std::unique_ptr<PairWork> Analytic::work() const {
  return std::make_unique<ExactOcclusion>(shapes(), blockers(), context().tolerance);
}

}  // namespace interflect::fem
