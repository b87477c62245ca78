#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/random.h"
#include "fem/element_point.h"
#include "raycast/ray_caster.h"
#include "scene/place.h"

namespace interflect::fem {

/// The visible part of an exchange, sampled.
struct SampledVisibility {
  double visible = 0;         ///< V in [0, 1]
  double standard_error = 0;  ///< never 0
  int rays = 0;
};

/// V and its standard error from weighted rays, at least one of them, with positive weights:
///
///   V = sum k v / sum k,   V' = (sum k v + k_mean) / (sum k + 2 k_mean),   s² = V' (1 - V') sum k² / (sum k)²
///
/// s is the binomial one with the effective number of rays and two rays added, one clear and one blocked, so that n
/// rays that agree are worth about 1/(n + 2) and not certainty [Agresti, Coull 1998].  Stratification makes the truth
/// somewhat better than s.
SampledVisibility estimated_visibility(std::span<const double> weights, std::span<const std::uint8_t> blocked);

/// Random pairings of m x m cells with m x m cells.
///
/// A few permutations are drawn once; a pair of elements takes one of them and turns it by a random shift of rows and
/// columns, so that every cell of one is joined with every cell of the other with equal probability: no bias, whatever
/// the permutations.
class CellPermutations {
 public:
  CellPermutations(int side, std::uint64_t seed);
  std::uint32_t side() const { return side_; }

  /// Rows and columns as numbers 0 .. side - 1: of the cells in order, and of their partners for a pair's random
  /// numbers. Both continue (with anything) for PointLanes::count cells beyond the last.
  struct Pairing {
    const std::uint32_t *row, *column, *partner_row, *partner_column;  ///< partners before the turn
    std::uint32_t turn_rows, turn_columns;
  };
  Pairing pairing(const core::RandomBlock& random) const;

 private:
  static constexpr std::uint32_t count = 64;
  std::uint32_t side_;
  std::vector<std::uint32_t> rows_, columns_;  ///< in order, then permutation after permutation
};

/// How many rays a pair gets: once, four or sixteen times the number set.
enum class Effort : std::uint8_t { single, fourfold, sixteenfold };

/// For a pair with this form factor (the larger of F_ij and F_ji): fourfold above 0.004, sixteenfold above 0.03.
///
/// The noise of a row is sqrt(sum_j (F_ij s_ij B_j)²): a few large entries dominate it, and rays are best given in
/// proportion to F [Neyman 1934]; four times as many halve such an entry's share.
Effort effort_for(double form_factor);

/// V_ij by rays between stratified points: with k = cos cos / r² at the k-th pair of points and v = 1 where it is
/// clear,
///
///   V = sum k v / sum k        (a ratio estimator: its expected value is K_ij / K_ij,unoccluded up to O(1/n))
///
/// Points: one in each of m x m cells of equal parameter area of i, each joined with a cell of j's by a random
/// permutation. Random numbers are keyed by (seed, i, j): the answer does not depend on who asks, when, or in which
/// block.
class VisibilitySampler {
 public:
  /// What one thread needs; reused from pair to pair: the rays of the last one.
  struct Workspace {
    std::vector<raycast::Segment> segments;
    std::vector<double> weights;
    std::vector<std::uint8_t> blocked;
  };
  static constexpr std::size_t most_rays = 1 << 18;  ///< a pair, where an error is asked for

  /// @param rays_per_pair  for Effort::single: m² is the next square, at least 4
  /// @param seed           of the run: it is made one of visibility's own here
  /// @param largest_error  standard error of V up to which a pair gets more rays, in sets that are stratified each,
  ///                       until it has `most_rays`; 0: none.  That their number depends on what the first ones found
  ///                       moves the mean of V by O(1/n).
  VisibilitySampler(std::span<const scene::SurfacePatch> patches, const raycast::RayCaster& rays, int rays_per_pair,
                    std::uint64_t seed, double largest_error = 0);

  /// @param i < j  elements
  SampledVisibility operator()(Index i, Index j, Effort effort, Workspace& workspace) const;

  /// The first rays and their weights alone, in the order in which they are cast; without pairs of points that face
  /// away.
  void generate(Index i, Index j, Effort effort, Workspace& workspace) const;

 private:
  void append(Index i, Index j, Effort effort, std::uint32_t set, Workspace& workspace) const;
  SampledVisibility look(Workspace& workspace) const;

  std::vector<ElementMap> maps_;
  std::vector<Vec3> normals_;
  const raycast::RayCaster& rays_;
  std::uint64_t seed_;
  double largest_error_;
  std::vector<CellPermutations> permutations_;  ///< by effort
};

}  // namespace interflect::fem
