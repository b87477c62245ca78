#include "core/batch_means.h"

#include "core/student_t.h"

namespace interflect::core {

double BatchMeans::half_width(double confidence) const {
  return student_t(confidence, batches() - 1) * standard_error();
}

}  // namespace interflect::core
