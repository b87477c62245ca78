#include "core/student_t.h"

#include <cmath>

#include "core/error.h"
#include "core/vec.h"

namespace interflect::core {

/// P(|T| <= t) by n degrees of freedom is a finite sum in the angle a = atan(t / sqrt(n)) [Abramowitz, Stegun 1964,
/// 26.7.3-4].
static double probability_within(double t, int n) {
  const double a = std::atan(t / std::sqrt(static_cast<double>(n))), c = std::cos(a), s = std::sin(a);
  double term = n % 2 == 0 ? 1 : c, sum = n == 1 ? 0 : term;
  for (int k = n % 2 == 0 ? 2 : 3; k <= n - 2; k += 2) {
    term *= c * c * (k - 1) / k;
    sum += term;
  }
  return n % 2 == 0 ? s * sum : (a + s * sum) * 2 / pi;
}

double student_t(double confidence, int degrees_of_freedom) {
  if (!(confidence > 0 && confidence < 1) || degrees_of_freedom < 1)
    throw PreconditionError("student_t: 0 < confidence < 1 and a degree of freedom expected");
  double low = 0, high = 1;
  while (probability_within(high, degrees_of_freedom) < confidence) high *= 2;
  while (high - low > 1e-10 * high) {
    const double middle = 0.5 * (low + high);
    (probability_within(middle, degrees_of_freedom) < confidence ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace interflect::core
