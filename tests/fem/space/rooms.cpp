#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "fem/assembly.h"
#include "fem/operator/dense_symmetric.h"
#include "fem/point_view_factors.h"
#include "fem/space/polynomials.h"
#include "solvers/solver.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

using test::Room;

/// K of polynomials on a scene's elements.
std::unique_ptr<DenseSymmetric> assembled(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches,
                                          int order, double tolerance, Run& run) {
  const auto caster = raycast::make_ray_caster("brute", scene);
  FormFactorContext context{scene, patches, *caster, 1, tolerance};
  context.order = order;
  const auto method = make_form_factor_method("analytic", context);
  std::vector<double> gram;
  for (const scene::SurfacePatch& patch : patches)
    gram.insert(gram.end(), static_cast<std::size_t>(plane_functions(order)), patch.area);
  auto K = std::make_unique<DenseSymmetric>(std::move(gram));
  assemble(*method, patches, *K, run);
  return K;
}

// Constants come back as constants, past what hides parts: sum_(j,0) K_(i,a),(j,0) = A_i for a = 0, and 0 for others.
TEST(RoomMoments, of_a_closed_room_with_bodies_send_constants_back) {
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const int order : {1, 2}) {
      if (scale != 1 && order == 2) continue;
      Room room;
      room.box(Vec3(0, 0, 0), Vec3(5, 4, 3) * scale, 2);
      room.box(Vec3(1, 1, .2) * scale, Vec3(1, 1.5, 1.2) * scale, 1, false);
      room.box(Vec3(3, 2, .5) * scale, Vec3(1, .8, 1.1) * scale, 1, false);
      const scene::Scene scene = room.finish();
      core::LocalRun run(1, 2);
      const double tolerance = order == 1 ? 1e-4 : 1e-3;
      const auto K = assembled(scene, room.patches, order, tolerance, run);
      const Index functions = plane_functions(order);
      for (Index i = 0; i < std::ssize(room.patches); ++i)
        for (Index a = 0; a < functions; ++a) {
          double sum = 0;
          for (Index j = 0; j < std::ssize(room.patches); ++j) sum += K->entry(i * functions + a, j * functions);
          EXPECT_NEAR(sum / room.patches[std::size_t(i)].area, a == 0 ? 1 : 0, tolerance)
              << order << ' ' << i << ' ' << a;
        }
    }
}

/// A solved scene of one channel: rho and E by surface, constant on each.
class Solved {
 public:
  Solved(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches, int order, double tolerance)
      : scene_(scene), patches_(patches), order_(order) {
    const auto K = assembled(scene, patches, order, tolerance, run_.get());
    solvers::ColumnMatrix rho = solvers::ColumnMatrix::Zero(K->size(), 1), e = rho;
    for (Index i = 0; i < std::ssize(patches); ++i) {
      rho.middleRows(i * functions(), functions()).setConstant(material(i).reflectance[0]);
      e(i * functions(), 0) = material(i).exitance[0];
    }
    solve(*K, rho, e);
  }
  void solve(const DenseSymmetric& K, const solvers::ColumnMatrix& rho, const solvers::ColumnMatrix& e) {
    const solvers::Reflection R(rho);
    solvers::SolverState state{e, 0};
    const auto report = solvers::make_solver("gauss-seidel")->advance({K, R, e}, state, {1e-14, 1000}, run_.get());
    EXPECT_TRUE(report.converged());
    c_ = state.x;
  }
  Index functions() const { return plane_functions(order_); }
  double mean(scene::SurfaceId id) const {
    double sum = 0, area = 0;
    for (std::size_t i = 0; i < patches_.size(); ++i)
      if (patches_[i].surface == id) {
        sum += patches_[i].area * c_(static_cast<Index>(i) * functions(), 0);
        area += patches_[i].area;
      }
    return sum / area;
  }
  /// E + rho T B_h
  double iterated(const Vec3& x, scene::SurfaceId on) const {
    const PointViewFactors factors(scene_, patches_, order_);
    std::vector<double> F(static_cast<std::size_t>(c_.rows())), error(patches_.size());
    const Vec3 normal = geometry::plane_of(scene_.surface(on).outline->outer).normal;
    factors({x, normal, on}, F, error);
    const scene::Material& material = scene_.material(on);
    return material.exitance[0] +
           material.reflectance[0] * Eigen::Map<const Eigen::VectorXd>(F.data(), c_.rows()).dot(c_.col(0));
  }
  const solvers::ColumnMatrix& coefficients() const { return c_; }

