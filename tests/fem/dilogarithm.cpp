#include "fem/form_factor/dilogarithm.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.h"

namespace interflect::fem {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

double difference(Complex a, Complex b) { return std::abs(a - b) / std::max(1.0, std::abs(b)); }

class RandomNumbersInThePlane {
 public:
  /// Of any argument, moduli from 1e-3 to 1e3.
  Complex next() { return std::polar(std::pow(10.0, 6 * random_.next() - 3), pi * (2 * random_.next() - 1)); }

 private:
  core::RandomNumbers random_{5, 0, 0};
};

TEST(Dilogarithm, has_its_known_values) {
  const double ln_2 = std::log(2.0), golden = std::numbers::phi, ln_golden = std::log(golden);
  EXPECT_EQ(dilogarithm(0.0), 0.0);
  EXPECT_LT(difference(dilogarithm(1.0), pi * pi / 6), 1e-15);
  EXPECT_LT(difference(dilogarithm(-1.0), -pi * pi / 12), 1e-15);
  EXPECT_LT(difference(dilogarithm(0.5), pi * pi / 12 - ln_2 * ln_2 / 2), 1e-15);
  EXPECT_LT(difference(dilogarithm(1 / golden), pi * pi / 10 - ln_golden * ln_golden), 1e-15);
  EXPECT_LT(difference(dilogarithm({0, 1}), {-pi * pi / 48, 0.91596559417721901505}), 1e-15);  // Catalan's constant
  EXPECT_LT(difference(dilogarithm(std::polar(1.0, pi / 3)), {pi * pi / 36, 1.01494160640965362502}),
            1e-15);  // Gieseking's
  EXPECT_LT(difference(dilogarithm(2.0), {pi * pi / 4, -pi * ln_2}), 1e-15);
}

TEST(Dilogarithm, is_its_power_series_near_zero) {
  core::RandomNumbers random(6, 0, 0);
  for (int k = 0; k < 200; ++k) {
    const Complex z = std::polar(0.6 * random.next(), pi * (2 * random.next() - 1));
    Complex sum = 0, power = 1;
    for (int n = 1; n < 90; ++n) sum += (power *= z) / double(n * n);
    EXPECT_LT(std::abs(dilogarithm(z) - sum), 1e-15 + 1e-15 * std::abs(z)) << z;
  }
}

// Li2(z²) = 2 Li2(z) + 2 Li2(-z): no identity that the code uses.  On the right half plane z² stays on the principal
// branch.
TEST(Dilogarithm, doubles_its_argument) {
  RandomNumbersInThePlane random;
  for (int k = 0; k < 2000; ++k) {
    Complex z = random.next();
    if (z.real() < 0) z = -z;
    EXPECT_LT(difference(2.0 * (dilogarithm(z) + dilogarithm(-z)), dilogarithm(z * z)), 1e-14) << z;
  }
}

TEST(Dilogarithm, is_conjugate_at_conjugate_arguments) {
  RandomNumbersInThePlane random;
  for (int k = 0; k < 200; ++k) {
    const Complex z = random.next();
    EXPECT_LT(difference(dilogarithm(std::conj(z)), std::conj(dilogarithm(z))), 1e-15) << z;
  }
}

TEST(Dilogarithm, imaginary_part_from_given_logarithms_is_the_same) {
  core::RandomNumbers random(7, 0, 0);
  for (int k = 0; k < 1000; ++k) {
    const Complex z = std::polar(random.next(), pi * (2 * random.next() - 1));
    EXPECT_NEAR(dilogarithm_imaginary(z, std::log(z), std::log(1.0 - z)), dilogarithm(z).imag(), 1e-15) << z;
  }
}

}  // namespace
}  // namespace interflect::fem
