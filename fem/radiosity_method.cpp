#include "fem/radiosity_method.h"

#include <algorithm>
#include <cmath>

#include "core/moments.h"
#include "core/random.h"
#include "fem/error_estimate.h"
#include "fem/gather.h"
#include "geometry/clip.h"

namespace interflect::fem {

namespace {

Spectrum magnitude(const Spectrum& s) {
  return s.map([](double v) { return std::abs(v); });
}
Spectrum root(const Spectrum& s) {
  return s.map([](double v) { return std::sqrt(v); });
}

/// Area of the part of an element that lies within a convex patch of the same plane [m²].
double shared_area(const scene::SurfacePatch& element, const scene::SurfacePatch& patch) {
  const Vec3 normal = patch.normal();
  geometry::ConvexRing left;
  for (const Vec3& p : element.ring()) left.corner[static_cast<std::size_t>(left.corners++)] = p - patch.corner[0];
  for (std::size_t k = 0; k < patch.corners && left.corners > 0; ++k) {
    const Vec3 from = patch.corner[k] - patch.corner[0], to = patch.corner[(k + 1) % patch.corners] - patch.corner[0];
    const Vec3 inwards = normal.cross(to - from).normalized();
    left = geometry::clip(left.ring(), {inwards, inwards.dot(from)});
  }
  return left.corners > 0 ? geometry::vector_area(left.ring()).norm() : 0.0;
}

/// Answers one list, measurement by measurement: everything here is read only.
class Answers {
 public:
  Answers(const scene::Scene& scene, const RadiositySolution& solution, const raycast::RayCaster& rays,
          std::uint64_t seed)
      : scene_(scene), s_(solution), rays_(rays), seed_(seed), gather_(scene, solution.mesh.patches(), rays, seed) {
    for (std::size_t i = 0; i < s_.radiosity.size(); ++i) {
      importance_.push_back(std::max(0.0, scene.weigh(s_.radiosity[i])));
      halving_.push_back(s_.radiosity[i] - s_.coarse_radiosity[i]);
    }
  }

  Estimate operator()(const measure::PatchIrradiance& asked, std::uint64_t) const { return of_patch(asked.patch); }
  Estimate operator()(const measure::Flux& asked, std::uint64_t) const;
  Estimate operator()(const measure::PointIrradiance& asked, std::uint64_t key) const;
  Estimate operator()(const measure::PixelRadiance& asked, std::uint64_t key) const;

 private:
  Estimate of_element(std::size_t i) const {
    return {s_.irradiance[i], s_.irradiance_noise[i], s_.irradiance_error[i], Claim::estimated, 0};
  }
  std::optional<std::size_t> same_element(const scene::SurfacePatch& patch) const;
  Estimate of_patch(const scene::SurfacePatch& patch) const;
  Estimate of_tiles(const scene::SurfacePatch& patch) const;
  const mesh::ElementMesh::Part* whole_part(std::span<const scene::SurfacePatch> patches) const;

