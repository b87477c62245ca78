#include "fem/residual.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fem/columns.h"
#include "fem/point_view_factors.h"
#include "tests/fem/bounds/random_room.h"
#include "tests/fem/rooms.h"
#include "tests/fem/space/polynomial_settings.h"

namespace interflect::fem {
namespace {

using test::polynomial_settings;
using test::Room;

scene::Scene lit_room(double scale) {
  Room room;
  room.box(Vec3::Zero(), scale * Vec3(2, 3, 1.2), 1, true, .6);
  room.wall(scale * Vec3(.5, .5, 1.1), scale * Vec3(0, .5, 0), scale * Vec3(.5, 0, 0), 1, 0, 5);
  room.box(scale * Vec3(.7, .5, .3), scale * Vec3(.5, .8, .4), 1, false, .3);
  return room.finish();
}

// Everything emits 1 - rho and has radiosity 1: nothing is left of the equation, but what form factors err.
TEST(Residual, of_a_furnace_is_nothing) {
  Room room;
  room.box(Vec3::Zero(), {2, 3, 1.2}, 1, true, .6, .4);
  room.box({.7, .5, .3}, {.5, .8, .4}, 1, false, .6, .4);
  const scene::Scene scene = room.finish();
  core::LocalRun run(1, 2);
  for (const int order : {0, 1}) {
    const ResidualNorms found =
        residual_norms(scene, solve_radiosity(scene, polynomial_settings(order, 2, 1e-5), run.get()), run.get());
    EXPECT_LT(found.largest[0], 1e-4) << order;
    EXPECT_NEAR(found.largest_bound[0], found.largest[0] / .4, 1e-12);
    EXPECT_LE(found.rms[0], found.largest[0]);
  }
}

// The bound holds against a far better solution, is no more than 1 / (1 - rho) above what it bounds, and is the same at
// any scale.
TEST(Residual, bounds_the_error) {
  for (const double scale : {1e-6, 1., 1e6}) {
    const scene::Scene scene = lit_room(scale);
    core::LocalRun run(1, 2);
    const RadiositySolution truth = solve_radiosity(scene, polynomial_settings(2, .45 * scale, 1e-4), run.get());
    for (const int order : {0, 1}) {
      if (order == 0 && scale != 1) continue;
      const RadiositySolution s = solve_radiosity(scene, polynomial_settings(order, 1.5 * scale, 1e-5), run.get());
      const ResidualNorms found = residual_norms(scene, s, run.get());
      double squares = 0, area = 0;
      for (std::size_t i = 0; i < truth.radiosity.size(); ++i) {
        const scene::SurfacePatch& patch = truth.mesh.patches()[i];
        const auto there =
            s.mesh.locate({patch.surface, patch.side, 0, Vec2::Zero(), patch.centroid(), patch.normal()});
        ASSERT_TRUE(there);
        const std::size_t k = there->element.value;
        const double d = truth.field->at(i, patch.centroid())[0] -
                         (s.field ? s.field->at(k, patch.centroid())[0] : s.radiosity[k][0]);
        squares += patch.area * d * d;
        area += patch.area;
        EXPECT_LT(std::abs(d), found.largest_bound[0]) << order << ' ' << scale;
      }
      const double error = std::sqrt(squares / area);
      EXPECT_LT(error, found.rms_bound[0]) << order << ' ' << scale;
      EXPECT_GT(3 * error, found.rms_bound[0]) << order << ' ' << scale;
    }
  }
}

/// E + rho T B_h of a solution.
class Iterated {
 public:
  Iterated(const scene::Scene& scene, const RadiositySolution& s)
      : scene_(scene),
        coefficients_(s.field ? s.field->radiosity : to_columns(s.radiosity, 1)),
        factors_(scene, s.mesh.patches(), s.field ? s.field->order : 0, 1e-6) {}

  double at(const scene::SurfacePatch& on, const Vec3& x) const {
    std::vector<double> F(std::size_t(coefficients_.rows())), rounding(std::size_t(factors_.elements()));
    factors_({x, on.normal(), on.surface}, F, rounding);
    const scene::Material& material = scene_.material(on.surface);
    return material.exitance[0] +
           material.reflectance[0] *
               Eigen::Map<const Eigen::VectorXd>(F.data(), std::ssize(F)).dot(coefficients_.col(0));
  }

