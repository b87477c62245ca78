#include "solvers/random_walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/error.h"
#include "core/student_t.h"
#include "solvers/constant_control_variate.h"
#include "solvers/power_draw.h"
#include "solvers/ray_transfer.h"
#include "solvers/replications.h"
#include "tests/solvers/six_faces.h"

namespace interflect::solvers {
namespace {

struct Known {
  const char* solver;
  double variance[6];  ///< of a walk
};
constexpr Known known[] = {
    {"shooting-absorption", {.12057815, .69700518, 1.35068421, 2.50314136, 3.96801271, 6.41682538}},
    {"shooting-survival", {.71272076, 1.37836977, 1.68789528, 1.98044023, 1.95892863, 1.83746594}},
    {"shooting-collision", {.09895881, .4300906, .69177367, 1.01915989, 1.25512669, 1.40703791}},
    {"gathering-absorption", {.30740001, 1.19186259, 1.83394193, 2.60143518, 3.36852484, 2.66840062}},
    {"gathering-survival", {.11673245, .4574165, .70732368, 1.00805244, 1.24984307, 1.27945811}},
    {"gathering-collision", {.0774426, .30607307, .47516741, .67971247, .89362808, .88827224}},
};

/// Of 5 000 repetitions of 64 walks: means, and variances of a walk.
struct Sampled {
  ColumnMatrix x, variance;
};
constexpr int repetitions = 5000, walks_each = 64;
Sampled sampled(const std::string& name, const System& system) {
  SolverSettings settings;
  settings.replications = repetitions;
  StoppingRule rule;
  const bool gathers = name.rfind("gathering", 0) == 0;
  rule.samples = static_cast<std::uint64_t>(repetitions * walks_each * (gathers ? system.e.rows() : 1));
  core::LocalRun run(5, 2);
  SolverState state{system.e};
  EXPECT_TRUE(make_solver(name, settings)->advance(system, state, rule, run).converged());
  return {state.x, state.standard_error.cwiseAbs2() * repetitions * walks_each};
}

// Means within 4.5 standard errors.  A variance by 5 000 repetitions, whose sums of 64 walks are nearly normal, is off
// by sqrt(2 / 5000) = 2 %, somewhat more where scores are rare: 10 % are five of those. Each two scores differ by
// more in some face.
TEST(RandomWalks, have_the_variances_that_are_known) {
  const SixFaces cube;
  for (const Known& of : known) {
    const Sampled found = sampled(of.solver, cube.system());
    for (Index i = 0; i < 6; ++i) {
      const double variance = of.variance[i];
      EXPECT_NEAR(found.x(i, 0), radiosity[i], 4.5 * std::sqrt(variance / (repetitions * walks_each)))
          << of.solver << ' ' << i;
      EXPECT_NEAR(found.variance(i, 0) / variance, 1, .1) << of.solver << ' ' << i;
    }
    for (const Known& other : known) {  // a score in place of another would be seen
      if (other.solver == of.solver) continue;
      double furthest = 0;
      for (Index i = 0; i < 6; ++i)
        furthest = std::max(furthest, std::abs(found.variance(i, 0) / other.variance[i] - 1));
      EXPECT_GT(furthest, .1) << of.solver << " for " << other.solver;
    }
  }
}

/// Scores that an unknown can expect of a walk: hits, times the chance of going on or ending there.
double expected_scores(const std::string& name, const FullOperator& K, const ColumnMatrix& rho, const ColumnMatrix& e,
                       const ColumnMatrix& exact, Index i) {
  double hits = 0, reflected = 0;
  const Eigen::Map<const Eigen::VectorXd> G(K.gram().data(), e.rows());
  for (Index c = 0; c < e.cols(); ++c) {
    hits += G(i) * (exact(i, c) - e(i, c)) / rho(i, c) / G.dot(e.col(c)) / static_cast<double>(e.cols());
    reflected += rho(i, c) / static_cast<double>(e.cols());
  }
  return hits * (name == "shooting-survival" ? reflected : name == "shooting-absorption" ? 1 - reflected : 1);
}

/// Unequal areas, several columns with reflectances of their own, and all unknowns for a target.
struct Unequal {
  static constexpr Index n = 12;
  explicit Unequal(FullOperator of)
      : K(std::move(of)),
        walks(K),
        rho(random_columns(n, 2, .1, .9, 72)),
        e(random_columns(n, 2, 0, 1, 73)),
        R(rho),
        exact(by_elimination(K, rho, e)) {}
  Unequal(const Unequal&) = delete;
  Unequal& operator=(const Unequal&) = delete;
  System system() const { return {K, R, e, &walks}; }
  System asked() const { return {K, R, e, &walks, all}; }

