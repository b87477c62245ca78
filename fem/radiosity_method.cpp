#include "fem/radiosity_method.h"

#include <algorithm>
#include <cmath>

#include "core/moments.h"
#include "core/random.h"
#include "fem/error_estimate.h"
#include "fem/gather.h"
#include "fem/point_view_factors.h"
#include "geometry/overlap.h"

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
  Estimate by_polynomials(const measure::PointIrradiance& asked) const;
  Estimate radiosity_at(std::size_t element, const scene::SurfacePoint& x) const;

  const scene::Scene& scene_;
  const RadiositySolution& s_;
  const raycast::RayCaster& rays_;
  PixelRays pixel_;
  std::uint64_t seed_;
  Gather gather_;
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
/// part's share.  Noise: what elements have of their own is added in squares (twice, where elements of the region may
/// see each other, so that they share random numbers: (a + b)² <= 2 a² + 2 b²), what all have in common as it is.
Estimate Answers::arriving_on(std::vector<Tile> tiles, bool plane) const {
  std::sort(tiles.begin(), tiles.end(), [](const Tile& a, const Tile& b) { return a.element < b.element; });
  Estimate flux{Spectrum(), Spectrum(), Spectrum(), Claim::estimated, 0};
  Spectrum own_variance;
  double covered = 0.0;
  for (std::size_t k = 0; k < tiles.size();) {
    const std::size_t i = tiles[k].element;
    double area = 0.0;
    for (; k < tiles.size() && tiles[k].element == i; ++k) area += tiles[k].area;
    covered += area;
    flux.value += area * s_.irradiance[i];
    flux.error_bound += area * s_.irradiance_error[i];
    if (area < (1 - 1e-9) * s_.mesh.patches()[i].area) flux.error_bound += area * irradiance_variation(s_, i);
    own_variance += area * area * s_.own_variance(i);
  }
  const Spectrum shared = covered * s_.shared_noise;
  flux.standard_error = sqrt((plane ? 1.0 : 2.0) * own_variance + shared * shared);
  return flux;
}

/// Mean over what tiles the patch; nothing is claimed where no element lies.
Estimate Answers::operator()(const measure::PatchIrradiance& asked) const {
  std::vector<Tile> tiles;
  add_tiles(asked.patch, tiles);
  double covered = 0.0;
  for (const Tile& tile : tiles) covered += tile.area;
  if (covered <= 0.0) return {};
  return scaled(arriving_on(std::move(tiles), true), 1.0 / covered);
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
  return arriving_on(std::move(tiles), face_one_way(asked.through));
}

/// Of polynomials: the iterated value, whose last bounce has no noise, less the same of the order below.
Estimate Answers::by_polynomials(const measure::PointIrradiance& asked) const {
  const PolynomialField& field = *s_.field;
  std::vector<double> F(static_cast<std::size_t>(field.radiosity.rows())), rounding(s_.mesh.size());
  (*exact_)(asked, F, rounding);
  Spectrum value, below, sizes, from_elements, own_variance, shared;
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
    own_variance += of_j[0] * of_j[0] * (rho * rho * s_.own_variance(j));
    shared += of_j[0] * (rho * s_.shared_noise);
  }
  const Spectrum difference = abs(value - below);
  Spectrum error = from_elements;
  for (int c = 0; c < Spectrum::capacity; ++c) error[c] += std::max(difference[c], 0.05 * sizes[c]);
  return {value, sqrt(own_variance + shared * shared), error, Claim::estimated, 0};
}

Estimate Answers::operator()(const measure::PointIrradiance& asked) const {
  if (exact_) return by_polynomials(asked);
  const Gathered gathered = gather_(asked, key_of(asked), importance_);
  Spectrum sizes, from_elements, own_variance, shared;
  for (const GatheredElement& g : gathered.elements) {
    const auto j = static_cast<std::size_t>(g.element);
    sizes += g.factor * abs(halving_[j]);
    const Spectrum rho = s_.reflectance[j];
    own_variance += g.factor * g.factor * (rho * rho * s_.own_variance(j));
    shared += g.factor * (rho * s_.shared_noise);
    from_elements += g.factor * (s_.reflectance[j] * s_.irradiance_error[j]);
  }
  const Spectrum halving = abs(irradiance(gathered, halving_)), noise = irradiance_noise(gathered, s_.radiosity);
  Spectrum error = from_elements;  // the elements' own bounds, reflected: what the gather inherits
  for (int c = 0; c < Spectrum::capacity; ++c) error[c] += std::max(halving[c], 0.05 * sizes[c]);
  return {irradiance(gathered, s_.radiosity), sqrt(noise * noise + own_variance + shared * shared), error,
          Claim::estimated, gathered.rays};
}

/// B_h, or the iterated one.
Estimate Answers::radiosity_at(std::size_t i, const scene::SurfacePoint& x) const {
  const Spectrum rho = s_.reflectance[i];
  if (!pixel_.gather)
    return {s_.field ? s_.field->at(i, x.position) : s_.radiosity[i], rho * s_.irradiance_noise[i],
            rho * s_.irradiance_error[i] + s_.field_error[i], Claim::estimated, 0};
  Estimate B = (*this)(measure::PointIrradiance{x.position, s_.mesh.patches()[i].normal(), x.surface});
  B.value = s_.exitance[i] + rho * B.value;
  B.standard_error *= rho;
  B.error_bound *= rho;
  return B;
}

Estimate Answers::operator()(const measure::PixelRadiance& asked) const {
  const int side = pixel_.side;
  const bool alone = side == 1;  // through the middle of the pixel, whose radiance it is then
  const scene::Camera& camera = scene_.camera(asked.camera);
  core::RandomNumbers random(core::derived_seed(seed_, "pixels"), 0, key_of(asked));
  core::Moments radiance;
  Spectrum error;
  for (int k = 0; k < side * side; ++k) {
    const int column = k % side, row = k / side;
    const double in_column = alone ? 0.5 : random.next(), in_row = alone ? 0.5 : random.next();
    const double x = asked.x + (column + in_column) / side, y = asked.y + (row + in_row) / side;
    const auto hit = rays_.closest({camera.eye, camera.direction(x, y)});
    const auto element = hit ? s_.mesh.locate(*hit) : std::nullopt;
    if (!element) {
      radiance.add(Spectrum::zero());  // nothing, or a black back
      continue;
    }
    const Estimate B = radiosity_at(element->element.value, *hit);
    radiance.add(inv_pi * B.value);
    error += inv_pi / (side * side) * (B.error_bound + B.standard_error);
  }
  return {radiance.mean(), radiance.count() > 1 ? radiance.standard_error() : Spectrum(), error, Claim::estimated,
          radiance.count()};
}

}  // namespace

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
