#include "solvers/tile_kernels.h"

namespace interflect::solvers {

TileKernels tile_kernels() { return all_kernels(); }

}  // namespace interflect::solvers
