#include "fem/operator/rows_on_demand.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "fem/radiosity_operator.h"
#include "mesh/uniform.h"
#include "solvers/jacobi.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

using solvers::ColumnMatrix;
using test::Room;

/// A box that is not a cube, with a body in it that hides.
scene::Scene furnished() {
  Room room;
  room.box({0, 0, 0}, {3, 2, 1.5}, 1, true, .5, .3);
  room.box({1, .4, .2}, {.5, .7, .4}, 1, false, .7);
  return room.finish();
}

struct Made {
  explicit Made(const std::string& method, unsigned threads = 2)
      : mesh(mesh::uniform(scene, .9)), rays(raycast::make_ray_caster("embree", scene)), run(3, threads) {
    settings.form_factors = method;
    settings.resolution = 64;
    of = make_form_factor_method(method, form_factor_context(scene, mesh.patches(), *rays, settings, 3));
  }
  scene::Scene scene = furnished();
  mesh::ElementMesh mesh;
  std::unique_ptr<raycast::RayCaster> rays;
  core::LocalRun run;
  RadiositySettings settings;
  std::unique_ptr<FormFactorMethod> of;
};

ColumnMatrix all_columns(const RowsOnDemand& K) {
  ColumnMatrix columns(K.layout().unknowns(), K.layout().unknowns());
  K.columns()->rows(0, columns.rows(), columns);
  return columns;
}

// To the bit, for any method that goes by pairs, with rays and without.
TEST(RowsOnDemand, are_those_of_the_matrix) {
  for (const char* method : {"analytic", "gauss-lambert", "area-to-area"}) {
    Made made(method);
    const RowsOnDemand K(made.mesh.patches(), *made.of, made.run.get());
    const RadiosityOperator stored =
        assemble_operator(made.scene, made.mesh.patches(), *made.rays, made.settings, made.run.get());
    ASSERT_TRUE(K.symmetric());
    const ColumnMatrix rows = all_columns(K);
    for (Index a = 0; a < rows.rows(); ++a)
      for (Index b = 0; b < rows.rows(); ++b) ASSERT_EQ(rows(a, b), stored.K->entry(a, b)) << method;
    ColumnMatrix one(1, rows.cols());
    K.rows(7, 1, one);
    EXPECT_EQ(K.last().of, 7);
    for (Index b = 0; b < rows.cols(); ++b)
      EXPECT_FLOAT_EQ(static_cast<float>(K.last().standard_error[std::size_t(b)]),
                      static_cast<float>(stored.K->entry_standard_error(7, b)));
    EXPECT_EQ(K.evaluated(), rows.rows() + 1);
  }
}

// Of a method that looks from one element, a column is what that element sends.
TEST(RowsOnDemand, are_views_where_a_method_has_those) {
  Made made("hemicube");
  const RowsOnDemand K(made.mesh.patches(), *made.of, made.run.get());
  EXPECT_FALSE(K.symmetric());
  EXPECT_EQ(K.rows(), nullptr);
  const ColumnMatrix columns = all_columns(K);
  for (Index i = 0; i < columns.rows(); ++i)
    EXPECT_NEAR(columns.row(i).sum() / K.gram()[std::size_t(i)], 1, .02) << "what leaves arrives: the box is closed";
}

TEST(RowsOnDemand, have_a_product) {
  for (const char* method : {"analytic", "hemicube"}) {
    Made made(method);
    const RowsOnDemand K(made.mesh.patches(), *made.of, made.run.get());
    const ColumnMatrix columns = all_columns(K);
    ColumnMatrix b = ColumnMatrix::Random(columns.rows(), 2), out(b.rows(), 2);
    b.row(3).setZero();
    const Index before = K.evaluated();
    K.apply(b, out, made.run.get());
    EXPECT_EQ(K.evaluated() - before, columns.rows() - 1) << "what is dark sends nothing";
    EXPECT_LT((out - columns.transpose() * b).cwiseAbs().maxCoeff(), 1e-14 * out.cwiseAbs().maxCoeff());
  }
}

TEST(RowsOnDemand, are_the_same_for_any_number_of_threads) {
  Made alone("gauss-lambert", 1), many("gauss-lambert", 8);
  const RowsOnDemand one(alone.mesh.patches(), *alone.of, alone.run.get()),
      eight(many.mesh.patches(), *many.of, many.run.get());
  EXPECT_EQ(all_columns(one), all_columns(eight));
}

// Gauss-Seidel asks for rows from many threads at once, and Jacobi for products.
TEST(RowsOnDemand, serve_every_deterministic_solver) {
  Made made("analytic", 8);
  const RowsOnDemand K(made.mesh.patches(), *made.of, made.run.get());
  const Index n = K.layout().unknowns();
  const ColumnMatrix e = ColumnMatrix::Ones(n, 1), rho = ColumnMatrix::Constant(n, 1, .4);
  const solvers::Reflection R(rho);
  ColumnMatrix first;
  for (const char* name : {"automatic", "jacobi", "gauss-seidel", "southwell", "progressive"}) {
    solvers::SolverState state{e};
    const auto report = solvers::make_solver(name)->advance({K, R, e}, state, {1e-9, 300}, made.run.get());
    EXPECT_TRUE(report.converged()) << name;
    if (first.size() == 0) first = state.x;
    EXPECT_LT((state.x - first).cwiseAbs().maxCoeff(), 1e-8) << name;
  }
}

TEST(RowsOnDemand, refuse_what_comes_all_at_once) {
  Made made("global-lines");
  EXPECT_THROW(RowsOnDemand(made.mesh.patches(), *made.of, made.run.get()), core::InputError);
}

}  // namespace
}  // namespace interflect::fem
