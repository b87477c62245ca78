#pragma once

#include <random>
#include <vector>

#include "fem/radiosity_operator.h"
#include "fem/space/plane_basis.h"
#include "mesh/uniform.h"
#include "tests/fem/rooms.h"
#include "tests/fem/space/seen_radiosity.h"

/// Solutions that are known because they were chosen.
namespace interflect::fem::test {

using solvers::ColumnMatrix;
using Random = std::mt19937;

inline constexpr int highest = 2;  ///< order of elements
inline constexpr Index most_functions = plane_functions(highest);

inline double between(double low, double high, Random& random) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// A closed room on a trapezoid with two tetrahedra turned at random, apart from each other and from the walls.
inline scene::Scene room_of_tetrahedra(Random& random, double scale = 1) {
  const double w = between(2, 2.5, random), d = between(1.2, 1.6, random), h = between(1.2, 1.6, random);
  geometry::Ring floor{{0, 0, 0}, {w, 0, 0}, {w - between(0, .3, random), d, 0}, {between(0, .3, random), d, 0}};
  for (Vec3& x : floor) x *= scale;
  const Vec3 up(0, 0, scale * h);
  scene::SceneBuilder builder({"y"}, scene::Quantity::radiometric);
  const auto material = [&] { return builder.add_material(diffuse(between(.2, .8, random))); };
  builder.add_polygon("floor", {floor, {}}, material());
  builder.add_polygon("ceiling", {{floor[0] + up, floor[3] + up, floor[2] + up, floor[1] + up}, {}}, material());
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 &a = floor[k], &b = floor[(k + 1) % 4];
    builder.add_polygon("wall", {{a, a + up, b + up, b}, {}}, material());
  }
  for (const double at : {.3, .65}) {
    Vec3 middle(at * w, 0, 0), axis;
    middle.y() = between(.4, .6, random) * d;
    middle.z() = between(.4, .6, random) * h;
    for (double& along : axis) along = between(-1, 1, random);
    const Eigen::AngleAxisd turn(between(.3, 2.8, random), axis.normalized());
    std::array<Vec3, 4> corner{Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)};
    for (Vec3& x : corner) x = scale * (middle + turn * (between(.12, .22, random) * x));
    for (const auto [i, j, k] : {std::array{0u, 1u, 2u}, {0u, 2u, 3u}, {0u, 3u, 1u}, {1u, 3u, 2u}})
      builder.add_polygon("body", {{corner[i], corner[j], corner[k]}, {}}, material());
  }
  return builder.finish();
}

/// Quads cut in four by lines somewhere, small ones not; some parts are cut into triangles.
inline std::vector<scene::SurfacePatch> unequal_elements(const scene::Scene& scene, Random& random) {
  std::vector<scene::SurfacePatch> patches;
  const double large = .1 * scene.box().diagonal().squaredNorm();
  for (const scene::SurfaceId id : scene.surface_ids()) {
    const geometry::Ring& ring = scene.surface(id).outline->outer;
    if (ring.size() == 3) {
      patches.push_back(scene::make_patch(id, scene::Side::front, ring));
      continue;
    }
    std::vector<double> u{0, 1}, v{0, 1};
    if (scene.area(id) > large)
      for (std::vector<double>* lines : {&u, &v}) lines->insert(lines->begin() + 1, between(.25, .75, random));
    for (std::size_t a = 0; a + 1 < u.size(); ++a)
      for (std::size_t b = 0; b + 1 < v.size(); ++b) {
        const Vec3 corner[] = {point_on(ring, u[a], v[b]), point_on(ring, u[a + 1], v[b]),
                               point_on(ring, u[a + 1], v[b + 1]), point_on(ring, u[a], v[b + 1])};
        const Vec3 half[] = {corner[0], corner[2], corner[3]};
        const bool cut = between(0, 1, random) < .25;
        patches.push_back(scene::make_patch(id, scene::Side::front, std::span(corner).first(cut ? 3 : 4)));
        if (cut) patches.push_back(scene::make_patch(id, scene::Side::front, half));
      }
  }
  return patches;
}

/// The room's faces cut into four, and then some elements, their neighbours not.
inline std::vector<scene::SurfacePatch> elements_with_hanging_corners(const scene::Scene& scene, Random& random) {
  const mesh::ElementMesh whole = mesh::whole_faces(scene);
  std::vector<bool> first(whole.patches().size());
  for (std::size_t i = 0; i < 6; ++i) first[i] = true;
  const mesh::ElementMesh once = mesh::quartered(whole, first).mesh;
  std::vector<bool> then(once.patches().size());
  for (std::size_t i = 0; i < then.size(); ++i) then[i] = between(0, 1, random) < .15;
  const mesh::ElementMesh twice = mesh::quartered(once, then).mesh;
  return {twice.patches().begin(), twice.patches().end()};
}

/// Of degree 0, 1 and 2 on each surface.
inline std::vector<std::vector<SurfaceRadiosity>> random_solutions(const scene::Scene& scene, Random& random) {
  std::vector<std::vector<SurfaceRadiosity>> b;
  for (int degree = 0; degree <= highest; ++degree)
    for (auto& of_surface : b.emplace_back(scene.surfaces.size()))
      for (int k = 0; k < plane_functions(degree); ++k)
        of_surface.c[std::size_t(k)] = (k == 0 ? 1 : 0) + between(-.5, .5, random);
  return b;
}

inline double largest(const ColumnMatrix& m) { return m.cwiseAbs().maxCoeff(); }

/// Means of T b N_a over elements, of all functions: elements and functions x solutions.
class Load {
 public:
  Load(const SeenRadiosity& seen, std::span<const scene::SurfacePatch> patches, SeenRadiosity::Solutions b)
      : seen_(seen), patches_(patches), b_(b) {}

