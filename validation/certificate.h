#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "validation/comparison.h"
#include "validation/expected.h"
#include "validation/judged.h"
#include "validation/norms.h"

namespace interflect::validation {

struct Settings {
  double share = 0.99;  ///< of the measurements that must agree, in every reading
  double alpha = 0.01;  ///< probability that chance alone makes any z or mean of z count as significant; or any bias
  double reference_limit =
      0.02;  ///< largest 95 % error of the reference that a judgement may rest on (relative L2 of H)
};

/// Where the flux goes [W | lm], per channel: emitted = absorbed + lost, but for errors.
struct EnergyBalance {
  Spectrum emitted;
  Spectrum absorbed;                 ///< sum (1 - rho) A H over the active sides of the surfaces
  Spectrum lost;                     ///< through openings and onto black backs together
  std::optional<Spectrum> on_backs;  ///< the part of it that hit black backs, where the two are told apart
  std::optional<Spectrum> residual;  ///< emitted - absorbed - lost, where that is not 0 by definition: solver error
  Spectrum standard_error;           ///< of `absorbed`
};

/// The balance of a sampled method: its surfaces' fluxes are independent, and what is not absorbed is lost.
/// @param areas, reflectances  of the sides of surfaces in `irradiance`
EnergyBalance sampled_energy(const Spectrum& emitted, std::span<const double> areas,
                             std::span<const Spectrum> reflectances, std::span<const Estimate> irradiance);

/// All that was found in one reading.
struct Judgement {
  Reading reading;
  Comparison comparison;
  Norms elements, elements_dark;  ///< over the judged elements; `dark`: those that do not emit
  Norms surfaces, surfaces_dark;  ///< over the surfaces
  const Norms& norms() const { return elements.measurements > 0 ? elements : surfaces; }  ///< the finest that there is
  const Interval& bias() const;  ///< over all, by surfaces or by elements: whichever knows it better
};

/// Whether a solution stands up to the path-traced reference, and why.
struct Certificate {
  bool passed = false;
  std::string verdict;               ///< one sentence
  std::vector<std::string> reasons;  ///< why it did not pass; empty if it did
  std::vector<std::string> remarks;  ///< what else a reader should know
  Settings settings;
  std::string unit;                                     ///< "lx" or "W/m2"
  std::size_t surfaces = 0, elements = 0, sensors = 0;  ///< measurements of each kind
  std::size_t comparisons = 0;          ///< among which alpha is divided: every measurement and one mean, per reading
  std::vector<Judgement> judgements;    ///< the weighted value first, then the channels
  std::string worst_surface;            ///< the surface whose weighted H differs most, as a part of itself
  double worst_surface_difference = 0;  ///< (FEM - MC) / MC there
  EnergyBalance fem_energy, mc_energy;
  std::vector<ExpectedCheck> expected;
};

/// Passes when, in the weighted value and in every channel, at least `share` of the measurements agree and the mean of
/// z does not drift; when no *guaranteed* bound is broken beyond chance; when the reference is as accurate as asked;
/// and when the scene's own expectations hold.  Single differences beyond chance of *estimated* bounds are remarks, and
/// so is a bias of the whole beyond chance, whether bounds would explain it or not.
Certificate certify(const scene::Scene& scene, std::span<const Judged> judged, const EnergyBalance& fem,
                    const EnergyBalance& mc, const Settings& settings);

/// One more reason why it does not pass, of what the statistics cannot know; the verdict then says so.
void add_reason(const std::string& reason, Certificate& certificate);

}  // namespace interflect::validation
