#pragma once

#include <cstdint>
#include <span>
#include <vector>

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
/// s is the binomial one with the effective number of rays and two rays added, one clear and one blocked, so that n rays that agree
/// are worth about 1/(n + 2) and not certainty [Agresti, Coull 1998].  Stratification makes the truth somewhat better than s.
SampledVisibility estimated_visibility(std::span<const double> weights, std::span<const std::uint8_t> blocked);

/// V_ij by rays between stratified points: with k = cos cos / r² at the k-th pair of points and v = 1 where it is clear,
///
///   V = sum k v / sum k        (a ratio estimator: its expected value is K_ij / K_ij,unoccluded up to O(1/n))
///
/// Points: n = m² of them, one in each of m x m cells of equal area of i, joined with the cells of j by a random permutation.
/// Random numbers are keyed by (seed, i, j): the answer does not depend on who asks, when, or in which block.
class VisibilitySampler {
 public:
  /// What one thread needs; reused from pair to pair.
  struct Workspace {
    std::vector<raycast::Segment> segments;
    std::vector<double> weights;
    std::vector<std::uint8_t> blocked;
    std::vector<std::uint32_t> partner;
  };

  /// @param seed  of the run: it is made one of visibility's own here
  VisibilitySampler(std::span<const scene::SurfacePatch> patches, const raycast::RayCaster& rays, std::uint64_t seed);

  /// @param i < j  elements
  /// @param side   m: m² pairs of points
  SampledVisibility operator()(Index i, Index j, int side, Workspace& workspace) const;

  /// The rays and their weights alone, in the order in which they are cast; without pairs of points that face away.
  void generate(Index i, Index j, int side, Workspace& workspace) const;

 private:
  std::span<const scene::SurfacePatch> patches_;
  std::vector<Vec3> normals_;
  const raycast::RayCaster& rays_;
  std::uint64_t seed_;
};

/// m for a pair with this form factor (the larger of F_ij and F_ji): m² >= `rays` in general, 4 m² above 0.004, 16 m² above 0.03.
///
/// The noise of a row is sqrt(sum_j (F_ij s_ij B_j)²): a few large entries dominate it, and rays are best given in proportion to F
/// [Neyman 1934]; four times as many halve such an entry's share.
int rays_per_side(int rays, double form_factor);

}  // namespace interflect::fem