  /// The room's part on few cells that shrink towards the elements' sides, where it is d ln d in the distance d; the
  /// rest on many equal ones, for its kinks.
  ColumnMatrix on_cells(int of_room, int of_rest, int points = 6) const {
    ColumnMatrix means = ColumnMatrix::Zero(std::ssize(patches_) * most_functions, std::ssize(b_));
    for (std::size_t i = 0; i < patches_.size(); ++i) {
      auto rows = means.middleRows(static_cast<Index>(i) * most_functions, most_functions);
      add(SeenRadiosity::Part::room, patches_[i], of_room, gauss_legendre(points), rows);
      add(SeenRadiosity::Part::bodies_and_hidden, patches_[i], of_rest, gauss_legendre(3), rows);
    }
    return means;
  }

 private:
  /// Onto [0, 1], with no slope nor curvature at its ends.
  static double smooth_step(double t) { return t * t * t * (10 + t * (6 * t - 15)); }
  static double slope(double t) { return 30 * t * t * (1 - t) * (1 - t); }

  void add(SeenRadiosity::Part part, const scene::SurfacePatch& patch, int cells, const Rule& rule,
           Eigen::Ref<ColumnMatrix> means) const {
    const PlaneBasis basis(highest, patch.ring(), patch.normal());
    std::vector<double> Tb(b_.size());
    for (int k = 0; k < cells * cells; ++k)
      for (const RuleNode& p : rule)
        for (const RuleNode& q : rule) {
          double u = (k % cells + p.u) / cells, v = (k / cells + q.u) / cells;
          double weight = p.weight * q.weight / (cells * cells);
          if (part == SeenRadiosity::Part::room) {
            weight *= slope(u) * slope(v);
            u = smooth_step(u), v = smooth_step(v);
          }
          if (patch.corners == 3) u *= 1 - v, weight *= 1 - v;
          const Vec3 x = point_on(patch.ring(), u, v);
          weight *= jacobian(patch.ring(), u, v) / patch.area;
          std::fill(Tb.begin(), Tb.end(), 0.0);
          seen_.add(part, x, patch.normal(), b_, Tb);
          means += weight * basis.at(x) * Eigen::Map<const Eigen::RowVectorXd>(Tb.data(), std::ssize(Tb));
        }
  }

  const SeenRadiosity& seen_;
  std::span<const scene::SurfacePatch> patches_;
  SeenRadiosity::Solutions b_;
};

/// A scene with elements and radiosities on it, as coefficients of the elements' functions, and what arrives of them.
struct Manufactured {
  /// @param cells  across an element, for what is behind bodies; of_room: for what nothing hides
  Manufactured(scene::Scene of, std::vector<scene::SurfacePatch> elements, int cells, Random& random, int of_room = 4)
      : scene(std::move(of)), patches(std::move(elements)), b(random_solutions(scene, random)) {
    const SeenRadiosity seen(scene);
    const Load load(seen, patches, b);
    arriving = load.on_cells(of_room, cells);
    const bool few = of_room < 4;
    load_error = largest(arriving - load.on_cells(few ? of_room : of_room / 2, cells / 2, few ? 5 : 6)) / 3;
    wanted = ColumnMatrix::Zero(arriving.rows(), arriving.cols());
    for (std::size_t i = 0; i < patches.size(); ++i) {
      const scene::SurfacePatch& patch = patches[i];
      const PlaneBasis basis(highest, patch.ring(), patch.normal());
      std::vector<SurfaceNode> nodes;
      append_nodes(patch.ring(), rules_of(4).of(patch.corners), nodes);
      for (const SurfaceNode& node : nodes)
        for (std::size_t m = 0; m < b.size(); ++m)
          wanted.block<most_functions, 1>(Index(i) * most_functions, Index(m)) +=
              node.weight / patch.area * seen.value(b[m][patch.surface.value], patch.surface, node.position) *
              basis.at(node.position);
    }
  }

  /// Unknowns of an order, of the solutions that it can represent.
  ColumnMatrix of_order(int order, const ColumnMatrix& all) const {
    const Index f = plane_functions(order);
    ColumnMatrix out(std::ssize(patches) * f, order + 1);
    for (Index i = 0; i < std::ssize(patches); ++i)
      out.middleRows(i * f, f) = all.block(i * most_functions, 0, f, order + 1);
    return out;
  }
  ColumnMatrix reflectance(int order) const {
    const Index f = plane_functions(order);
    ColumnMatrix rho(std::ssize(patches) * f, order + 1);
    for (Index i = 0; i < std::ssize(patches); ++i)
      rho.middleRows(i * f, f).setConstant(scene.material(patches[std::size_t(i)].surface).reflectance[0]);
    return rho;
  }
  /// b* - R G^-1 (what arrives of it)
  ColumnMatrix exitance(int order) const {
    return of_order(order, wanted) - reflectance(order).cwiseProduct(of_order(order, arriving));
  }
  RadiosityOperator assembled(const RadiositySettings& settings, Run& run) const {
    const auto rays = raycast::make_ray_caster("embree", scene);
    return assemble_operator(scene, patches, *rays, settings, run);
  }

  scene::Scene scene;
  std::vector<scene::SurfacePatch> patches;
  std::vector<std::vector<SurfaceRadiosity>> b;
  ColumnMatrix arriving, wanted;
  /// Largest; a third of the difference to twice the step, or in the room to a point less a cell where those are few:
  /// errors fall with the square of the step, and faster in the room.
  double load_error = 0;
};

}  // namespace interflect::fem::test
