#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "core/error.h"
#include "tests/solvers/six_faces.h"

// What solvers that sample make of bad input and of none, all that are known: the others are held in solvers.cpp.
namespace interflect::solvers {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Fails where anything is drawn: bad input is to be refused before.
class Untouched final : public TransitionSampler, public LineExchanges, public PointTransitions {
 public:
  int dimensions() const override { return 1; }
  std::optional<Index> from_element(Index, std::span<const double>) const override { touched(); }
  const LineExchanges* lines() const override { return this; }
  const PointTransitions* points() const override { return this; }
  int functions() const override { return 1; }
  double area(Index) const override { return 1; }
  Point point_on(Index, std::span<const double>) const override { touched(); }
  std::optional<Point> from_point(const Point&, std::span<const double>) const override { touched(); }
  void functions_at(const Point&, std::span<double>) const override { touched(); }
  double measure() const override { return 1; }
  void along(std::span<const double>, std::vector<Exchange>&) const override { touched(); }

 private:
  [[noreturn]] static void touched() { throw std::logic_error("nothing to draw"); }
};

/// A closed room of unit areas, as all of them can have it.
FullOperator closed_room(Index n, std::uint64_t seed) {
  const FullOperator open = random_operator(n, seed);
  return {open.matrix(), open.matrix().rowwise().sum()};
}

class EverySampler : public testing::TestWithParam<std::string> {
 protected:
  static constexpr Index n = 10;
  System system(const Reflection& R, const ColumnMatrix& e, const TransitionSampler& walks) const {
    return system(K, R, e, walks);
  }
  System system(const FullOperator& of, const Reflection& R, const ColumnMatrix& e,
                const TransitionSampler& walks) const {
    const bool asks = solver_named(GetParam()).needs == SolverEntry::Needs::target;
    return {of, R, e, &walks, asks ? all : std::span<const double>()};
  }
  static SolverReport solve(const System& system, SolverState& state) {
    core::LocalRun run(1, 2);
    StoppingRule rule;
    rule.samples = 32 * n * 20;
    return make_solver(GetParam())->advance(system, state, rule, run);
  }
  /// In one line, with the start as it was.
  static std::string complaint(const System& system, const ColumnMatrix& start) {
    SolverState state{start, 7};
    try {
      solve(system, state);
    } catch (const core::InputError& error) {
      EXPECT_EQ(core::single_line(error.what()), error.what());
      EXPECT_TRUE(state.x.cwiseEqual(start).all() || start.hasNaN());
      EXPECT_EQ(state.step, 7);
      return error.what();
    }
    return {};
  }

