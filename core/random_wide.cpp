#include "core/random_kernels.h"

namespace interflect::core {

NumbersKernel wide_numbers_kernel() { return numbers_of; }

}  // namespace interflect::core
