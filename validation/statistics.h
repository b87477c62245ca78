#pragma once

#include <cstddef>

/// Distributions and levels that judgements rest on.
namespace interflect::validation {

/// Phi(x) = erfc(-x / sqrt 2) / 2, to about 1e-16 relative in both tails.
double normal_cdf(double x);

/// x with Phi(x) = p, 0 < p < 1; about 1e-15 relative (for p near 1 as far as 1 - p is known: see
/// normal_upper_quantile).
/// @throws core::PreconditionError  outside (0, 1)
double normal_quantile(double p);

/// x with 1 - Phi(x) = q: keeps its digits for tiny q.
///
/// Newton's method on log(1 - Phi), which is concave and decreasing, from the right of the root: 1 - Phi(x) <=
/// exp(-x²/2) / 2 gives the start sqrt(-2 log 2q).  For 1e-300 <= q < 1.
double normal_upper_quantile(double q);

/// Upper p-quantile of a sum of squares of independent normal numbers, from its mean and variance, as of a scaled chi
/// square with 2 mean² / variance degrees of freedom [Patnaik 1949], by the cube root of Wilson and Hilferty [1931];
/// within 3 % at p = 0.95.
double sum_of_squares_quantile(double mean, double variance, double p);

/// Level of each of M comparisons that together err with probability alpha: 1 - (1 - alpha)^(1/M) [Sidak 1967].
/// Exact for independent comparisons, safe for positively dependent ones of this two-sided normal kind.
double sidak_level(double alpha, std::size_t comparisons);

/// |z| that the largest of M independent normal numbers exceeds with probability alpha.
/// alpha = 0.01: 3.8894 (M = 100), 4.4161 (1 000), 4.8907 (10 000).
double sidak_z_max(double alpha, std::size_t comparisons);

}  // namespace interflect::validation
