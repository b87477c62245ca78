#include "core/build_info.h"

#include <cstring>

#include "core/spectrum.h"
#include "core/version.h"

namespace interflect::core {

BuildInfo build_info() { return {INTERFLECT_VERSION, INTERFLECT_BUILD, Spectrum::capacity}; }

std::string unsupported_processor() {
#if defined(__x86_64__)
  if (std::strcmp(INTERFLECT_ARCH, "x86-64-v3") == 0 &&
      !(__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")))
    return "this build needs a processor with AVX2 and FMA; configure with -DINTERFLECT_ARCH= for an older one";
#endif
  return {};
}

}  // namespace interflect::core
