#include "tests/fem/space/manufactured.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fem/goal/iterated_transport.h"
#include "tests/fem/bounds/random_room.h"
#include "tests/fem/monte_carlo.h"
#include "tests/fem/space/returned.h"

// Any radiosity b solves the equation if surfaces emit E* = b - rho T b.  So, of b that elements can represent, every
// mesh returns b itself, up to what K's entries and the load are off: the strictest test of an assembled K.  T b is by
// SeenRadiosity, which shares nothing with K; point view factors share what finds and integrates shadows.
namespace interflect::fem {
namespace {

using solvers::ColumnMatrix;
using test::Manufactured;
using test::Random;
using test::Returned;
using test::SeenRadiosity;

/// At tolerances that fall, with errors that do until only the loads' are left.
/// @param finest  of elements of the highest order
void expect_returned(const Manufactured& m, double finest) {
  EXPECT_LT(m.load_error, 4e-5);
  for (int order = 0; order <= test::highest; ++order) {
    double before = std::numeric_limits<double>::infinity();
    for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
      if (order == test::highest && tolerance < finest) continue;
      const Returned r = test::returned(m, order, tolerance);
      test::expect_near(r, tolerance, order);
      EXPECT_LT(r.error, std::max(before / 2, r.of_loads)) << "order " << order << ", tolerance " << tolerance;
      before = r.error;
    }
  }
}

Manufactured random_room(unsigned seed, int cells, double scale = 1) {
  Random random(seed);
  scene::Scene scene = test::random_room(random, scale);
  auto patches = test::unequal_elements(scene, random);
  return {std::move(scene), std::move(patches), cells, random};
}

// What T b is held to, before it is used: 1 of 1 in a closed room, and what point view factors are.
TEST(SeenRadiosity, is_that_of_point_view_factors) {
  for (const bool tetrahedra : {false, true}) {
    Random random(4);
    const scene::Scene scene = tetrahedra ? test::room_of_tetrahedra(random) : test::random_room(random);
    const mesh::ElementMesh mesh = mesh::whole_faces(scene);
    const std::vector<scene::SurfacePatch> patches(mesh.patches().begin(), mesh.patches().end());
    Manufactured m(scene, patches, 2, random);
    m.b.emplace_back(scene.surfaces.size(), test::SurfaceRadiosity{{1}});
    core::LocalRun run(1, 1);
    const ElementNodes nodes = element_nodes(patches, 4);
    const PointViewFactors factors(scene, patches, test::highest);
    const ColumnMatrix Tb = iterated_transport(factors, patches, nodes, m.wanted, run.get());
    const SeenRadiosity seen(scene);
    for (std::size_t i = 0; i < patches.size(); ++i)
      for (std::size_t q = nodes.first[i]; q < nodes.first[i + 1]; ++q) {
        std::array<double, 4> at{};
        for (const auto part : {SeenRadiosity::Part::room, SeenRadiosity::Part::bodies_and_hidden})
          seen.add(part, nodes.nodes[q].position, patches[i].normal(), m.b, at);
        EXPECT_NEAR(at[3], 1, 1e-8);
        for (Index k = 0; k < 3; ++k) EXPECT_NEAR(at[std::size_t(k)], Tb(Index(q), k), 1e-8);
      }
  }
}

TEST(SeenRadiosity, of_cubic_functions_is_that_of_point_view_factors) {
  Random random(4);
  const scene::Scene scene = test::random_room(random);
  const SeenRadiosity seen(scene);
  const auto patches = test::whole_surfaces(scene);
  std::vector<std::vector<test::SurfaceRadiosity>> b(1, std::vector<test::SurfaceRadiosity>(patches.size()));
  for (test::SurfaceRadiosity& of_surface : b[0])
    for (double& c : of_surface.c) c = test::between(-1, 1, random);
  constexpr int order = 3;
  const Index f = plane_functions(order);
  ColumnMatrix coefficients = ColumnMatrix::Zero(std::ssize(patches) * f, 1);
  const ElementNodes nodes = element_nodes(patches, 4);
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const PlaneBasis basis(order, patches[i].ring(), patches[i].normal());
    for (std::size_t q = nodes.first[i]; q < nodes.first[i + 1]; ++q)
      coefficients.middleRows(Index(i) * f, f) += nodes.nodes[q].weight / patches[i].area *
                                                  seen.value(b[0][i], patches[i].surface, nodes.nodes[q].position) *
                                                  basis.at(nodes.nodes[q].position);
  }
  core::LocalRun run(1, 1);
  const ColumnMatrix Tb =
      iterated_transport(PointViewFactors(scene, patches, order), patches, nodes, coefficients, run.get());
  for (std::size_t i = 0; i < patches.size(); ++i)
    for (std::size_t q = nodes.first[i]; q < nodes.first[i + 1]; ++q) {
      std::array<double, 1> at{};
      for (const auto part : {SeenRadiosity::Part::room, SeenRadiosity::Part::bodies_and_hidden})
        seen.add(part, nodes.nodes[q].position, patches[i].normal(), b, at);
      EXPECT_NEAR(at[0], Tb(Index(q), 0), 1e-8);
    }
}

TEST(ManufacturedSolution, is_returned_past_a_body_by_unequal_elements) { expect_returned(random_room(1, 20), 1e-5); }