 private:
  const scene::Scene& scene_;
  solvers::ColumnMatrix coefficients_;
  PointViewFactors factors_;
};

/// Four inside, one near each edge and one near each corner.
std::vector<Vec3> points_of(const scene::SurfacePatch& patch, std::mt19937& random) {
  std::uniform_real_distribution<double> part(0, 1);
  constexpr double near = 1e-3;
  std::vector<Vec3> points;
  const auto corner = [&](std::size_t k) { return patch.corner[k % patch.corners]; };
  const auto inwards = [&](const Vec3& x, double share) -> Vec3 { return x + share * (patch.centroid() - x); };
  for (std::size_t k = 0; k < 4; ++k) {
    const double along = part(random), share = part(random);
    points.push_back(inwards(corner(k) + along * (corner(k + 1) - corner(k)), share));
  }
  for (std::size_t k = 0; k < patch.corners; ++k) {
    points.push_back(inwards(corner(k) + part(random) * (corner(k + 1) - corner(k)), near));
    points.push_back(inwards(corner(k), near));
  }
  return points;
}

struct LargestErrors {
  double of_field = 0, of_iterated = 0;  ///< |B - B_h| and |B - B_1|
};
LargestErrors largest_errors(const RadiositySolution& s, const Iterated& iterated, const Iterated& truth,
                             std::mt19937& random) {
  LargestErrors most;
  for (std::size_t i = 0; i < s.mesh.patches().size(); ++i) {
    const scene::SurfacePatch& patch = s.mesh.patches()[i];
    for (const Vec3& x : points_of(patch, random)) {
      const double B = truth.at(patch, x), B_h = s.field ? s.field->at(i, x)[0] : s.radiosity[i][0];
      most.of_field = std::max(most.of_field, std::abs(B - B_h));
      most.of_iterated = std::max(most.of_iterated, std::abs(B - iterated.at(patch, x)));
    }
  }
  return most;
}

/// Solutions of order 0, 1 and 2 in a room, against one on smaller elements.
void expect_bounds_at_any_point(const scene::Scene& scene, double element_size, std::mt19937& random) {
  core::LocalRun run(1, 2);
  const RadiositySolution better = solve_radiosity(scene, polynomial_settings(2, .5, 1e-3), run.get());
  const Iterated truth(scene, better);
  double rho = 0;
  for (const Spectrum& of : better.reflectance) rho = std::max(rho, of[0]);
  for (const int order : {0, 1, 2}) {
    const RadiositySolution s = solve_radiosity(scene, polynomial_settings(order, element_size, 1e-4), run.get());
    const Iterated iterated(scene, s);
    const ResidualNorms norms = residual_norms(scene, s, run.get());
    const LargestErrors found = largest_errors(s, iterated, truth, random);
    EXPECT_LT(found.of_field, norms.largest_bound[0]) << order;
    EXPECT_LT(found.of_iterated, rho * norms.largest_bound[0]) << order;
  }
}

// Anywhere in elements, along their edges and in their corners, of what is a polynomial there; and of the iterated
// solution B_1 = E + rho T B_h, since B - B_1 = rho T (B - B_h) is at most max rho times as large.
TEST(Residual, bounds_the_error_at_any_point) {
  std::mt19937 random(7);
  expect_bounds_at_any_point(lit_room(1), 1.5, random);
  expect_bounds_at_any_point(test::random_room(random), .9, random);
}

// In the dark B - B_h is nearly r itself, and |r| in corners and along edges is larger than at Gauss nodes, which alone
// bound less than half of the error there.
TEST(Residual, bounds_the_error_of_dark_rooms_at_any_point) {
  std::mt19937 random(7);
  for (const bool lit : {true, false}) {
    scene::Scene scene = lit ? lit_room(1) : test::random_room(random);
    for (scene::Material& material : scene.materials) material.reflectance = .2 * material.reflectance;
    expect_bounds_at_any_point(scene, lit ? 1.5 : .9, random);
  }
}

TEST(Residual, bounds_nothing_where_nothing_is_absorbed) {
  Room room;
  room.box(Vec3::Zero(), {2, 3, 1.2}, 1, true, 1);
  room.wall({.5, .5, 1.1}, {0, .5, 0}, {.5, 0, 0}, 1, 0, 5);
  const scene::Scene scene = room.finish();
  core::LocalRun run(1, 2);
  const ResidualNorms found =
      residual_norms(scene, solve_radiosity(scene, polynomial_settings(0, 2, 1e-3), run.get()), run.get());
  EXPECT_TRUE(std::isinf(found.rms_bound[0]));
  EXPECT_TRUE(std::isfinite(found.rms[0]));
}

}  // namespace
}  // namespace interflect::fem
