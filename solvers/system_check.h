#pragma once

#include "solvers/solver.h"

namespace interflect::solvers {

/// A reflectance of 1, of what only passes on what it receives, has an answer where others absorb.
/// @throws core::InputError         reflectance outside 0 <= rho <= 1, or 1 everywhere; an exitance that is not a
///                                  finite number, or a part of the target; an unknown whose entry of G is not a positive number: an element
///                                  without area
/// @throws core::PreconditionError  shapes of K, R and e that do not fit
void require_solvable(const System& system);

/// @throws core::InputError  where the operator has no rows, or reflectance varies inside elements: what solvers that
///                           go by rows cannot have
const RowAccess& required_rows(const System& system, const std::string& solver);
/// The same of its columns, for solvers that shoot.
const RowAccess& required_columns(const System& system, const std::string& solver);

/// @throws core::InputError  where the system has no walks, or none with its functions, or reflectance varies inside
/// elements
void require_walks(const System& system, const std::string& solver);
/// @throws core::InputError  where elements have more than one function
void require_constants(const System& system, const std::string& solver);
/// @throws core::InputError  where walks have no lines through everything
void require_lines(const System& system, const std::string& solver);
/// @throws core::InputError  where walks have no points
void require_points(const System& system, const std::string& solver);
/// @throws core::InputError  where nothing is asked for
void require_target(const System& system, const std::string& solver);

/// @throws core::InputError  fewer than 10 replications: errors are by how they differ
void require_replications(const SolverSettings& settings);

/// Makes `state` a start: x = e where it is empty, and 0 in columns without exitance, whose solution that is; and
/// so what an earlier solve has left beside x, where all are such columns.
/// @return false where every column is such a one: there is nothing to do
/// @throws core::PreconditionError  where x has another shape than e
bool prepare(const System& system, SolverState& state);

/// max over the columns of max_a |residual_a| / max_a |x_a|, what StoppingRule speaks of; 1 for a column
/// that is still all 0 but should not be, NaN where a residual is.
double relative_size(ConstColumns residual, ConstColumns x);

}  // namespace interflect::solvers
