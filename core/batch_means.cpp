#include "core/batch_means.h"

#include "core/error.h"
#include "core/student_t.h"

namespace interflect::core {

ScalarMoments BatchMeans::over_batches() const {
  ScalarMoments means;
  for (const ScalarMoments& each : of_) {
    if (each.count() != of_.front().count() || each.count() == 0)
      throw PreconditionError("batch means: batches of one size expected");
    means.add(each.mean());
  }
  return means;
}

double BatchMeans::half_width(double confidence) const {
  return student_t(confidence, batches() - 1) * standard_error();
}

}  // namespace interflect::core
