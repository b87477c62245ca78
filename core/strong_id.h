#pragma once

#include <compare>
#include <cstdint>

namespace interflect {

/// A position in one kind of list, which the compiler tells from positions in others.
template <class Tag>
struct StrongId {
  std::uint32_t value = 0;
  friend constexpr auto operator<=>(const StrongId&, const StrongId&) = default;
};

}  // namespace interflect
