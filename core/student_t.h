#pragma once

namespace interflect::core {

/// t with P(|T| <= t) = confidence, of Student's distribution; to 1e-9.
double student_t(double confidence, int degrees_of_freedom);

}  // namespace interflect::core
