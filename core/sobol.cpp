#include "core/sobol.h"

#include <bit>

#include "core/random.h"

namespace interflect::core {
namespace {

/// A primitive polynomial over GF(2), its inner coefficients as bits, and the first direction numbers m_1 .. m_degree.
struct Primitive {
  unsigned degree, coefficients;
  std::array<std::uint32_t, 5> m;
};

/// Dimensions 1 .. 7 of [Joe, Kuo 2008]; dimension 0 is van der Corput's.
constexpr std::array<Primitive, Sobol::dimensions - 1> primitives{{{1, 0, {1}},
                                                                   {2, 1, {1, 3}},
                                                                   {3, 1, {1, 3, 1}},
                                                                   {3, 2, {1, 1, 1}},
                                                                   {4, 1, {1, 1, 3, 3}},
                                                                   {4, 4, {1, 3, 5, 13}},
                                                                   {5, 2, {1, 1, 5, 5, 17}}}};

using Column = std::array<std::uint32_t, Sobol::bits>;

/// v_l = m_(l+1) 2^(31 - l), continued by v_l = v_(l-s) ^ (v_(l-s) >> s) ^ (those v_(l-k) whose coefficient is 1).
Column directions_of(const Primitive& p) {
  Column v;
  for (unsigned l = 0; l < Sobol::bits; ++l) {
    if (l < p.degree) {
      v[l] = p.m[l] << (31 - l);
      continue;
    }
    v[l] = v[l - p.degree] ^ (v[l - p.degree] >> p.degree);
    for (unsigned k = 1; k < p.degree; ++k)
      if (((p.coefficients >> (p.degree - 1 - k)) & 1u) != 0) v[l] ^= v[l - k];
  }
  return v;
}

}  // namespace

Sobol::Sobol() {
  for (unsigned l = 0; l < bits; ++l) direction_[l][0] = 1u << (31 - l);
  for (std::size_t d = 1; d < dimensions; ++d) {
    const Column v = directions_of(primitives[d - 1]);
    for (std::size_t l = 0; l < bits; ++l) direction_[l][d] = v[l];
  }
}

Sobol Sobol::scrambled(std::uint64_t seed) {
  Sobol sobol;
  for (std::uint32_t d = 0; d < dimensions; ++d) {
    // Row r of the matrix gives bit r of the product, the leading one first: any of the bits before it, and itself.
    std::array<std::uint32_t, bits> row;
    for (std::uint32_t r = 0; r < bits; ++r) {
      const std::uint32_t itself = 1u << (31 - r), before = r == 0 ? 0 : ~((itself << 1) - 1);
      row[r] = (random_block(seed, d, r, 0)[0] & before) | itself;
    }
    for (auto& of_bit : sobol.direction_) {
      std::uint32_t product = 0;
      for (std::uint32_t r = 0; r < bits; ++r)
        product |= static_cast<std::uint32_t>(std::popcount(row[r] & of_bit[d]) & 1) << (31 - r);
      of_bit[d] = product;
    }
  }
  return sobol;
}

}  // namespace interflect::core
