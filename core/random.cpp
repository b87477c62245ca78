#include "core/random.h"

namespace interflect::core {

std::uint64_t derived_seed(std::uint64_t seed, std::string_view purpose) {
  std::uint64_t name = 0xCBF29CE484222325ull;  // FNV-1a
  for (char c : purpose) name = (name ^ static_cast<unsigned char>(c)) * 0x100000001B3ull;
  const RandomBlock mixed = philox({static_cast<std::uint32_t>(name), static_cast<std::uint32_t>(name >> 32), 0, 0}, seed);
  return (std::uint64_t{mixed[0]} << 32) | mixed[1];
}

}  // namespace interflect::core
