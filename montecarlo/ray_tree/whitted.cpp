#include "montecarlo/ray_tree/whitted.h"

#include <array>
#include <memory>
#include <vector>

#include "core/sequence/shifted_sobol.h"
#include "montecarlo/bsdf/lambert.h"
#include "montecarlo/measurable.h"
#include "montecarlo/path_letters.h"
#include "montecarlo/ray_tree/ray_tree.h"
#include "montecarlo/receiver_sampler.h"
#include "montecarlo/sampling.h"
#include "montecarlo/scene_paths.h"
#include "scene/film_map.h"

namespace interflect::montecarlo {
namespace {

constexpr std::size_t copies = 16;
constexpr std::uint64_t first_points = 64 * copies;
constexpr std::size_t most_rays = 1 << 12;  ///< of a tree: between mirrors that lose nothing it would not end

/// Scrambled by fixed numbers, whatever the seed.  Dimensions: film or patch, lights, lens, two each: what is drawn on
/// the lens must not tell what is drawn on the lights.
using Sequences = std::array<std::unique_ptr<core::SampleSequence>, copies>;
constexpr std::size_t dimensions = 6;

Sequences scrambled_sequences() {
  const core::ShiftedSobol sobol(0);
  Sequences all;
  for (std::size_t copy = 0; copy < copies; ++copy) all[copy] = sobol.replicate(copy);
  return all;
}

/// What a tree has found, and what it left out.
struct Grown {
  Spectrum found{};
  Spectrum left{};       ///< weights of rays that were not followed
  Spectrum brightest{};  ///< that any of its rays saw
};

class Trees {
 public:
  Trees(const scene::Scene& scene, const raycast::RayCaster& caster, const WhittedSettings& settings)
      : tree_(scene, caster, settings.paths), least_weight_(settings.least_weight) {
    for (std::uint32_t l = 0; l < tree_.lights().first_infinite(); ++l)
      if (!tree_.lights()[l].is_delta())
        brightest_lamp_ = max(brightest_lamp_, inv_pi * tree_.lights()[l].largest_find(0).pi_radiance);
  }

  const RayTree& tree() const { return tree_; }
  /// Radiance, of all lamps that have an area and are not afar.
  const Spectrum& brightest_lamp() const { return brightest_lamp_; }

  Grown seen(const scene::CameraRay& from_eye, double u, double v) const {
    Grown grown;
    std::vector<Branch> branches{{{from_eye.origin, from_eye.direction}, Spectrum(1), 1, tree_.at_eye()}};
    for (std::size_t rays = 0; !branches.empty(); ++rays) {
      const Branch branch = branches.back();
      branches.pop_back();
      if (rays == most_rays || branch.weight.max() < least_weight_ * branch.squeezed) {
        grown.left += branch.weight;
        continue;
      }
      const RayTree::Met met = tree_.met(branch.ray);
      Spectrum here{};
      for (const auto& each : met.shining)
        if (tree_.counts(branch.letters, each.light)) here += each.radiance;
      if (met.at) here += lit(*met.at, u, v, tree_.after(branch.letters, letter_of(*met.at->bsdf)));
      grown.found += branch.weight * here;
      grown.brightest = max(grown.brightest, here);
      if (met.at) go_on(branch, *met.at, branches);
    }
    return grown;
  }

  /// Irradiance of a place by light that comes straight.
  Spectrum arriving(const Receiver& at, double u, double v) const {
    const Frame frame = frame_around(at.normal);
    return pi * lit({at.position, frame, Vec3::UnitZ(), &receiver_}, u, v, tree_.at_eye());
  }

 private:
  struct Branch {
    raycast::Ray ray{};
    Spectrum weight{1};
    double squeezed = 1;
    RayTree::Letters letters = 0;
  };

  void go_on(const Branch& branch, const TreeVertex& at, std::vector<Branch>& branches) const {
    DeltaParts parts;
    at.bsdf->delta_parts(at.to_eye, Walk::from_eye, parts);
    for (const Scattered& part : parts) {
      const auto letters = part.straight ? branch.letters : tree_.after(branch.letters, measure::PathLetter::specular);
      if (!measure::PathClasses::hopeless(letters))
        branches.push_back({at.ray(part.way), branch.weight * part.weight, branch.squeezed * part.squeezed, letters});
    }
  }

  /// By all lights.
  Spectrum lit(const TreeVertex& at, double u, double v, RayTree::Letters letters) const {
    Spectrum sum{};
    if (at.bsdf->only_delta()) return sum;
    for (std::uint32_t l = 0; l < tree_.lights().size(); ++l) {
      if (!tree_.counts(letters, l)) continue;
      const auto found = tree_.lit(at, l, u, v);
      if (found) sum += found->by_light > 0 ? found->scattered / found->by_light : found->scattered;
    }
    return sum;
  }

  RayTree tree_;
  double least_weight_;
  Spectrum brightest_lamp_{};
  Lambert receiver_{Spectrum(1)};
};

/// A measurement by the first points of each sequence, more and more of them.
class Quadrature {
 public:
  Quadrature(const Trees& trees, const Sequences& sequences, const measure::Measurement& asked)
      : trees_(trees), sequences_(sequences), scale_(scale_of(asked)) {
    if (const auto* pixel = std::get_if<measure::PixelRadiance>(&asked)) {
      film_.emplace(trees.tree().scene().camera(pixel->camera));
      corner_ = Vec2(pixel->x, pixel->y);
    } else {
      place_.emplace(asked);
    }
  }

