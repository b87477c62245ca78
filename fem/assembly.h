#pragma once

#include "fem/operator/symmetric_operator.h"

namespace interflect::fem {

/// Every pair of elements, asked of `method` in parallel: in blocks of rows and columns of the upper triangle, in rows
/// (whose two views of a pair are joined, two_views.h), or all at once, as it wants. Same entries for any number of
/// threads.  @throws core::Interrupted
PairCounts assemble(const FormFactorMethod& method, std::span<const scene::SurfacePatch> patches, ExchangeSink& sink,
                    Run& run);

/// The pairs of which at least one is an element from `first_new` on, of a method that goes from pair to pair.
/// @throws core::Interrupted
PairCounts assemble_new(const FormFactorMethod& method, std::span<const scene::SurfacePatch> patches, Index first_new,
                        ExchangeSink& sink, Run& run);

/// K of elements that each consist of four: K_IJ = sum of K_ij over the children i of I and j of J, because K is
/// additive; without errors, stored as they are.  @param fine  children 4I .. 4I + 3
std::unique_ptr<SymmetricOperator> aggregated(const SymmetricOperator& fine, Run& run);

}  // namespace interflect::fem
