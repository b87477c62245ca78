#include "fem/form_factor/sampled_moments.h"

namespace interflect::fem {

SampledMoments::SampledMoments(const FormFactorContext& context)
    : SampledBlocks(context), moments_(this->context(), shapes()) {}

}  // namespace interflect::fem
