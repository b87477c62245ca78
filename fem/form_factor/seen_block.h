#pragma once

#include "fem/form_factor/pair_moments.h"
#include "fem/form_factor/visibility.h"

namespace interflect::fem {

/// What rays leave of a pair's block: with points x_k and y_k, weights k_k = cos cos / r² (visibility.h), and v_k = 1
/// where they see each other,
///
///   V = sum k_k v_k / sum k_k,
///   K_ab = V K_ab,unoccluded + K_00,unoccluded sum_k k_k (v_k - V) N_a(x_k) N_b(y_k) / sum_k k_k
///
/// The first term is what a part that hides evenly leaves, without any noise beyond that of V; the second one is what
/// rays know of where it hides, and is 0 where all of them agree.  K_00 is that of constants, by the same rays.  What
/// the block as if nothing lay between errs by, K_00 too, is scaled likewise: by V + max |sum k_k (v_k - V) N_a N_b| /
/// sum k_k.
///
/// @param unoccluded  of the first functions of the bases: those of a lower degree, maybe
/// @param K_00        of constants, if nothing lay between [m²]
/// @param rays        those that V is of
/// @param origin      of the bases' coordinates
PairMoments seen_block(PairMoments unoccluded, double K_00, const SampledVisibility& V,
                       const VisibilitySampler::Workspace& rays, const PlaneBasis& of_i, const PlaneBasis& of_j,
                       const Vec3& origin);

}  // namespace interflect::fem
