#pragma once

#include "fem/goal/adaptation.h"
#include "fem/goal/dual_weighted.h"
#include "fem/radiosity_operator.h"

namespace interflect::fem {

/// Elements made for a goal, with their form factors.
struct AdaptedElements {
  mesh::ElementMesh mesh;
  std::vector<int> degree;  ///< of polynomials on elements, 1 .. order
  RadiosityOperator from;
  Adaptation adaptation;
};

/// What it starts with: coarse, but not so coarse that a pass sees nothing of the room; elements as they are where
/// there is no target.
mesh::ElementMesh first_elements(const scene::Scene& scene, const RadiositySettings& settings,
                                 const AdaptiveSettings& adaptive);

/// Starts with coarse elements of linear polynomials and, pass after pass, refines those that make most of what the
/// dual-weighted residual finds, until
///
///   2 |sum_i eta_i| + 1/10 sum_i |eta_i| + what K's errors do  <=  target J
///
/// which is the stated bound: nodes miss up to half of what is rough along edges, and eta_i may cancel by chance.
///
/// Those that together make 7/10 of sum_i of the product of both norms are refined (Doerfler's marking), so that meshes
/// stay within a constant of the best ones: where the Legendre coefficients of radiosity and importance fall fast, by a
/// degree more, up to `order`; elsewhere by a cut into four.  Form factors of pairs that stay are kept.  Edges of cut
/// elements need not meet.
///
/// A run that is asked to stop keeps the last pass that was whole, from the first on.
///
/// @param settings  of an order 1 or 2; `element_size` is that of the start (0: large ones)
/// @throws core::InputError, core::Interrupted
AdaptedElements adapt_elements(const scene::Scene& scene, const RadiositySettings& settings,
                               const AdaptiveSettings& adaptive, const raycast::RayCaster& rays, Run& run);

}  // namespace interflect::fem
