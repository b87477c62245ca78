#pragma once

#include "core/vec.h"

namespace interflect::montecarlo {

/// All that a film has seen, a row a pixel: what is restored from it goes on to the same bits.
using FilmState = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace interflect::montecarlo