  const scene::Scene& scene_;
  const RadiositySolution& s_;
  const raycast::RayCaster& rays_;
  std::uint64_t seed_;
  Gather gather_;
  std::vector<double> importance_;
  std::vector<Spectrum> halving_;
};

/// The element with the patch's corners, found by its centroid.
std::optional<std::size_t> Answers::same_element(const scene::SurfacePatch& patch) const {
  const auto found = s_.mesh.locate({patch.surface, patch.side, 0, Vec2::Zero(), patch.centroid(), patch.normal()});
  if (!found) return std::nullopt;
  const scene::SurfacePatch& element = s_.mesh.patch(found->element);
  if (element.corners != patch.corners) return std::nullopt;
  for (std::size_t k = 0; k < patch.corners; ++k)
    if (element.corner[k] != patch.corner[k]) return std::nullopt;
  return found->element.value;
}

Estimate Answers::of_patch(const scene::SurfacePatch& patch) const {
  const auto element = same_element(patch);
  return element ? of_element(*element) : of_tiles(patch);
}

/// The mean over the elements that tile the patch.  Of an element that is cut, constants know no more than the mean: its
/// variation is added to the bound, by the cut part's share.
Estimate Answers::of_tiles(const scene::SurfacePatch& patch) const {
  Spectrum flux, noise_squared, error;
  double covered = 0.0;
  const double plane = 1e-6 * std::sqrt(patch.area);
  const Vec3 normal = patch.normal();
  for (const mesh::ElementMesh::Part& part : s_.mesh.parts()) {
    if (part.surface != patch.surface || part.side != patch.side) continue;
    for (std::size_t i = part.first; i < part.first + part.count; ++i) {
      const scene::SurfacePatch& element = s_.mesh.patches()[i];
      if (std::abs(normal.dot(element.corner[0] - patch.corner[0])) > plane || element.normal().dot(normal) < 0.999)
        continue;
      const double area = shared_area(element, patch);
      if (area <= 0.0) continue;
      covered += area;
      flux += area * s_.irradiance[i];
      noise_squared += area * area * (s_.irradiance_noise[i] * s_.irradiance_noise[i]);
      error += area * s_.irradiance_error[i];
      if (area < (1 - 1e-9) * element.area) error += area * irradiance_variation(s_, i);
    }
  }
  if (covered <= 0.0) return {};  // no element lies there: nothing is claimed
  return {flux / covered, root(noise_squared) / covered, error / covered, Claim::estimated, 0};
}

/// The part of the mesh that the patches cover: all of one side of one surface, told by their area.
const mesh::ElementMesh::Part* Answers::whole_part(std::span<const scene::SurfacePatch> patches) const {
  double covered = 0.0;
  for (const scene::SurfacePatch& patch : patches) {
    if (patch.surface != patches.front().surface || patch.side != patches.front().side) return nullptr;
    covered += patch.area;
  }
  for (const mesh::ElementMesh::Part& part : s_.mesh.parts()) {
    if (patches.empty() || part.surface != patches.front().surface || part.side != patches.front().side) continue;
    double area = 0.0;
    for (std::size_t i = part.first; i < part.first + part.count; ++i) area += s_.mesh.patches()[i].area;
    return std::abs(area - covered) <= 1e-6 * area ? &part : nullptr;
  }
  return nullptr;
}

/// Noise is added in squares: elements of one plane share no sampled pair.
Estimate Answers::operator()(const measure::Flux& asked, std::uint64_t) const {
  Estimate sum{Spectrum(), Spectrum(), Spectrum(), Claim::estimated, 0};
  const auto add = [&](double area, const Estimate& part) {
    sum.value += area * part.value;
    sum.standard_error += area * area * (part.standard_error * part.standard_error);
    sum.error_bound += area * part.error_bound;
    if (part.claim == Claim::none) sum.claim = Claim::none;
  };
  if (const auto* part = whole_part(asked.through))
    for (std::size_t i = part->first; i < part->first + part->count; ++i) add(s_.mesh.patches()[i].area, of_element(i));
  else
    for (const scene::SurfacePatch& patch : asked.through) add(patch.area, of_patch(patch));
  sum.standard_error = root(sum.standard_error);
  return sum;
}

Estimate Answers::operator()(const measure::PointIrradiance& asked, std::uint64_t key) const {
  const Gathered gathered = gather_(asked, key, importance_);
  Spectrum sizes, from_elements, from_noise;
  for (const GatheredElement& g : gathered.elements) {
    const auto j = static_cast<std::size_t>(g.element);
    sizes += g.factor * magnitude(halving_[j]);
    const Spectrum noise = s_.reflectance[j] * s_.irradiance_noise[j];
    from_noise += g.factor * g.factor * (noise * noise);
    from_elements += g.factor * (s_.reflectance[j] * s_.irradiance_error[j]);
  }
  const Spectrum halving = magnitude(irradiance(gathered, halving_)), noise = irradiance_noise(gathered, s_.radiosity);
  Spectrum error = from_elements;  // the elements' own bounds, reflected: what the gather inherits
  for (int c = 0; c < Spectrum::capacity; ++c) error[c] += std::max(halving[c], 0.05 * sizes[c]);
  return {irradiance(gathered, s_.radiosity), root(noise * noise + from_noise), error, Claim::estimated, gathered.rays};
}

Estimate Answers::operator()(const measure::PixelRadiance& asked, std::uint64_t key) const {
  constexpr int side = 4;
  const scene::Camera& camera = scene_.camera(asked.camera);
  core::RandomNumbers random(core::derived_seed(seed_, "pixels"), 0, key);
  core::Moments radiance;
  Spectrum error;
  for (int k = 0; k < side * side; ++k) {
    const double x = asked.x + (k % side + random.next()) / side, y = asked.y + (k / side + random.next()) / side;
    const auto hit = rays_.closest({camera.eye, camera.direction(x, y)});
    const auto element = hit ? s_.mesh.locate(*hit) : std::nullopt;
    if (!element) {
      radiance.add(Spectrum::zero());  // nothing, or a black back
      continue;
    }
    const std::size_t i = element->element.value;
    radiance.add(s_.radiosity[i] * inv_pi);
    error += inv_pi / (side * side) *
             (s_.reflectance[i] * (s_.irradiance_error[i] + s_.irradiance_noise[i]) + s_.field_error[i]);
  }
  return {radiance.mean(), radiance.standard_error(), error, Claim::estimated, radiance.count()};
}

}  // namespace

std::vector<Estimate> RadiosityMethod::answer(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                                              Run& run) const {
  std::vector<Estimate> estimates(asked.size());
  const Answers answers(scene, solution_, rays_, run.seed);
  core::Progress::Stage stage(run.progress, "radiosity answers", asked.size());
  run.threads.for_blocks(static_cast<Index>(asked.size()), 16, [&](Index begin, Index end) {
    run.throw_if_stopped("radiosity answers");
    for (Index k = begin; k < end; ++k) {
      const auto m = static_cast<std::size_t>(k);
      estimates[m] = std::visit([&](const auto& question) { return answers(question, m); }, asked[m]);
    }
    stage.advance(static_cast<std::uint64_t>(end - begin));
  });
  return estimates;
}

}  // namespace interflect::fem
