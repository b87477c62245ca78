#include "results/digest.h"

#include <bit>

#include "core/format.h"

namespace interflect::results {
namespace {

std::uint64_t stir(std::uint64_t h) {
  h = (h ^ (h >> 33)) * 0xFF51AFD7ED558CCDu;
  h = (h ^ (h >> 33)) * 0xC4CEB9FE1A85EC53u;
  return h ^ (h >> 33);
}

}  // namespace

void Digest::add(std::uint64_t word) {
  a_ = stir(a_ ^ word * 0x9E3779B97F4A7C15u);
  b_ = stir(std::rotl(b_, 29) + word * 0xC2B2AE3D27D4EB4Fu + a_);
}

void Digest::add(double number) { add(std::bit_cast<std::uint64_t>(number + 0.0)); }

void Digest::add(const Vec3& x) {
  for (int axis = 0; axis < 3; ++axis) add(x[axis]);
}

std::string Digest::text() const {
  return core::format("%016llx%016llx", static_cast<unsigned long long>(a_), static_cast<unsigned long long>(b_));
}

}  // namespace interflect::results