  std::uint64_t points() const { return copies * each_; }
  double scale() const { return scale_; }
  Spectrum mean() const {
    Spectrum sum{};
    for (const Grown& copy : found_) sum += copy.found;
    return sum / static_cast<double>(points());
  }
  /// How far the mean of a copy is from that of all, at most, and what was not followed.
  Spectrum error() const {
    const Spectrum all = mean();
    Spectrum largest{}, left{}, brightest{};
    for (const Grown& copy : found_) {
      const Spectrum apart = copy.found / static_cast<double>(each_) - all;
      largest = max(largest, max(apart, -1 * apart));
      left += copy.left;
      brightest = max(brightest, copy.brightest);
    }
    return largest + left * max(brightest, trees_.brightest_lamp()) / static_cast<double>(points());
  }

  void refine(std::uint64_t points) {
    const std::uint64_t each = (points + copies - 1) / copies;
    std::vector<double> u(dimensions * (each - each_));
    for (std::size_t copy = 0; copy < copies; ++copy) {
      sequences_[copy]->points(each_, dimensions, u);
      for (std::size_t k = 0; k < u.size(); k += dimensions) add(&u[k], found_[copy]);
    }
    each_ = each;
  }

 private:
  void add(const double* at, Grown& copy) const {
    const double a = at[0], b = at[1], u = at[2], v = at[3];
    if (place_) {
      copy.found += scale_ * trees_.arriving(place_->at(a, b), u, v);
    } else if (const auto ray = film_->ray(corner_ + Vec2(a, b), scene::uniform_disk(at[4], at[5]))) {
      const Grown tree = trees_.seen(*ray, u, v);
      copy.found += tree.found;
      copy.left += tree.left;
      copy.brightest = max(copy.brightest, tree.brightest);
    }
  }

  const Trees& trees_;
  const Sequences& sequences_;
  double scale_;
  std::optional<ReceiverSampler> place_;
  std::optional<scene::FilmMap> film_;
  Vec2 corner_ = Vec2::Zero();
  std::array<Grown, copies> found_{};
  std::uint64_t each_ = 0;  ///< points of a copy
};

SamplingSettings sampling_of(const WhittedSettings& s) { return {s.samples, s.target, s.target_floor, s.max_samples}; }

Estimate answered(Quadrature& quadrature, const scene::Scene& scene, const Spectrum& largest,
                  const WhittedSettings& settings, const SamplingTarget& target, Run& run) {
  const std::uint64_t most = settings.samples > 0 ? settings.samples : settings.max_samples;
  const auto known = [&] {
    return scene.weigh(quadrature.error()) <= target.standard_error(scene.weigh(quadrature.mean()), quadrature.scale());
  };
  quadrature.refine(settings.samples > 0 ? most : std::min(most, first_points));
  while (quadrature.points() < most && !known()) {
    run.throw_if_stopped("ray tracing");
    quadrature.refine(std::min(most, 4 * quadrature.points()));
  }
  Spectrum error = quadrature.error();
  // Nothing found is not nothing there.
  for (int c = 0; c < Spectrum::capacity; ++c)
    if (quadrature.mean()[c] == 0) error[c] += 3 * largest[c] / static_cast<double>(quadrature.points());
  Estimate estimate{quadrature.mean(), Spectrum::zero(), error, Claim::estimated, quadrature.points()};
  estimate.weighed_standard_error = 0;
  return estimate;
}

}  // namespace

measure::Capabilities Whitted::capabilities() const {
  const auto direct = measure::PathClasses::of("LE");
  return {.unbiased = false,
          .consistent = true,
          .to_patches = direct,
          .to_points = direct,
          .to_pixels = measure::PathClasses::of("L(D|G)?S*E")};
}

std::vector<Estimate> Whitted::answer(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                                      Run& run) const {
  require_valid(sampling_of(settings_), "whitted");
  for (const measure::Measurement& each : asked) require_measurable(scene, each);
  require_found(*this, scene, asked, settings_.paths);
  const auto caster = raycast::make_ray_caster(settings_.intersector, scene);
  const Trees trees(scene, *caster, settings_);
  const Sequences sequences = scrambled_sequences();
  const SamplingTarget target = target_of(sampling_of(settings_), scene, trees.tree().lights().flux(), first_points);
  std::vector<Estimate> estimates(asked.size());
  core::Progress::Stage stage(run.progress, "ray tracing", asked.size());
  run.threads.for_blocks(static_cast<Index>(asked.size()), 1, [&](Index m, Index) {
    Quadrature quadrature(trees, sequences, asked[static_cast<std::size_t>(m)]);
    estimates[static_cast<std::size_t>(m)] =
        answered(quadrature, scene, quadrature.scale() * trees.tree().lights().largest_find(), settings_, target, run);
    stage.advance();
  });
  return estimates;
}

}  // namespace interflect::montecarlo
