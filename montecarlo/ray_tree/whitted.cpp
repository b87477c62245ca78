#include "montecarlo/ray_tree/whitted.h"

#include <array>
#include <limits>
#include <memory>
#include <vector>

#include "core/sequence/shifted_sobol.h"
#include "montecarlo/bsdf/lambert.h"
#include "montecarlo/film/filtered.h"
#include "montecarlo/measurable.h"
#include "montecarlo/path_letters.h"
#include "montecarlo/pixel_exposure.h"
#include "montecarlo/ray_tree/ray_tree.h"
#include "montecarlo/receiver_sampler.h"
#include "montecarlo/render.h"
#include "montecarlo/sampling.h"
#include "montecarlo/scene_paths.h"
#include "scene/film_map.h"

namespace interflect::montecarlo {
namespace {

constexpr std::size_t copies = sequence_batches;
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
  std::uint64_t not_finite = 0;

  /// One that is no number counts as nothing, and is counted.
  void add(const Grown& tree) {
    if (tree.found.is_finite())
      found += tree.found;
    else
      ++not_finite;
    left += tree.left;
    brightest = max(brightest, tree.brightest);
  }
};

class Trees {
 public:
  /// @param least_weight  of a ray that is followed
  Trees(const scene::Scene& scene, const raycast::RayCaster& caster, const measure::PathClasses& paths,
        double least_weight)
      : tree_(scene, caster, paths), least_weight_(least_weight) {
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

  std::uint64_t not_finite() const {
    std::uint64_t sum = 0;
    for (const Grown& copy : found_) sum += copy.not_finite;
    return sum;
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
      copy.add({scale_ * trees_.arriving(place_->at(a, b), u, v)});
    } else if (const auto ray = film_->ray(corner_ + Vec2(a, b), scene::uniform_disk(at[4], at[5]))) {
      copy.add(trees_.seen(*ray, u, v));
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

class WhittedExposure final : public PixelExposure {
 public:
  WhittedExposure(const scene::Scene& scene, const scene::Camera& camera, const RenderSettings& settings,
                  const ReconstructionFilter& filter, const raycast::RayCaster& caster, Run& run)
      : PixelExposure(copies, run),
        camera_(camera),
        map_(camera),
        filter_(filter),
        trees_(scene, caster, settings.paths, WhittedSettings{}.least_weight) {}

  Spectrum largest_score() const override { return trees_.tree().lights().largest_find(); }

 private:
  void expose(Film& film, std::size_t pixel, std::uint64_t begin, std::uint64_t end) override {
    const std::uint64_t first = begin / copies, rounds = (end - begin) / copies;
    std::array<std::vector<double>, copies> points;
    for (std::size_t copy = 0; copy < copies; ++copy) {
      points[copy].resize(dimensions * rounds);
      sequences_[copy]->points(first, dimensions, points[copy]);
    }
    for (std::uint64_t round = 0; round < rounds; ++round)
      for (const std::vector<double>& of_copy : points) add(film, pixel, &of_copy[dimensions * round]);
  }

  void add(Film& film, std::size_t pixel, const double* at) const {
    Spectrum left_out{};
    const Spectrum found = filtered(filter_, middle_of(camera_, pixel), at[0], at[1], [&](const Vec2& where, bool) {
      const auto ray = map_.ray(where, scene::uniform_disk(at[4], at[5]));
      const Grown tree = ray ? trees_.seen(*ray, at[2], at[3]) : Grown{};
      left_out += tree.left * max(tree.brightest, trees_.brightest_lamp());
      return tree.found;
    });
    film.add(pixel, found, trees_.tree().scene().weigh(found));
    film.leave_out(pixel, left_out * (1 + 2 * filter_.negative()));
  }

  const scene::Camera& camera_;
  scene::FilmMap map_;
  const ReconstructionFilter& filter_;
  Trees trees_;
  Sequences sequences_ = scrambled_sequences();
};

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
  if (quadrature.not_finite() > 0) {
    estimate.error_bound = Spectrum(std::numeric_limits<double>::infinity());
    estimate.claim = Claim::none;
  }
  return estimate;
}

}  // namespace

measure::Capabilities Whitted::capabilities() const {
  const auto direct = measure::PathClasses::of("LE");
  return {.unbiased = false,
          .consistent = false,  // least_weight and the most points of a lamp stay, whatever the target
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
  const Trees trees(scene, *caster, settings_.paths, settings_.least_weight);
  const Sequences sequences = scrambled_sequences();
  const SamplingTarget target = target_of(sampling_of(settings_), scene, trees.tree().lights().flux(), first_points);
  std::vector<Estimate> estimates(asked.size());
  std::vector<std::uint64_t> not_finite(asked.size());
  core::Progress::Stage stage(run.progress, "ray tracing", asked.size());
  run.threads.for_blocks(static_cast<Index>(asked.size()), 1, [&](Index m, Index) {
    Quadrature quadrature(trees, sequences, asked[static_cast<std::size_t>(m)]);
    estimates[static_cast<std::size_t>(m)] =
        answered(quadrature, scene, quadrature.scale() * trees.tree().lights().largest_find(), settings_, target, run);
    not_finite[static_cast<std::size_t>(m)] = quadrature.not_finite();
    stage.advance();
  });
  if (settings_.report != nullptr)
    for (const std::uint64_t of_measurement : not_finite) settings_.report->not_finite += of_measurement;
  return estimates;
}

std::unique_ptr<Exposure> whitted_exposure(const scene::Scene& scene, const scene::Camera& camera,
                                           const RenderSettings& settings, const ReconstructionFilter& filter,
                                           const raycast::RayCaster& caster, Run& run) {
  return std::make_unique<WhittedExposure>(scene, camera, settings, filter, caster, run);
}

}  // namespace interflect::montecarlo
