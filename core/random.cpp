#include "core/random.h"

#include <bit>

namespace interflect::core {

std::uint64_t derived_seed(std::uint64_t seed, std::string_view purpose) {
  std::uint64_t name = 0xCBF29CE484222325ull;  // FNV-1a
  for (char c : purpose) name = (name ^ static_cast<unsigned char>(c)) * 0x100000001B3ull;
  const RandomBlock mixed =
      philox({static_cast<std::uint32_t>(name), static_cast<std::uint32_t>(name >> 32), 0, 0}, seed);
  return (std::uint64_t{mixed[0]} << 32) | mixed[1];
}

std::uint64_t key_of(std::initializer_list<double> numbers) {
  std::uint64_t key = 0;
  for (const double number : numbers) {
    const auto bits = std::bit_cast<std::uint64_t>(number + 0.0);  // -0 + 0 is 0
    const RandomBlock mixed =
        philox({static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32), 0, 0}, key);
    key = (std::uint64_t{mixed[0]} << 32) | mixed[1];
  }
  return key;
}

}  // namespace interflect::core
