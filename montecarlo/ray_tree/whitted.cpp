#include "montecarlo/ray_tree/whitted.h"

#include <array>
#include <cmath>
#include <vector>

#include "core/random.h"
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

constexpr std::size_t shifts = 16;
constexpr std::uint64_t first_points = 64 * shifts;
constexpr std::size_t most_rays = 1 << 12;  ///< of a tree: between mirrors that lose nothing it would not end

/// Point k of a copy of the sequence: film or patch, then light.  Shifts are fixed numbers, whatever the seed.
std::array<double, 4> point(std::uint64_t k, std::size_t copy) {
  constexpr double g = 1.1673039782614187;
  core::RandomNumbers shift(0, 0, copy);
  std::array<double, 4> at;
  double a = 1;
  for (double& each : at) {
    a /= g;
    const double x = shift.next() + static_cast<double>(k) * a;
    each = x - std::floor(x);
  }
  return at;
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
      : tree_(scene, caster), settings_(settings) {}

  const RayTree& tree() const { return tree_; }

  Grown seen(const scene::CameraRay& from_eye, double u, double v) const {
    Grown grown;
    std::vector<Branch> branches{{{from_eye.origin, from_eye.direction}, Spectrum(1)}};
    for (std::size_t rays = 0; !branches.empty(); ++rays) {
      const Branch branch = branches.back();
      branches.pop_back();
      if (rays == most_rays || branch.weight.max() < settings_.least_weight * branch.squeezed) {
        grown.left += branch.weight;
        continue;
      }
      const RayTree::Met met = tree_.met(branch.ray);
      Spectrum here{};
      for (const auto& each : met.shining)
        if (finds("", each.light, branch)) here += each.radiance;
      if (met.at) here += lit(*met.at, u, v, branch);
      grown.found += branch.weight * here;
      grown.brightest = max(grown.brightest, here);
      if (!met.at) continue;
      DeltaParts parts;
      met.at->bsdf->delta_parts(met.at->to_eye, Walk::from_eye, parts);
      for (const Scattered& part : parts)
        branches.push_back({met.at->ray(part.way), branch.weight * part.weight, branch.squeezed * part.squeezed,
                            branch.mirrors + (part.straight ? 0 : 1)});
    }
    return grown;
  }

  /// Irradiance of a place by light that comes straight.
  Spectrum arriving(const Receiver& at, double u, double v) const {
    const Frame frame = frame_around(at.normal);
    return pi * lit({at.position, frame, Vec3::UnitZ(), &receiver_}, u, v, {}, true);
  }

 private:
  struct Branch {
    raycast::Ray ray{};
    Spectrum weight{1};
    double squeezed = 1;
    int mirrors = 0;
  };

  /// Whether paths of that light and these letters count.
  bool finds(const std::string& scatters, std::optional<std::uint32_t> light, const Branch& branch) const {
    static constexpr char lights[] = "APF";
    const char from = light ? lights[static_cast<std::size_t>(letter_of(tree_.lights()[*light]))] : 'A';
    return settings_.paths.contains(from + scatters + std::string(static_cast<std::size_t>(branch.mirrors), 'S') + "E");
  }

  /// By all lights.
  Spectrum lit(const TreeVertex& at, double u, double v, const Branch& branch, bool receives = false) const {
    Spectrum sum{};
    if (at.bsdf->only_delta()) return sum;
    const std::string scatters = receives ? "" : at.bsdf->glossy() ? "G" : "D";
    for (std::uint32_t l = 0; l < tree_.lights().size(); ++l) {
      if (!finds(scatters, l, branch)) continue;
      const auto found = tree_.lit(at, l, u, v);
      if (found) sum += found->by_light > 0 ? found->scattered / found->by_light : found->scattered;
    }
    return sum;
  }

  RayTree tree_;
  const WhittedSettings& settings_;
  Lambert receiver_{Spectrum(1)};
};

/// A measurement by the first points of the sequence, more and more of them.
class Quadrature {
 public:
  Quadrature(const Trees& trees, const measure::Measurement& asked) : trees_(trees), scale_(scale_of(asked)) {
    if (const auto* pixel = std::get_if<measure::PixelRadiance>(&asked)) {
      film_.emplace(trees.tree().scene().camera(pixel->camera));
      corner_ = Vec2(pixel->x, pixel->y);
    } else {
      place_.emplace(asked);
    }
  }

  std::uint64_t points() const { return shifts * each_; }
  double scale() const { return scale_; }
  Spectrum mean() const {
    Spectrum sum{};
    for (const Grown& copy : copies_) sum += copy.found;
    return sum / static_cast<double>(points());
  }
  /// How far the mean of a copy is from that of all, at most, and what was not followed.
  Spectrum error() const {
    const Spectrum all = mean();
    Spectrum largest{}, left{}, brightest{};
    for (const Grown& copy : copies_) {
      const Spectrum apart = copy.found / static_cast<double>(each_) - all;
      largest = max(largest, max(apart, -1 * apart));
      left += copy.left;
      brightest = max(brightest, copy.brightest);
    }
    return largest + left * brightest / static_cast<double>(points());
  }

  void refine(std::uint64_t points) {
    for (; each_ * shifts < points; ++each_)
      for (std::size_t copy = 0; copy < shifts; ++copy) add(point(each_, copy), copies_[copy]);
  }

 private:
  void add(const std::array<double, 4>& at, Grown& copy) const {
    const auto [a, b, u, v] = at;
    if (place_) {
      copy.found += scale_ * trees_.arriving(place_->at(a, b), u, v);
    } else if (const auto ray = film_->ray(corner_ + Vec2(a, b), scene::uniform_disk(v, u))) {
      const Grown tree = trees_.seen(*ray, u, v);
      copy.found += tree.found;
      copy.left += tree.left;
      copy.brightest = max(copy.brightest, tree.brightest);
    }
  }

  const Trees& trees_;
  double scale_;
  std::optional<ReceiverSampler> place_;
  std::optional<scene::FilmMap> film_;
  Vec2 corner_ = Vec2::Zero();
  std::array<Grown, shifts> copies_{};
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
    if (quadrature.mean()[c] == 0 && error[c] == 0)
      error[c] = 3 * largest[c] / static_cast<double>(quadrature.points());
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
  const SamplingTarget target = target_of(sampling_of(settings_), scene, trees.tree().lights().flux(), first_points);
  std::vector<Estimate> estimates(asked.size());
  core::Progress::Stage stage(run.progress, "ray tracing", asked.size());
  run.threads.for_blocks(static_cast<Index>(asked.size()), 1, [&](Index m, Index) {
    Quadrature quadrature(trees, asked[static_cast<std::size_t>(m)]);
    estimates[static_cast<std::size_t>(m)] =
        answered(quadrature, scene, quadrature.scale() * trees.tree().lights().largest_find(), settings_, target, run);
    stage.advance();
  });
  return estimates;
}

}  // namespace interflect::montecarlo