// Two tetrahedra hide parts of each other and, their shadows overlapping, of the walls.
TEST(ManufacturedSolution, is_returned_past_two_bodies_by_elements_with_hanging_corners) {
  Random random(2);
  scene::Scene scene = test::room_of_tetrahedra(random);
  auto patches = test::elements_with_hanging_corners(scene, random);
  expect_returned({std::move(scene), std::move(patches), 12, random}, 1e-4);
}

TEST(ManufacturedSolution, is_returned_at_any_scale) {
  for (const double scale : {1e-6, 1e6}) {
    const Manufactured m = random_room(5, 8, scale);
    for (const int order : {0, 1}) test::expect_near(test::returned(m, order, 1e-4), 1e-4, order);
  }
}

TEST(ManufacturedSolution, is_missed_where_one_entry_is_off) {
  const Manufactured m = random_room(1, 8);
  for (const int order : {0, 1}) {
    const Returned r = test::returned(m, order, 1e-4, 1.02);
    EXPECT_GT(r.error, 1e-4 / 5 + r.of_loads);
  }
}

/// Deviations of independent runs from the truth in their standard errors, what loads are off taken from them.
class Noise {
 public:
  explicit Noise(Index numbers) : sums_(Eigen::VectorXd::Zero(numbers)), squares_(sums_) {}

  void add(const Eigen::VectorXd& deviation, const Eigen::VectorXd& variance, double load_error) {
    for (Index a = 0; a < sums_.size(); ++a) {
      const double beyond = std::max(0.0, std::abs(deviation(a)) - load_error);
      const double z = beyond > 0 ? std::copysign(beyond, deviation(a)) / std::sqrt(variance(a)) : 0;
      largest_ = std::max(largest_, std::abs(z));
      sums_(a) += z;
      squares_(a) += z * z;
    }
    ++runs_;
  }
  /// No deviation is too large, nor a mean one, nor a mean square, by chi-squared; and noise is not stated to be far
  /// larger than it is (stratified samples make it smaller).  Of n normal numbers any is beyond
  /// sqrt(2 ln(n / p)) with a probability below p.
  /// @param alpha  probability that anything is too large by chance
  void expect_as_stated(double alpha) const {
    const auto beyond = [&](double n) { return std::sqrt(2 * std::log(3 * n / alpha)); };
    const double n = static_cast<double>(sums_.size());
    EXPECT_LT(largest_, beyond(n * runs_));
    EXPECT_LT(sums_.cwiseAbs().maxCoeff(), std::sqrt(runs_) * beyond(n));
    EXPECT_LT(squares_.maxCoeff(), test::chi_squared_quantile(runs_, beyond(n)));
    EXPECT_GT(squares_.mean(), .1 * runs_);
  }

 private:
  Eigen::VectorXd sums_, squares_;
  double largest_ = 0;
  int runs_ = 0;
};

// To first order, with S = (I - R G^-1 K)^-1 R G^-1 and the standard error s_ij of K_ij,
//
//   b - b* = S (K - K*) b*,    Var b_a = sum_{i<j} s_ij² (S_ai b_j + S_aj b_i)²;
//
// and what arrives, K b*, has the variance of `apply_variances`.
TEST(ManufacturedSolution, is_returned_by_sampled_visibility_within_its_noise) {
  constexpr double alpha = 1e-3 / 2;  // each
  constexpr int runs = 40;
  const Manufactured m = random_room(6, 8);
  const ColumnMatrix rho = m.reflectance(0), b = m.of_order(0, m.wanted), Tb = m.of_order(0, m.arriving);
  const Index n = b.rows();
  RadiositySettings settings;
  settings.form_factors = "gauss-lambert";
  settings.quadrature_tolerance = 1e-6;
  Noise of_arriving(n), of_solution(n);
  for (std::uint64_t seed = 1; seed <= runs; ++seed) {
    core::LocalRun run(seed, 1);
    const RadiosityOperator all = m.assembled(settings, run.get());
    const SymmetricOperator& K = *all.K;
    const Eigen::Map<const Eigen::VectorXd> areas(K.gram().data(), n);
    ColumnMatrix Kb(n, 1), variances(n, 1);
    K.apply(b, Kb, run.get());
    K.apply_variances(b.cwiseAbs2(), variances, run.get());
    of_arriving.add(Kb.col(0).cwiseQuotient(areas) - Tb.col(0), variances.col(0).cwiseQuotient(areas.cwiseAbs2()),
                    m.load_error);

    const Eigen::MatrixXd RS = test::reflected_resolvent(K, rho), S = RS * areas.cwiseInverse().asDiagonal();
    Eigen::VectorXd variance = Eigen::VectorXd::Zero(n);
    for (Index i = 0; i < n; ++i)
      for (Index j = i + 1; j < n; ++j)
        variance += (K.entry_standard_error(i, j) * (S.col(i) * b(j, 0) + S.col(j) * b(i, 0))).cwiseAbs2();
    of_solution.add(test::solved(K, rho, m.exitance(0), run.get()) - b, variance,
                    RS.cwiseAbs().rowwise().sum().maxCoeff() * m.load_error);
  }
  of_arriving.expect_as_stated(alpha);
  of_solution.expect_as_stated(alpha);
}

}  // namespace
}  // namespace interflect::fem