 private:
  const scene::Material& material(Index i) const { return scene_.material(patches_[std::size_t(i)].surface); }

  const scene::Scene& scene_;
  std::span<const scene::SurfacePatch> patches_;
  int order_;
  core::LocalRun run_{1, 2};
  solvers::ColumnMatrix c_;
};

/// Unit squares one apart, rho = 0.5 both, the lower one emits 1.
struct Squares {
  explicit Squares(int n) {
    Room room;
    low = room.wall({-.5, -.5, 0}, {1, 0, 0}, {0, 1, 0}, n, .5, 1);
    high = room.wall({-.5, -.5, 1}, {0, 1, 0}, {1, 0, 0}, n, .5);
    scene = room.finish();
    patches = room.patches;
  }
  scene::Scene scene;
  std::vector<scene::SurfacePatch> patches;
  scene::SurfaceId low, high;
};

// docs/truths.md 2.4.  Means converge with the order 2p + 2, and with them the iterated solution at every point.
TEST(RoomMoments, facing_squares_are_those_known_at_orders_that_grow_with_the_polynomials) {
  constexpr double mean_low = 1.010218055060, mean_high = .100947189239;
  for (const int order : {1, 2}) {
    std::vector<double> errors;
    for (const int n : {2, 4}) {
      const Squares squares(n);
      const Solved solved(squares.scene, squares.patches, order, 1e-10);
      errors.push_back(std::abs(solved.mean(squares.high) - mean_high));
      if (n < 4) continue;
      EXPECT_NEAR(solved.mean(squares.low), mean_low, order == 1 ? 1e-6 : 1e-8);
      EXPECT_NEAR(solved.mean(squares.high), mean_high, order == 1 ? 1e-6 : 1e-8);
      const Vec3 at[] = {{0, 0, 0}, {.25, .25, 0}, {.5, 0, 0}, {.5, .5, 0}};
      const double B_low[] = {1.012326762964, 1.010636247663, 1.009191215807, 1.007006348356},
                   B_high[] = {.120976802029, .104998409669, .091115016656, .069975044789};
      for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(solved.iterated(at[k], squares.low), B_low[k], order == 1 ? 1e-5 : 1e-6) << order << ' ' << k;
        EXPECT_NEAR(solved.iterated(at[k] + Vec3::UnitZ(), squares.high), B_high[k], order == 1 ? 1e-5 : 1e-6) << k;
      }
    }
    EXPECT_GT(std::log2(errors[0] / errors[1]), 2 * order + 1.6) << order << ": " << errors[0] << " -> " << errors[1];
  }
}

/// The unit cube's inside, n x n elements a wall that shrink towards the edges as (2k/n)^power; the floor emits 1.
struct Cube {
  Cube(int n, double power, double rho) {
    const auto line = [&](int k) {
      const double t = 2.0 * k / n;
      return t <= 1 ? 0.5 * std::pow(t, power) : 1 - 0.5 * std::pow(2 - t, power);
    };
    scene::SceneBuilder builder({"y"});
    for (int axis = 0; axis < 3; ++axis)
      for (const bool high : {false, true}) {
        Vec3 u = Vec3::Zero(), v = u, corner = u;
        u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1;
        if (high) corner[axis] = 1, std::swap(u, v);
        const auto material = builder.add_material(test::diffuse(rho, axis == 2 && !high ? 1 : 0));
        walls.push_back(builder.add_polygon("wall", test::parallelogram(corner, u, v), material));
        for (int a = 0; a < n; ++a)
          for (int b = 0; b < n; ++b) {
            const auto at = [&](int i, int j) -> Vec3 { return corner + line(i) * u + line(j) * v; };
            const Vec3 ring[] = {at(a, b), at(a + 1, b), at(a + 1, b + 1), at(a, b + 1)};
            patches.push_back(scene::make_patch(walls.back(), scene::Side::front, ring));
          }
      }
    scene = builder.finish();
  }
  double off(const Solved& solved, const std::array<double, 3>& known) const {
    return std::max({std::abs(solved.mean(walls[4]) - known[0]), std::abs(solved.mean(walls[5]) - known[1]),
                     std::abs(solved.mean(walls[0]) - known[2])});
  }
  scene::Scene scene;
  std::vector<scene::SurfacePatch> patches;
  std::vector<scene::SurfaceId> walls;  ///< x-, x+, y-, y+, floor, ceiling
};

