#pragma once

#include <functional>

#include "core/spectrum.h"
#include "fem/space/space.h"
#include "solvers/transport_operator.h"

namespace interflect::fem {

/// Reflectance of points, and of nothing else: it may vary inside a panel.
using ReflectanceField = std::function<Spectrum(Index panel, const Vec3& x)>;

/// R_ab = 1/A int rho N_a N_b on every panel: rho belongs inside the integral, since a product of means is not the mean
/// of the product.
/// @param points  of Gauss rules across a panel: order + 1 for a linear rho (1 .. 4 on triangles and quads)
solvers::Reflection varying_reflectance(const Space& space, const ReflectanceField& rho, int channels, int points);

}  // namespace interflect::fem
