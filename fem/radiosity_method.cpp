#include "fem/radiosity_method.h"

#include <algorithm>
#include <cmath>

#include "core/moments.h"
#include "core/random.h"
#include "fem/error_estimate.h"
#include "fem/gather.h"
#include "fem/point_of_view.h"
#include "fem/point_view_factors.h"
#include "fem/specular/ray_gather.h"
#include "fem/sum_noise.h"
#include "geometry/overlap.h"
#include "scene/film_map.h"

namespace interflect::fem {

namespace {

/// The part of a patch that lies in one element.
struct Tile {
  std::size_t element;
  double area;  ///< [m²]
};

/// The random numbers of a question are keyed by what it asks, not by where in a list it stands.
std::uint64_t key_of(const measure::PointIrradiance& at) {
  return core::key_of({at.position.x(), at.position.y(), at.position.z(), at.normal.x(), at.normal.y(), at.normal.z()});
}
std::uint64_t key_of(const measure::PixelRadiance& pixel) {
  return core::key_of(
      {static_cast<double>(pixel.camera.value), static_cast<double>(pixel.x), static_cast<double>(pixel.y)});
}

/// An answer whose noise is told apart.  What it has from the elements is one and the same deviation for all answers,
/// and does not average out among them; what its own rays leave is new in each.
struct Answer {
  Estimate by_itself;  ///< its standard error is of its own rays
  Spectrum inherited;  ///< standard error, of elements

  Estimate estimate() const {
    Estimate all = by_itself;
    all.standard_error = sqrt(by_itself.standard_error * by_itself.standard_error + inherited * inherited);
    return all;
  }
};

/// Beside mirrors, to a side: of a gather at a point, and at each of the points that a pixel's rays see.
constexpr int rays_at_points = 64, rays_in_pixels = 6;

/// Answers one list, measurement by measurement: everything here is read only.
class Answers {
 public:
  Answers(const scene::Scene& scene, const RadiositySolution& solution, const raycast::RayCaster& rays,
          const PixelRays& pixel, std::uint64_t seed)
      : scene_(scene),
        s_(solution),
        rays_(rays),
        pixel_(pixel),
        seed_(seed),
        gather_(scene, solution.mesh.patches(), rays, seed) {
    constexpr double accuracy_of_pixels = 1e-4;
    if (any_smooth(scene)) chains_.emplace(scene, rays, seed);
    if (s_.field) exact_.emplace(scene, s_.mesh.patches(), s_.field->order, pixel.gather ? accuracy_of_pixels : 0.0);
    for (std::size_t i = 0; i < s_.radiosity.size(); ++i) {
      importance_.push_back(std::max(0.0, scene.weigh(s_.radiosity[i])));
      halving_.push_back(s_.radiosity[i] - s_.coarse_radiosity[i]);
    }
  }

  Estimate operator()(const measure::PatchIrradiance& asked) const;
  Estimate operator()(const measure::Flux& asked) const;
  Estimate operator()(const measure::PointIrradiance& asked) const;
  Estimate operator()(const measure::PixelRadiance& asked) const;

 private:
  std::optional<std::size_t> same_element(const scene::SurfacePatch& patch) const;
  void add_tiles(const scene::SurfacePatch& patch, std::vector<Tile>& tiles) const;
  Estimate arriving_on(std::vector<Tile> tiles, bool plane) const;
  Answer at(const measure::PointIrradiance& asked, int side_of_rays = rays_at_points) const;
  Answer by_polynomials(const measure::PointIrradiance& asked) const;
  Answer by_constants(const measure::PointIrradiance& asked) const;
  Answer by_mirrors(const measure::PointIrradiance& asked, int side) const;
  SpecularChains::End seen(const raycast::Ray& ray) const;
  Answer radiosity_at(std::size_t element, const scene::SurfacePoint& x) const;