  const FullOperator K = closed_room(n, 81);
  const Untouched untouched{};
  const ColumnMatrix good_rho = ColumnMatrix::Constant(n, 2, .5), good_e = ColumnMatrix::Ones(n, 2);
  const std::vector<double> all = std::vector<double>(n, 1);
};

TEST_P(EverySampler, gives_the_answer_0_at_once_where_nothing_emits) {
  const ColumnMatrix dark = ColumnMatrix::Zero(n, 2);
  SolverState state{good_e};
  const SolverReport report = solve(system(Reflection(good_rho), dark, untouched), state);
  EXPECT_EQ(report.why, SolverReport::Stopped::nothing_to_do);
  EXPECT_TRUE(report.converged());
  EXPECT_EQ(report.iterations(), 0);
  EXPECT_EQ(state.x, dark);
}

TEST_P(EverySampler, knows_a_dark_channel_beside_a_lit_one) {
  const MatrixSampler walks(K);
  ColumnMatrix e = random_columns(n, 2, .1, 1, 82);
  e.col(1).setZero();
  SolverState state{good_e};
  EXPECT_TRUE(solve(system(Reflection(good_rho), e, walks), state).converged());
  EXPECT_EQ(state.x.col(1).cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ(state.standard_error.col(1).cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ(state.power_error(1), 0);
  EXPECT_GT(state.x.col(0).minCoeff(), 0);
  EXPECT_GT(state.power_error(0), 0);
}

TEST_P(EverySampler, refuses_what_is_no_reflectance) {
  ColumnMatrix mirrors = good_rho;
  mirrors.col(1).setOnes();
  EXPECT_NE(complaint(system(Reflection(mirrors), good_e, untouched), good_e), "") << "nothing absorbs";
  for (const double bad : {1.1, -.1, 2.0, not_a_number, infinite}) {
    ColumnMatrix rho = good_rho;
    rho(7, 1) = bad;
    const std::string what = complaint(system(Reflection(rho), good_e, untouched), good_e);
    EXPECT_NE(what.find("of unknown 7: 0 <= reflectance <= 1"), std::string::npos) << bad << ": " << what;
  }
}

TEST_P(EverySampler, refuses_what_is_not_a_number) {
  const Reflection R(good_rho);
  for (const double bad : {not_a_number, -infinite}) {
    ColumnMatrix e = good_e;
    e(3, 0) = bad;
    const std::string what = complaint(system(R, e, untouched), good_e);
    EXPECT_NE(what.find("of unknown 3: a finite number expected"), std::string::npos) << bad << ": " << what;
    EXPECT_NE(complaint(system(R, good_e, untouched), e).find("start"), std::string::npos) << bad;
  }
}

TEST_P(EverySampler, refuses_an_element_without_area_in_one_line_that_says_so) {
  for (const double area : {0.0, -1.0, not_a_number, infinite}) {
    Eigen::VectorXd areas = Eigen::VectorXd::Ones(n);
    areas(4) = area;
    const FullOperator without(K.matrix(), areas);
    const std::string what = complaint(system(without, Reflection(good_rho), good_e, untouched), good_e);
    EXPECT_NE(what.find("unknown 4: the area"), std::string::npos) << area << ": " << what;
  }
}

TEST_P(EverySampler, refuses_a_target_that_is_not_a_number) {
  for (const double wrong : {not_a_number, infinite}) {
    std::vector<double> target = all;
    target[3] = wrong;
    const Reflection R(good_rho);
    System asked = system(R, good_e, untouched);
    asked.target = target;
    EXPECT_NE(complaint(asked, good_e).find("target"), std::string::npos);
  }
}

TEST_P(EverySampler, refuses_too_few_replications_to_tell_an_error_by) {
  core::LocalRun run(1, 1);
  for (const int replications : {-1, 0, 9}) {
    SolverState state{good_e};
    SolverSettings settings;
    settings.replications = replications;
    const Reflection R(good_rho);
    EXPECT_THROW(make_solver(GetParam(), settings)->advance(system(R, good_e, untouched), state, {}, run),
                 core::InputError);
  }
}

// A state that was solved for light has nothing left of it when there is none.
TEST_P(EverySampler, forgets_in_the_dark_what_it_has_found) {
  const MatrixSampler walks(K);
  const Reflection R(good_rho);
  SolverState state{good_e};
  solve(system(R, good_e, walks), state);
  ASSERT_GT(state.standard_error.size(), 0);
  const ColumnMatrix nothing = ColumnMatrix::Zero(n, 2);
  EXPECT_EQ(solve(system(R, nothing, walks), state).why, SolverReport::Stopped::nothing_to_do);
  EXPECT_EQ(state.x, nothing);
  EXPECT_EQ(state.standard_error, nothing);
  EXPECT_EQ(state.power_error.norm() + state.target.norm() + state.target_error.norm() + state.residual.norm(), 0);
}

// Of what leaves one unknown the other gets little: who has found nothing of it does not say that nothing is there.
// Within six standard errors by 32 replications, alpha 1e-6 each; and what comes back, F² / 4 of it, may be missed.
TEST_P(EverySampler, looks_on_for_light_that_is_seldom_found) {
  using Needs = SolverEntry::Needs;
  const Needs needs = solver_named(GetParam()).needs;
  if (needs == Needs::target || needs == Needs::closed_room) GTEST_SKIP() << "an open room without a target";
  for (const double F : {1e-3, 1e-5}) {
    Eigen::MatrixXd exchange(2, 2);
    exchange << 0, F, F, 0;
    const FullOperator rare(exchange, Eigen::VectorXd::Ones(2));
    const MatrixSampler walks(rare);
    const ColumnMatrix rho = ColumnMatrix::Constant(2, 1, .5);
    ColumnMatrix e(2, 1);
    e << 1, 0;
    const Reflection R(rho);
    SolverState state{e};
    core::LocalRun run(1, 2);
    StoppingRule rule;
    rule.noise = .2;
    const SolverReport report = make_solver(GetParam())->advance({rare, R, e, &walks}, state, rule, run);
    EXPECT_TRUE(report.converged());
    const double exact = by_elimination(rare, rho, e)(1, 0);
    EXPECT_NEAR(state.x(1, 0), exact, 6 * state.standard_error(1, 0) + 1e-6 * exact) << F;
  }
}

INSTANTIATE_TEST_SUITE_P(All, EverySampler, testing::ValuesIn(solver_names(true)), [](const auto& which) {
  std::string name = which.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace interflect::solvers
