#include "montecarlo/two_pass/two_pass.h"

#include <cmath>
#include <map>
#include <memory>
#include <vector>

#include "core/error.h"
#include "core/random.h"
#include "montecarlo/path_tracer.h"
#include "montecarlo/prepared_measurements.h"
#include "montecarlo/scene_paths.h"
#include "montecarlo/two_pass/two_pass_estimator.h"

namespace interflect::montecarlo {
namespace {

constexpr std::uint32_t path_block = 2;

/// Where a sample of a measurement asks the solution.
TwoPassEstimator::Walked walked_by(const MeasurementSampler& measured, const TwoPassEstimator& from,
                                   core::RandomNumbers& numbers) {
  if (measured.is_pixel()) {
    const auto ray = measured.ray(numbers);
    return ray ? from.radiance(*ray, numbers, path_block) : TwoPassEstimator::Walked{};
  }
  TwoPassEstimator::Walked walked = from.irradiance(measured.receiver(numbers), numbers, path_block);
  for (auto* asked : {&walked.reflected, &walked.mirrored})
    if (*asked) (*asked)->weight *= measured.scale();
  return walked;
}

class TwoPassed final : public PreparedMeasurements {
 public:
  TwoPassed(const TwoPassEstimator& at_places, const TwoPassEstimator& at_pixels,
            const measure::SurfaceSolution& solution, std::span<const measure::Measurement> asked)
      : PreparedMeasurements(at_places.paths().scene(), asked,
                             at_places.paths().rare_lights()),  // pixels lack such where places do
        at_places_(at_places),
        at_pixels_(at_pixels),
        solution_(solution) {}
  std::string name() const override { return "two-pass"; }
  std::string doing() const override { return "second pass"; }
  Spectrum largest_score() const override { return at_places_.paths().largest_score(); }
  void sample(std::size_t m, std::uint64_t seed, std::uint32_t stream, std::uint64_t first,
              std::span<Spectrum> samples) const override {
    measured(m).sample(of(m).paths(), {seed, stream, first}, samples);
    const std::uint64_t of_solution = core::derived_seed(seed, "solution");
    for (std::size_t k = 0; k < samples.size(); ++k)
      samples[k] += answered_to(m, {of_solution, stream, first + k}).value;
  }
  Answered answered_to(std::size_t m, core::RandomNumbers numbers) const {
    return answered(solution_, walked_by(measured(m), of(m), numbers));
  }

 private:
  const TwoPassEstimator& of(std::size_t m) const { return measured(m).is_pixel() ? at_pixels_ : at_places_; }

  const TwoPassEstimator &at_places_, &at_pixels_;
  const measure::SurfaceSolution& solution_;
};

/// The solution's part in an answer's errors, by walks of their own.
struct Inherited {
  Spectrum bound, noise;
};

/// With the mean weight w_j of cell j:
///
///   noise = sum_j w_j shared_j + (2 sum_j (w_j own_j)²)^1/2,
///
/// since two elements that see each other have one random number, and later bounces see it once more.  Walks see the
/// second part too large, by what a single one brings: by own² / walks.
Inherited inherited(const TwoPassed& measurements, std::size_t m, std::uint64_t seed) {
  constexpr std::uint64_t walks = 512;
  core::Moments bound;
  Spectrum shared;
  std::map<std::uint32_t, Spectrum> own;
  for (std::uint64_t w = 0; w < walks; ++w) {
    const Answered answer = measurements.answered_to(m, {seed, static_cast<std::uint32_t>(m), w});
    bound.add(answer.bound);
    shared += answer.shared_noise / static_cast<double>(walks);
    own[answer.cell] += answer.own_noise / static_cast<double>(walks);
  }
  Spectrum squares;
  for (const auto& [cell, noise] : own) squares += noise * noise;
  return {bound.mean() + normal_95 * bound.standard_error(), shared + sqrt(2 * squares)};
}

/// The solution's own errors become the answers'.
void add_errors(const TwoPassed& measurements, std::span<Estimate> found, Run& run) {
  const std::uint64_t seed = core::derived_seed(run.seed, "errors of the solution");
  run.threads.for_blocks(static_cast<Index>(found.size()), 4, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) {
      const auto m = static_cast<std::size_t>(k);
      const Inherited errors = inherited(measurements, m, seed);
      Estimate& each = found[m];
      each.standard_error = sqrt(each.standard_error * each.standard_error + errors.noise * errors.noise);
      each.weighed_standard_error = std::hypot(each.weighed_standard_error, measurements.scene().weigh(errors.noise));
      each.error_bound += errors.bound;
      if (each.claim != Claim::none) each.claim = Claim::estimated;
    }
  });
}

}  // namespace

void require_known_to_two_passes(const scene::Scene& scene, const measure::PathClasses& paths) {
  if (!scene.lights.empty())
    throw core::InputError(scene.lights.first_name(),
                           "two passes know lights that are surfaces; --integrator path does this");
  if (!(paths == measure::PathClasses::all()))
    throw core::InputError("two-pass", "its solution has all paths that are diffuse: --paths 'L.*E' expected");
  for (const scene::SurfaceId id : scene.surface_ids())
    if (const scene::Material& material = scene.material(id);
        material.opacity < 1 || std::holds_alternative<scene::Plastic>(material.finish))
      throw core::InputError("'" + scene.surface(id).name + "'",
                             "its material '" + material.name + "' is " + material.kind() +
                                 ": two passes do not know it; --integrator path does");
}

void require_two_passes(const scene::Scene& scene, const measure::SurfaceSolution& solution,
                        const measure::PathClasses& paths) {
  require_known_to_two_passes(scene, paths);
  if (!solution.known())
    throw core::InputError(solution.why_none.empty() ? "two-pass: it needs a radiosity solution" : solution.why_none);
}

measure::Capabilities TwoPass::capabilities() const {
  const auto finds = measure::PathClasses::of("A.*E");
  return {.unbiased = false,
          .consistent = false,  // the solution's error stays, whatever the target
          .to_patches = finds,
          .to_points = finds,
          .to_pixels = finds};
}

std::vector<Estimate> TwoPass::answer(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                                      Run& run) const {
  require_valid(sampling_of(settings_), "two-pass");
  require_two_passes(scene, settings_.solution, settings_.paths);
  require_found(*this, scene, asked, settings_.paths);
  const auto caster = raycast::make_ray_caster(settings_.intersector, scene);
  const TwoPassEstimator at_places(scene, *caster, 0), at_pixels(scene, *caster, 1);
  const TwoPassed measurements(at_places, at_pixels, settings_.solution, asked);
  if (at_places.paths().lights().empty()) return dark_answers(asked.size());
  std::vector<Estimate> found =
      sampled_answers(measurements, sampling_of(settings_), at_places.paths().lights().flux(), run);
  add_errors(measurements, found, run);
  return found;
}

}  // namespace interflect::montecarlo
