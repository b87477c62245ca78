#pragma once

#include <cstdint>
#include <string>

#include "core/vec.h"

namespace interflect::results {

/// 32 hexadecimal digits that stand for a list of numbers: the same for the same bits in the same order, and for
/// practical purposes for no others.  It guards against mistakes, not against malice.
///
/// Two lanes of 64 bits, each word stirred into both: MurmurHash3's finaliser over a multiply-and-rotate chain.
class Digest {
 public:
  void add(std::uint64_t word);
  void add(double number);  ///< -0 is 0
  void add(const Vec3& x);
  std::string text() const;

 private:
  std::uint64_t a_ = 1, b_ = 2;
};

}  // namespace interflect::results