  const scene::Scene& scene_;
  const RadiositySolution& s_;
  const raycast::RayCaster& rays_;
  PixelRays pixel_;
  std::uint64_t seed_;
  Gather gather_;
  std::optional<SpecularChains> chains_;   ///< beside smooth surfaces
  std::optional<PointViewFactors> exact_;  ///< of polynomials
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

void Answers::add_tiles(const scene::SurfacePatch& patch, std::vector<Tile>& tiles) const {
  if (const auto element = same_element(patch)) {
    tiles.push_back({*element, patch.area});
    return;
  }
  const double plane = 1e-6 * std::sqrt(patch.area);
  const Vec3 normal = patch.normal();
  for (const mesh::ElementMesh::Part& part : s_.mesh.parts()) {
    if (part.surface != patch.surface || part.side != patch.side) continue;
    for (std::size_t i = part.first; i < part.first + part.count; ++i) {
      const scene::SurfacePatch& element = s_.mesh.patches()[i];
      if (std::abs(normal.dot(element.corner[0] - patch.corner[0])) > plane || element.normal().dot(normal) < 0.999)
        continue;
      if (const double area = geometry::overlap_area(element.ring(), patch.ring()); area > 0.0)
        tiles.push_back({i, area});
    }
  }
}

/// The flux that arrives on elements and parts of elements: sum of area times irradiance, elements in their order.
///
/// Of an element that is cut, constants know no more than the mean: its variation is added to the bound, by the cut
/// part's share.
/// @param plane  whether none of them sees another, or itself in a mirror
Estimate Answers::arriving_on(std::vector<Tile> tiles, bool plane) const {
  std::sort(tiles.begin(), tiles.end(), [](const Tile& a, const Tile& b) { return a.element < b.element; });
  Estimate flux{Spectrum(), Spectrum(), Spectrum(), Claim::estimated, 0};
  SumNoise noise(s_);
  for (std::size_t k = 0; k < tiles.size();) {
    const std::size_t i = tiles[k].element;
    double area = 0.0;
    for (; k < tiles.size() && tiles[k].element == i; ++k) area += tiles[k].area;
    flux.value += area * s_.irradiance[i];
    flux.error_bound += area * s_.irradiance_error[i];
    if (area < (1 - 1e-9) * s_.mesh.patches()[i].area) flux.error_bound += area * irradiance_variation(s_, i);
    noise.add(i, Spectrum(area));
  }
  flux.standard_error = plane ? noise.apart() : noise.together();
  return flux;
}

/// Mean over what tiles the patch; nothing is claimed where no element lies.
Estimate Answers::operator()(const measure::PatchIrradiance& asked) const {
  std::vector<Tile> tiles;
  add_tiles(asked.patch, tiles);
  double covered = 0.0;
  for (const Tile& tile : tiles) covered += tile.area;
  if (covered <= 0.0) return {};
  return scaled(arriving_on(std::move(tiles), !chains_), 1.0 / covered);
}

/// All elements of that side of that surface, if the patches cover it (told by their area).
std::vector<Tile> whole_side(const mesh::ElementMesh& mesh, std::span<const scene::SurfacePatch> patches) {
  std::vector<Tile> tiles;
  double covered = 0.0, area = 0.0;
  for (const scene::SurfacePatch& patch : patches) {
    if (patch.surface != patches.front().surface || patch.side != patches.front().side) return {};
    covered += patch.area;
  }
  for (const mesh::ElementMesh::Part& part : mesh.parts())
    if (part.surface == patches.front().surface && part.side == patches.front().side)
      for (std::size_t i = part.first; i < part.first + part.count; ++i) {
        tiles.push_back({i, mesh.patches()[i].area});
        area += tiles.back().area;
      }
  return std::abs(area - covered) <= 1e-6 * area ? tiles : std::vector<Tile>();
}

bool face_one_way(std::span<const scene::SurfacePatch> patches) {
  return std::all_of(patches.begin(), patches.end(), [&](const scene::SurfacePatch& patch) {
    return patch.normal().dot(patches.front().normal()) > 1 - 1e-9;
  });
}

Estimate Answers::operator()(const measure::Flux& asked) const {
  if (asked.through.empty()) return {Spectrum(), Spectrum(), Spectrum(), Claim::guaranteed, 0};
  std::vector<Tile> tiles = whole_side(s_.mesh, asked.through);
  bool all_found = !tiles.empty();
  if (!all_found) {
    all_found = true;
    for (const scene::SurfacePatch& patch : asked.through) {
      const std::size_t before = tiles.size();
      add_tiles(patch, tiles);
      all_found = all_found && tiles.size() > before;
    }
  }
  if (!all_found) return {};  // no element lies on a part of it: nothing is claimed
  return arriving_on(std::move(tiles), !chains_ && face_one_way(asked.through));
}

/// Of polynomials: the iterated value, whose last bounce has no noise, less the same of the order below.
Answer Answers::by_polynomials(const measure::PointIrradiance& asked) const {
  const PolynomialField& field = *s_.field;
  std::vector<double> F(static_cast<std::size_t>(field.radiosity.rows())), rounding(s_.mesh.size());
  (*exact_)(asked, F, rounding);
  Spectrum value, below, sizes, from_elements;
  SumNoise noise(s_);
  const auto functions = static_cast<std::size_t>(field.functions);
  for (std::size_t j = 0; j < rounding.size(); ++j) {
    const std::span<const double> of_j = std::span<const double>(F).subspan(j * functions, functions);
    const auto first = static_cast<Index>(j * functions);
    const Spectrum mine = PolynomialField::weighed(field.radiosity, first, of_j),
                   before = PolynomialField::weighed(field.radiosity_below, first, of_j);
    value += mine;
    below += before;
    sizes += abs(mine - before);
    const Spectrum rho = s_.reflectance[j];
    from_elements += of_j[0] * (rho * s_.irradiance_error[j]) +
                     rounding[j] * PolynomialField::sizes(field.radiosity, first, field.functions);
    if (field.irradiance_noise.size() > 0)
      noise.add(j, of_j[0] * rho, rho * PolynomialField::at_most(field.irradiance_noise, first + 1, of_j.subspan(1)));
    else
      noise.add(j, of_j[0] * rho);
  }
  const Spectrum difference = abs(value - below);
  Spectrum error = from_elements;
  for (int c = 0; c < Spectrum::capacity; ++c) error[c] += std::max(difference[c], 0.05 * sizes[c]);
  return {{value, Spectrum(), error, Claim::estimated, 0}, noise.apart()};
}

Answer Answers::by_constants(const measure::PointIrradiance& asked) const {
  const Gathered gathered = gather_(asked, key_of(asked), importance_);
  Spectrum sizes, from_elements;
  SumNoise noise(s_);
  for (const GatheredElement& g : gathered.elements) {
    const auto j = static_cast<std::size_t>(g.element);
    sizes += g.factor * abs(halving_[j]);
    const Spectrum rho = s_.reflectance[j];
    noise.add(j, g.factor * rho);
    from_elements += g.factor * (rho * s_.irradiance_error[j]);
  }
  const Spectrum halving = abs(irradiance(gathered, halving_));
  Spectrum error = from_elements;  // the elements' own bounds, reflected: what the gather inherits
  for (int c = 0; c < Spectrum::capacity; ++c) error[c] += std::max(halving[c], 0.05 * sizes[c]);
  return {{irradiance(gathered, s_.radiosity), irradiance_noise(gathered, s_.radiosity), error, Claim::estimated,
           gathered.rays},
          noise.apart()};
}

/// As by constants, but that each ray tells of what it ends on, by whatever way.
Answer Answers::by_mirrors(const measure::PointIrradiance& asked, int side) const {
  const RayGather rays(asked, *chains_, s_.mesh, seed_, key_of(asked), side);
  Spectrum sizes, from_elements;
  std::vector<Spectrum> of_elements(s_.mesh.patches().size());
  for (const RayGather::Met& met : rays.met()) {
    sizes += met.weight * abs(halving_[met.element]);
    from_elements += met.weight * s_.reflectance[met.element] * s_.irradiance_error[met.element];
    of_elements[met.element] += met.weight * s_.reflectance[met.element];
  }
  SumNoise noise(s_);
  for (std::size_t j = 0; j < of_elements.size(); ++j)
    if (!of_elements[j].is_zero()) noise.add(j, of_elements[j]);
  const Spectrum error = from_elements + max(abs(rays.irradiance(halving_)), 0.05 * sizes);
  return {{rays.irradiance(s_.radiosity), rays.noise(s_.radiosity), error, Claim::estimated, rays.rays()},
          noise.together()};
}

Answer Answers::at(const measure::PointIrradiance& asked, int side_of_rays) const {
  if (chains_) return by_mirrors(asked, side_of_rays);
  return exact_ ? by_polynomials(asked) : by_constants(asked);
}

/// Where the light of a ray from the eye comes from.
SpecularChains::End Answers::seen(const raycast::Ray& ray) const {
  return chains_ ? chains_->follow(ray) : SpecularChains::End{rays_.closest(ray)};
}

Estimate Answers::operator()(const measure::PointIrradiance& asked) const { return at(asked).estimate(); }

/// B_h, or the iterated one.
Answer Answers::radiosity_at(std::size_t i, const scene::SurfacePoint& x) const {
  const Spectrum rho = s_.reflectance[i];
  if (!pixel_.gather)
    return {{s_.field ? s_.field->at(i, x.position) : s_.radiosity[i], Spectrum(),
             rho * s_.irradiance_error[i] + s_.field_error[i], Claim::estimated, 0},
            rho * max(s_.irradiance_noise[i], s_.field ? s_.field->noise_at(i, x.position) : Spectrum::zero())};
  Answer B = at({x.position, s_.mesh.patches()[i].normal(), x.surface}, rays_in_pixels);
  B.by_itself.value = s_.exitance[i] + rho * B.by_itself.value;
  B.by_itself.standard_error *= rho;
  B.by_itself.error_bound *= rho;
  B.inherited *= rho;
  return B;
}

/// The mean over n rays.  Their spread tells the noise of the mean, with what the rays' own gathers leave; a single ray
/// has no spread, and that is stated as it is.  The elements' noise is the same for all rays and need not show in their
/// spread; however it is correlated, the standard error that it leaves in the mean is the mean of its own at most:
///
///   SE² = SE_rays² + (1/n sum_k inherited_k / pi)²
Estimate Answers::operator()(const measure::PixelRadiance& asked) const {
  const int side = chains_ ? std::max(2, pixel_.side) : pixel_.side;  // by mirrors a ray goes by chance
  const bool alone = side == 1;  // through the middle of the pixel, whose radiance it is then
  const scene::Camera& camera = scene_.camera(asked.camera);
  require_point_of_view(camera);
  const scene::FilmMap film(camera);
  core::RandomNumbers random(core::derived_seed(seed_, "pixels"), 0, key_of(asked));
  core::Moments radiance;
  Spectrum error, of_ray, inherited;
  const double share = inv_pi / (side * side);
  for (int k = 0; k < side * side; ++k) {
    const int column = k % side, row = k / side;
    const double in_column = alone ? 0.5 : random.next(), in_row = alone ? 0.5 : random.next();
    const double x = asked.x + (column + in_column) / side, y = asked.y + (row + in_row) / side;
    const auto ray = film.ray({x, y});
    const SpecularChains::End from = ray ? seen({ray->origin, ray->direction}) : SpecularChains::End{};
    const auto element = from.at ? s_.mesh.locate(*from.at) : std::nullopt;
    if (!element) {
      radiance.add(Spectrum::zero());  // nothing, or what absorbs
      continue;
    }
    const Answer B = radiosity_at(element->element.value, *from.at);
    radiance.add(inv_pi * (from.weight * B.by_itself.value));
    error += share * (from.weight * B.by_itself.error_bound);
    inherited += share * (from.weight * B.inherited);
    of_ray = inv_pi * (from.weight * B.by_itself.standard_error);
  }
  const Spectrum of_rays = radiance.count() > 1 ? radiance.standard_error() : of_ray;
  return {radiance.mean(), sqrt(of_rays * of_rays + inherited * inherited), error, Claim::estimated, radiance.count()};
}

}  // namespace

measure::Capabilities RadiosityMethod::capabilities() const {
  const auto finds = measure::PathClasses::of("A(D|S)*E");
  return {.unbiased = false, .consistent = true, .to_patches = finds, .to_points = finds, .to_pixels = finds};
}

std::vector<Estimate> RadiosityMethod::answer(const scene::Scene& scene, std::span<const measure::Measurement> asked,
                                              Run& run) const {
  std::vector<Estimate> estimates(asked.size());
  const Answers answers(scene, solution_, rays_, pixel_, run.seed);
  core::Progress::Stage stage(run.progress, "radiosity answers", asked.size());
  run.threads.for_blocks(static_cast<Index>(asked.size()), 16, [&](Index begin, Index end) {
    run.throw_if_stopped("radiosity answers");
    for (Index k = begin; k < end; ++k) {
      const auto m = static_cast<std::size_t>(k);
      estimates[m] = std::visit([&](const auto& question) { return answers(question); }, asked[m]);
    }
    stage.advance(static_cast<std::uint64_t>(end - begin));
  });
  return estimates;
}

}  // namespace interflect::fem