// docs/truths.md 2.6: means of the floor, the ceiling and a wall, of constants on n x n equal squares.
TEST(RoomMoments, of_constants_in_a_cube_are_the_exact_discrete_ones) {
  const std::map<int, std::array<double, 3>> known{{1, {1.551724153645, .689551070738, .689681193904}},
                                                   {2, {1.572578202571, .668697021812, .689681193904}},
                                                   {4, {1.582491239007, .663164443045, .688586079487}},
                                                   {8, {1.585938761118, .661579559373, .688120419877}}};
  for (const auto& [n, means] : known) {
    const Cube cube(n, 1, .8);
    EXPECT_LT(cube.off(Solved(cube.scene, cube.patches, 0, 1e-10), means), 1e-9) << n;
  }
}

// Radiosity is rough along the edges: on equal elements no polynomials have their full order there, and where elements
// shrink towards them as their squares a few are enough.  Known to 2e-6.
TEST(RoomMoments, of_a_cube_converge_to_what_is_known) {
  constexpr std::array<double, 3> known{1.587505, .660979, .687879};
  const auto off = [&](double power, int order) {
    const Cube cube(6, power, .8);
    return cube.off(Solved(cube.scene, cube.patches, order, 1e-5), known);
  };
  const double equal = off(1, 1), graded_1 = off(2, 1), graded_2 = off(2, 2);
  EXPECT_LT(graded_2, 5e-6);
  EXPECT_LT(graded_1, equal / 1.5) << "equal " << equal << ", graded " << graded_1;
  EXPECT_GT(equal, 10 * graded_2);
}

// Any radiosity that is constant on surfaces solves the equation if each emits what it does not reflect: on any mesh,
// past whatever hides, with E by point view factors, which are exact, integrated over parts.
TEST(RoomMoments, return_a_manufactured_solution_past_bodies_in_the_way) {
  Room room;
  room.box({0, 0, 0}, {5, 4, 3}, 2, true, .6);
  room.box({1, 1, .2}, {1, 1.5, 1.2}, 1, false, .4);
  room.box({3, 2, .5}, {1, .8, 1.1}, 1, false, .4);
  const scene::Scene scene = room.finish();
  const auto& patches = room.patches;
  const auto b = [](scene::SurfaceId id) { return 1 + 0.3 * std::sin(7.0 * id.value); };
  core::LocalRun run(1, 2);
  const PointViewFactors factors(scene, patches);
  std::vector<double> F(patches.size()), error(F);
  const auto emitted = [&](const Vec3& x, const scene::SurfacePatch& on) {
    factors({x, on.normal(), on.surface}, F, error);
    double arrives = 0;
    for (std::size_t j = 0; j < F.size(); ++j) arrives += F[j] * b(patches[j].surface);
    return b(on.surface) - scene.material(on.surface).reflectance[0] * arrives;
  };
  for (const int order : {1, 2}) {
    const Index functions = plane_functions(order);
    const auto K = assembled(scene, patches, order, 1e-4, run);
    solvers::ColumnMatrix rho = solvers::ColumnMatrix::Zero(K->size(), 1), e = rho;
    const Rule rule = gauss_legendre(2);
    constexpr int parts = 6;
    for (Index i = 0; i < std::ssize(patches); ++i) {
      const scene::SurfacePatch& patch = patches[std::size_t(i)];
      const PlaneBasis basis(order, patch.ring(), patch.normal());
      rho.middleRows(i * functions, functions).setConstant(scene.material(patch.surface).reflectance[0]);
      for (int k = 0; k < parts * parts; ++k)
        for (const RuleNode& p : rule)
          for (const RuleNode& q : rule) {
            const Vec3 x = point_on(patch.ring(), (k % parts + p.u) / parts, (k / parts + q.u) / parts);
            e.middleRows(i * functions, functions) +=
                p.weight * q.weight / (parts * parts) * emitted(x, patch) * basis.at(x);
          }
    }
    const solvers::Reflection R(rho);
    solvers::SolverState state{e, 0};
    EXPECT_TRUE(solvers::make_solver("gauss-seidel")->advance({*K, R, e}, state, {1e-12, 1000}, run.get()).converged());
    for (Index i = 0; i < std::ssize(patches); ++i)
      for (Index a = 0; a < functions; ++a)
        EXPECT_NEAR(state.x(i * functions + a, 0), a == 0 ? b(patches[std::size_t(i)].surface) : 0, 1e-3)
            << order << ' ' << i << ' ' << a;
  }
}

}  // namespace
}  // namespace interflect::fem
