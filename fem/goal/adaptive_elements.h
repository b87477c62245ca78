#pragma once

#include "fem/goal/adaptation.h"
#include "fem/goal/dual_weighted.h"
#include "fem/radiosity_operator.h"

namespace interflect::fem {

/// Elements made for a goal, with their form factors.
struct AdaptedElements {
  mesh::ElementMesh mesh;
  RadiosityOperator from;
  Adaptation adaptation;
};

/// Starts with coarse elements of polynomials and, pass after pass, cuts those into four that make most of what the
/// dual-weighted residual finds, until
///
///   2 |sum_i eta_i| + 1/10 sum_i |eta_i| + what K's errors do  <=  target J
///
/// which is the stated bound: nodes miss up to half of what is rough along edges, and eta_i may cancel by chance.
///
/// Those that together make 7/10 of sum_i of the product of both norms are cut (Doerfler's marking), so that meshes stay
/// within a constant of the best ones.  Form factors of pairs that stay are kept.  Edges of cut elements need not meet.
///
/// @param settings  of an order 1 or 2; `element_size` is that of the start (0: large ones)
/// @throws core::InputError, core::Interrupted
AdaptedElements adapt_elements(const scene::Scene& scene, const RadiositySettings& settings,
                               const AdaptiveSettings& adaptive, const raycast::RayCaster& rays, Run& run);

}  // namespace interflect::fem
