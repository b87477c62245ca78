#pragma once

#include <complex>

namespace interflect::fem {

/// The dilogarithm Li2(z) = - int_0^z ln(1 - t) / t dt, on the principal branch: cut along real z > 1, where the value
/// is that from below (Im Li2 = -pi ln z) for +0 and -0 imaginary parts alike.
///
///   Li2(z) = sum_{n>=0} B_n u^{n+1} / (n+1)!,   u = -ln(1 - z),   |u| < 2 pi
///
/// Identities that bring every z to |z| <= 1, Re z <= 1/2, where |u| <= pi/3 and ten even Bernoulli numbers do:
///   Li2(z) + Li2(1 - z) = pi²/6 - ln z ln(1 - z),   Li2(z) + Li2(1/z) = -pi²/6 - ln²(-z) / 2
/// Accuracy: 1e-15 max(1, |Li2(z)|), everywhere.
/// Source: [Lewin 1981] for the identities, ['t Hooft, Veltman 1979] for the series.  Test: tests/fem/dilogarithm.cpp
std::complex<double> dilogarithm(std::complex<double> z);

/// Im Li2(z) for |z| <= 1 where both logarithms are known without cancellation already: what closed forms in a hot loop
/// call.
/// @param z, log_z, log_1_minus_z  z, ln z and ln(1 - z), principal
double dilogarithm_imaginary(std::complex<double> z, std::complex<double> log_z, std::complex<double> log_1_minus_z);

}  // namespace interflect::fem
