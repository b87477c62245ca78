#pragma once

#include <span>

/// Polynomials that are orthonormal in the mean on reference elements: mean of N_a N_b = delta_ab, N_0 = 1.
///
/// Functions go by their degree, so that those of an order are the first ones of the next.
namespace interflect::fem {

/// How many polynomials of degree <= `order` there are in one variable, and in two.
constexpr int segment_functions(int order) { return order + 1; }
constexpr int plane_functions(int order) { return (order + 1) * (order + 2) / 2; }

/// sqrt(2i + 1) P_i(x), i < out.size(), orthonormal on [-1, 1]: Legendre's by (i + 1) P_{i+1} = (2i + 1) x P_i - i
/// P_{i-1}.
void legendre(double x, std::span<double> out);

/// Products of those, N_i(x) N_j(y), i + j <= order, orthonormal on [-1, 1]².
/// @param out  plane_functions(order) values
void legendre_products(int order, double x, double y, std::span<double> out);

/// On the triangle (0,0) (1,0) (0,1), with a = 2u / (1 - v) - 1 and the Jacobi polynomials P^(2i+1,0),
///
///   N_ij = sqrt((2i + 1)(i + j + 1)) P_i(a) (1 - v)^i P_j^(2i+1,0)(2v - 1),   i + j <= order
///
/// P_i(a) (1 - v)^i is a polynomial in u and v, by a recurrence without the division.  Source: [Dubiner 1991].
/// @param out  plane_functions(order) values
void dubiner(int order, double u, double v, std::span<double> out);

}  // namespace interflect::fem
