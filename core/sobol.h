#pragma once

#include <array>
#include <cstdint>

/// Sobol's points: evenly spread over the unit cube, a net for every power of two.
namespace interflect::core {

/// A Sobol sequence in up to eight dimensions, 32 bits a coordinate.
///
///   x_k = XOR over the bits l of k that are 1 of v_l        (bit by bit; v_l: the direction numbers of the dimension)
///
/// The first 2^m points, and every 2^m after them, have one coordinate in each interval of length 2^-m, and for
/// dimensions 0 and 1 one point in each elementary rectangle of area 2^-m: a (0, 2)-sequence in base 2.
///
/// `scrambled` multiplies each dimension's generating matrix from the left by a random lower triangular one (a random
/// linear scramble: the same nets, since it maps leading bits onto leading bits).  With a random digital shift, a
/// uniform word XORed to each coordinate, every single point is uniform, so that means are unbiased, and their variance
/// is that of Owen's nested scrambling, O(n^-3 log^(d-1) n) for smooth integrands.  The shift is the caller's, since it
/// is what makes one set of points serve many.
///
/// Sources: [Sobol 1967]; direction numbers of [Joe, Kuo 2008] (new-joe-kuo-6); linear scrambles [Matousek 1998], their
/// variance [Hickernell, Yue 2000].  Test: tests/core/sobol.cpp.
class Sobol {
 public:
  static constexpr int dimensions = 8, bits = 32;
  template <std::size_t d>
  using Words = std::array<std::uint32_t, d>;

  Sobol();  ///< the sequence itself, whose point 0 is the origin
  static Sobol scrambled(std::uint64_t seed);

  /// The first d coordinates of point k, as fractions of 2^32.
  template <std::size_t d>
  Words<d> point(std::uint32_t k) const {
    static_assert(d <= dimensions);
    Words<d> x{};
    for (std::size_t l = 0; k != 0; k >>= 1, ++l)
      if ((k & 1u) != 0)
        for (std::size_t i = 0; i < d; ++i) x[i] ^= direction_[l][i];
    return x;
  }

 private:
  std::array<std::array<std::uint32_t, dimensions>, bits> direction_;  ///< by bit, then by dimension
};

/// A word as a number inside (0, 1), in the middle of its 2^-32.
constexpr double inside_unit(std::uint32_t word) { return (word + 0.5) * 0x1p-32; }

}  // namespace interflect::core
