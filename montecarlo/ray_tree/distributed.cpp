#include "montecarlo/ray_tree/distributed.h"

#include <vector>

#include "montecarlo/bsdf/lambert.h"
#include "montecarlo/film/filtered.h"
#include "montecarlo/measurable.h"
#include "montecarlo/path_letters.h"
#include "montecarlo/pixel_exposure.h"
#include "montecarlo/prepared_measurements.h"
#include "montecarlo/ray_tree/ray_tree.h"
#include "montecarlo/render.h"
#include "montecarlo/roulette.h"
#include "montecarlo/scene_paths.h"
#include "scene/film_map.h"

namespace interflect::montecarlo {
namespace {

constexpr double always_followed = 0.1;  ///< from this weight on
/// Dimensions: place or film and lens, then a vertex after the other: light 3, glossy direction 3, survival of up to six
/// rays; of a filter's second point again.
constexpr std::uint32_t film_block = 0, lens_block = 1, first_vertex_block = 2, blocks_per_vertex = 6,
                        second_tree_block = 1u << 30;

class Trees final : public PreparedMeasurements {
 public:
  /// The tree must outlive them.
  Trees(const RayTree& tree, const measure::PathClasses& paths, std::span<const measure::Measurement> asked = {})
      : PreparedMeasurements(tree.scene(), asked, {tree.scene(), tree.lights(), paths}), tree_(tree) {}

  bool dark() const { return tree_.lights().empty(); }
  const LightSet& lights() const { return tree_.lights(); }
  std::string name() const override { return "distributed ray tracer"; }
  std::string doing() const override { return "distributed ray tracing"; }
  Spectrum largest_score() const override { return 2 * tree_.lights().largest_find(); }
  void sample(std::size_t m, std::uint64_t seed, std::uint32_t stream, std::uint64_t first,
              std::span<Spectrum> samples) const override {
    for (std::size_t k = 0; k < samples.size(); ++k) {
      core::RandomNumbers numbers(seed, stream, first + k);
      samples[k] = sample(m, numbers);
    }
  }
  /// One of the pixel with that middle.
  Spectrum of_pixel(const scene::FilmMap& film, const ReconstructionFilter& filter, const Vec2& middle,
                    core::RandomNumbers& numbers) const {
    numbers.jump(film_block);
    const double a = numbers.next(), b = numbers.next();
    numbers.jump(lens_block);
    const double r = numbers.next(), turn = numbers.next();
    return filtered(filter, middle, a, b, [&](const Vec2& at, bool second) {
      const auto ray = film.ray(at, scene::uniform_disk(r, turn));
      if (!ray) return Spectrum::zero();
      return seen({ray->origin, ray->direction}, numbers, second ? second_tree_block : first_vertex_block);
    });
  }

 private:
  struct Branch {
    raycast::Ray ray{};
    Spectrum weight{1};
    double squeezed = 1;
    RayTree::Letters letters = 0;
    Place from{Vec3::Zero(), Vec3::Zero()};  ///< where a glossy direction was drawn
    double pdf_solid_angle = 0;              ///< of that; 0: there is none but this
  };

  Spectrum sample(std::size_t m, core::RandomNumbers& numbers) const {
    if (measured(m).is_pixel()) {
      const auto ray = measured(m).ray(numbers);
      return ray ? seen(*ray, numbers, first_vertex_block) : Spectrum::zero();
    }
    const Receiver at = measured(m).receiver(numbers);
    numbers.jump(first_vertex_block);
    return scale(m) * pi *
           lit({at.position, frame_around(at.normal), Vec3::UnitZ(), &receiver_}, tree_.at_eye(), false, numbers);
  }

  Spectrum seen(const raycast::Ray& from_eye, core::RandomNumbers& numbers, std::uint32_t block) const {
    Branch root;
    root.ray = from_eye;
    root.letters = tree_.at_eye();
    Spectrum found{};
    std::vector<Branch> branches{root};
    for (; !branches.empty(); block += blocks_per_vertex) {
      const Branch branch = branches.back();
      branches.pop_back();
      const RayTree::Met met = tree_.met(branch.ray);
      for (const auto& each : met.shining) found += branch.weight * shone(branch, each);
      if (!met.at) continue;
      numbers.jump(block);
      const auto with_letter = tree_.after(branch.letters, letter_of(*met.at->bsdf));
      const bool glossy = met.at->bsdf->glossy();
      found += branch.weight * lit(*met.at, with_letter, glossy, numbers);
      go_on(branch, *met.at, glossy, with_letter, numbers, branches);
    }
    return found;
  }