  FullOperator K;
  MatrixSampler walks;
  ColumnMatrix rho, e;
  Reflection R;
  ColumnMatrix exact;
  std::vector<double> all = std::vector<double>(n, 1);
};
FullOperator an_open_room() { return random_operator(Unequal::n, 71); }
FullOperator a_closed_room() {
  const FullOperator open = an_open_room();
  return {open.matrix(), open.matrix().rowwise().sum()};
}

bool gathers(const std::string& solver) { return solver.rfind("gathering", 0) == 0; }

/// Unknowns that can expect 30 scores of so many walks that shoot: of those that gather, all.
std::vector<Index> often_scored(const std::string& solver, const Unequal& room, double walks) {
  std::vector<Index> often;
  for (Index i = 0; i < Unequal::n; ++i)
    if (gathers(solver) || walks * expected_scores(solver, room.K, room.rho, room.e, room.exact, i) >= 30)
      often.push_back(i);
  return often;
}

/// Those that can expect 30 hits of the rays of a first bounce, which bring what differs from the constant: later
/// bounces have more.
std::vector<Index> often_hit(const Unequal& room, double rays) {
  const ColumnMatrix power = power_of(room.K.gram(), room.e);
  const System system = room.system();
  const Eigen::RowVectorXd beta = ConstantControlVariate(system, power, ray_transfer(system)).constant();
  const Eigen::Map<const Eigen::VectorXd> G(room.K.gram().data(), Unequal::n);
  const ColumnMatrix left = (power - G * beta).cwiseAbs();
  const Eigen::RowVectorXd sizes = left.colwise().sum();
  Eigen::VectorXd sent = Eigen::VectorXd::Zero(Unequal::n);  // the share of rays that each sends
  for (Index c = 0; c < left.cols(); ++c) sent += left.col(c) / (sizes(c) * static_cast<double>(left.cols()));
  const Eigen::VectorXd hits = rays * room.K.matrix() * sent.cwiseQuotient(G);
  std::vector<Index> often;
  for (Index i = 0; i < Unequal::n; ++i)
    if (hits(i) >= 30) often.push_back(i);
  return often;
}

/// How many of 200 runs hold the truth in 95 % intervals of unknowns, pooled over those and the columns.
/// @param least  draws that each run must have taken at least
double held_of_200(const RadiositySolver& solver, const System& system, const StoppingRule& rule,
                   const ColumnMatrix& exact, const std::vector<Index>& of, double least = 0) {
  const double t = core::student_t(.95, 31);
  double held = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    core::LocalRun run(seed, 2);
    SolverState state{system.e};
    const SolverReport report = solver.advance(system, state, rule, run);
    EXPECT_TRUE(report.converged()) << solver.name();
    EXPECT_GE(report.rows(), least) << solver.name() << ' ' << seed;
    for (const Index a : of)
      for (Index c = 0; c < exact.cols(); ++c)
        held += std::abs(state.x(a, c) - exact(a, c)) <= t * state.standard_error(a, c) ? 1 : 0;
  }
  return held / static_cast<double>(of.size()) / static_cast<double>(exact.cols());
}

constexpr std::uint64_t some_walks = 32 * 400, some_that_gather = 32 * 12 * 40;

/// Of so many walks a run.
StoppingRule some(const std::string& solver) {
  StoppingRule rule;
  rule.samples = gathers(solver) ? some_that_gather : some_walks;
  return rule;
}

// Means within what is stated, in an open room and in a closed one: of 200 runs 95 % intervals hold the truth in
// 181 .. 197, pooled over unknowns that can expect 30 scores.
TEST(RandomWalks, state_their_errors) {
  const Unequal open(an_open_room());
  using Needs = SolverEntry::Needs;
  for (const std::string& name : solver_names({Needs::walks, Needs::lines, Needs::points, Needs::target})) {
    const std::vector<Index> often = often_scored(name, open, some_walks);
    EXPECT_GE(often.size(), 4u) << name;
    const double held = held_of_200(*make_solver(name), open.asked(), some(name), open.exact, often);
    EXPECT_GE(held, 181) << name;
    EXPECT_LE(held, 197) << name;
  }
  const Unequal closed(a_closed_room());
  for (const std::string& name : solver_names({Needs::closed_room})) {
    const std::vector<Index> often = often_hit(closed, some_walks);
    EXPECT_GE(often.size(), 4u) << name;
    const double held = held_of_200(*make_solver(name), closed.system(), some(name), closed.exact, often);
    EXPECT_GE(held, 181) << name;
    EXPECT_LE(held, 197) << name;
  }
}

constexpr const char* a_few[] = {"stochastic-jacobi", "shooting-collision", "stochastic-ray", "gathering-absorption"};

// Points that know of each other: replications do not.
TEST(RandomWalks, state_their_errors_by_evenly_spread_numbers) {
  const Unequal room(an_open_room());
  SolverSettings settings;
  settings.sequence = "sobol";
  for (const std::string name : a_few) {
    const std::vector<Index> often = often_scored(name, room, some_walks);
    const double held = held_of_200(*make_solver(name, settings), room.system(), some(name), room.exact, often);
    EXPECT_GE(held, 181) << name;
    EXPECT_LE(held, 197) << name;
  }
}

// Who stops where noise seems small stops a little too soon where it seems smaller than it is.
TEST(RandomWalks, state_their_errors_where_these_end_them) {
  const Unequal room(an_open_room());
  StoppingRule rule;
  rule.noise = .02;
  for (const std::string name : a_few) {
    const std::vector<Index> often = often_scored(name, room, some_walks);
    const double held =
        held_of_200(*make_solver(name), room.system(), rule, room.exact, often, gathers(name) ? 0 : some_walks);
    EXPECT_GE(held, 181) << name;
    EXPECT_LE(held, 197) << name;
  }
}

TEST(RandomWalks, go_on_until_their_noise_is_small) {
  const SixFaces cube;
  for (const SolverEntry& solver : known_solvers()) {
    if (!solver.samples()) continue;
    core::LocalRun run(3, 2);
    SolverState state{cube.e};
    StoppingRule rule;
    rule.noise = 5e-3;
    const SolverReport report = solver.make({})->advance(cube.system(solver), state, rule, run);
    EXPECT_TRUE(report.converged());
    EXPECT_LE(report.residual(), 5e-3);
    EXPECT_GT(report.rows(), 1000);
    for (Index i = 0; i < 6; ++i)
      EXPECT_NEAR(state.x(i, 0), radiosity[i], 5 * state.standard_error(i, 0)) << solver.name;
  }
}

TEST(RandomWalks, are_the_same_for_any_number_of_threads) {
  const SixFaces cube;
  for (const SolverEntry& solver : known_solvers())
    for (const char* sequence : {"independent", "sobol"}) {
      if (!solver.samples()) continue;
      SolverSettings settings;
      settings.sequence = sequence;
      StoppingRule rule;
      rule.samples = 32 * 6 * 20;
      ColumnMatrix first;
      for (const unsigned threads : {1u, 2u, 3u, 8u}) {
        core::LocalRun run(4, threads);
        SolverState state{cube.e};
        solver.make(settings)->advance(cube.system(solver), state, rule, run);
        if (first.size() == 0) first = state.x;
        EXPECT_EQ(state.x, first) << solver.name << ' ' << threads;
      }
    }
}

// More walks in a replication than are walked at once, over several rounds, and all that is said of them.
TEST(RandomWalks, are_the_same_for_any_number_of_threads_where_they_are_many) {
  const Index n = 96;
  const FullOperator open = random_operator(n, 74), K(open.matrix(), open.matrix().rowwise().sum());
  const MatrixSampler walks(K);
  const Reflection R(random_columns(n, 3, .1, .9, 75));
  const ColumnMatrix e = random_columns(n, 3, 0, 1, 76);
  const std::vector<double> all(n, 1);
  for (const SolverEntry& solver : known_solvers())
    for (const char* sequence : {"independent", "sobol"}) {
      const bool spread = sequence == std::string("sobol");
      if (!solver.samples() ||
          (spread && std::find(std::begin(a_few), std::end(a_few), solver.name) == std::end(a_few)))
        continue;
      SolverSettings settings;
      settings.sequence = sequence;
      StoppingRule rule;
      rule.samples = 32 * 2500;
      const bool asks = solver.needs == SolverEntry::Needs::target;
      const auto solve = [&](unsigned threads) {
        core::LocalRun run(4, threads);
        SolverState state{e};
        const System system{K, R, e, &walks, asks ? all : std::span<const double>()};
        const SolverReport report = solver.make(settings)->advance(system, state, rule, run);
        return std::pair(state, report.history);
      };
      const auto [one, history] = solve(1);
      EXPECT_GT(history.size(), 1u) << solver.name;
      for (const unsigned threads : {2u, 3u, 8u}) {
        const auto [several, of_several] = solve(threads);
        EXPECT_EQ(several.x, one.x) << solver.name << ' ' << sequence << ' ' << threads;
        EXPECT_EQ(several.standard_error, one.standard_error) << solver.name << ' ' << sequence << ' ' << threads;
        EXPECT_EQ(several.power_error, one.power_error) << solver.name << ' ' << sequence << ' ' << threads;
        EXPECT_EQ(several.target, one.target) << solver.name << ' ' << sequence << ' ' << threads;
        EXPECT_EQ(several.target_error, one.target_error) << solver.name << ' ' << sequence << ' ' << threads;
        EXPECT_EQ(of_several, history) << solver.name << ' ' << sequence << ' ' << threads;
      }
    }
}

TEST(RandomWalks, refuse_what_they_cannot_answer) {
  SixFaces cube;
  core::LocalRun run;
  const auto complaint = [&](const std::string& name, const System& system) {
    SolverState state{system.e};
    try {
      make_solver(name)->advance(system, state, {}, run);
    } catch (const core::InputError& error) {
      EXPECT_EQ(core::single_line(error.what()), error.what());
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(complaint("shooting-collision", {cube.K, *cube.R, cube.e}).find("rays"), std::string::npos);
  cube.rho(4, 0) = 0;
  EXPECT_NE(complaint("gathering-survival", {cube.K, Reflection(cube.rho), cube.e, &cube.walks}).find("source"),
            std::string::npos);
  cube.rho(4, 0) = 1;
  EXPECT_NE(complaint("shooting-absorption", {cube.K, Reflection(cube.rho), cube.e, &cube.walks}).find("absorbs"),
            std::string::npos);
  SolverSettings few;
  few.replications = 5;
  SolverState state{cube.e};
  EXPECT_THROW(make_solver("shooting-collision", few)->advance({cube.K, *cube.R, cube.e, &cube.walks}, state, {}, run),
               core::InputError);
}

TEST(StudentT, is_what_tables_have) {
  EXPECT_NEAR(core::student_t(.95, 1), 12.7062047, 1e-6);
  EXPECT_NEAR(core::student_t(.95, 2), 4.30265273, 1e-7);
  EXPECT_NEAR(core::student_t(.95, 9), 2.26215716, 1e-7);
  EXPECT_NEAR(core::student_t(.99, 31), 2.74404192, 1e-6);
  EXPECT_NEAR(core::student_t(.95, 10000), 1.96020126, 1e-6);
}

}  // namespace
}  // namespace interflect::solvers