  /// All delta ways, and one that a glossy surface draws.
  void go_on(const Branch& branch, const TreeVertex& at, bool glossy, RayTree::Letters with_letter,
             core::RandomNumbers& numbers, std::vector<Branch>& branches) const {
    const double lobe = numbers.next(), u = numbers.next(), v = numbers.next();
    const auto follow = [&](const Scattered& part, RayTree::Letters letters, double pdf) {
      Branch next{
          at.ray(part.way), branch.weight * part.weight, branch.squeezed * part.squeezed, letters, at.place(), pdf};
      if (part.straight) next.from = branch.from, next.pdf_solid_angle = branch.pdf_solid_angle;
      const double survives = going_on(next.weight.max() / (next.squeezed * always_followed));
      if (measure::PathClasses::hopeless(letters) || !(numbers.next() < survives)) return;
      next.weight /= survives;
      branches.push_back(next);
    };
    DeltaParts parts;
    at.bsdf->delta_parts(at.to_eye, Walk::from_eye, parts);
    for (const Scattered& part : parts)
      follow(part, part.straight ? branch.letters : tree_.after(branch.letters, measure::PathLetter::specular), 0);
    if (!glossy) return;
    const auto drawn = at.bsdf->sample(at.to_eye, {lobe, u, v}, Walk::from_eye);
    if (drawn && !drawn->delta) follow(*drawn, with_letter, drawn->pdf_solid_angle);
  }

  Spectrum shone(const Branch& branch, const RayTree::Met::Shining& by) const {
    if (!tree_.counts(branch.letters, by.light)) return Spectrum::zero();
    if (branch.pdf_solid_angle == 0 || !by.light) return by.radiance;
    const double by_light =
        tree_.lights().probability(*by.light, branch.from) *
        tree_.lights()[*by.light].pdf_arriving_solid_angle(branch.from, branch.ray.direction, by.position);
    return by.radiance * (branch.pdf_solid_angle / (branch.pdf_solid_angle + by_light));
  }

  /// By one light that is picked.
  Spectrum lit(const TreeVertex& at, RayTree::Letters letters, bool rays_find_it_too,
               core::RandomNumbers& numbers) const {
    const double pick = numbers.next(), u = numbers.next(), v = numbers.next();
    if (at.bsdf->only_delta() || dark()) return Spectrum::zero();
    const auto [light, probability] = tree_.lights().pick(at.place(), pick);
    if (!tree_.counts(letters, light)) return Spectrum::zero();
    const auto found = tree_.lit(at, light, u, v);
    if (!found) return Spectrum::zero();
    if (found->by_light == 0) return found->scattered / probability;
    return found->scattered / (probability * found->by_light + (rays_find_it_too ? found->by_bsdf : 0));
  }

  const RayTree& tree_;
  Lambert receiver_{Spectrum(1)};
};

class DistributedExposure final : public PixelExposure {
 public:
  DistributedExposure(const scene::Scene& scene, const scene::Camera& camera, const RenderSettings& settings,
                      const ReconstructionFilter& filter, const raycast::RayCaster& caster, Run& run)
      : PixelExposure(1, run),
        camera_(camera),
        map_(camera),
        filter_(filter),
        tree_(scene, caster, settings.paths),
        trees_(tree_, settings.paths),
        seed_(core::derived_seed(run.seed, "distributed ray tracer pixels")) {}

  Spectrum largest_score() const override { return trees_.largest_score(); }
  std::string may_lack(std::uint64_t samples) const override { return trees_.rare_lights().of_picture(samples); }

 private:
  void expose(Film& film, std::size_t pixel, std::uint64_t begin, std::uint64_t end) override {
    for (std::uint64_t k = begin; k < end; ++k) {
      core::RandomNumbers numbers(seed_, static_cast<std::uint32_t>(pixel), k);
      const Spectrum sample = trees_.of_pixel(map_, filter_, middle_of(camera_, pixel), numbers);
      film.add(pixel, sample, trees_.scene().weigh(sample));
    }
  }

  const scene::Camera& camera_;
  scene::FilmMap map_;
  const ReconstructionFilter& filter_;
  RayTree tree_;
  Trees trees_;
  std::uint64_t seed_;
};

}  // namespace

measure::Capabilities Distributed::capabilities() const {
  const auto direct = measure::PathClasses::of("LE");
  return {.unbiased = true,
          .consistent = true,
          .to_patches = direct,
          .to_points = direct,
          .to_pixels = measure::PathClasses::of("(A|F)(D|G)?(S|G)*E|(P|B)((D|G)(S|G)*)?E")};
}

std::vector<Estimate> Distributed::answer(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                                          Run& run) const {
  require_valid(sampling_of(settings_), "distributed ray tracer");
  for (const measure::Measurement& each : asked) require_measurable(scene, each);
  require_found(*this, scene, asked, settings_.paths);
  const auto caster = raycast::make_ray_caster(settings_.intersector, scene);
  const RayTree tree(scene, *caster, settings_.paths);
  const Trees trees(tree, settings_.paths, asked);
  if (trees.dark()) return dark_answers(asked.size());
  return sampled_answers(trees, sampling_of(settings_), trees.lights().flux(), run);
}

std::unique_ptr<Exposure> distributed_exposure(const scene::Scene& scene, const scene::Camera& camera,
                                               const RenderSettings& settings, const ReconstructionFilter& filter,
                                               const raycast::RayCaster& caster, Run& run) {
  return std::make_unique<DistributedExposure>(scene, camera, settings, filter, caster, run);
}

}  // namespace interflect::montecarlo
