#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/error.h"
#include "fem/closure.h"
#include "fem/closure_law.h"
#include "solvers/solver.h"
#include "tests/fem/operator_fixtures.h"

using namespace interflect;
using namespace interflect::fem;

namespace {

constexpr double anything = 1e9;

/// A matrix to repair, with the variances that the repair gives its entries.
struct Problem {
  OperatorPair pair;
  EnvironmentColumn environment;  ///< empty: closed
  Eigen::MatrixXd w;              ///< [m^4]
  Eigen::VectorXd Z, v;           ///< of the environment [m², m^4]
};

/// Entries off by up to `amount`, relative; some known to a standard error only, which lets them reach 0 where `amount`
/// is large; areas over up to two decades times `area`; with an environment that takes up to `open` of an element,
/// known to 0.02.
Problem problem(Index n, double amount, std::uint64_t seed, double open = 0, double area = 1) {
  const double decades = n < 20 ? 0.5 : 2;  // one of a few elements must not be larger than all it may see
  Problem p{random_pair(n, seed, decades, open == 0, true),
            {},
            Eigen::MatrixXd::Zero(n, n),
            Eigen::VectorXd::Zero(n),
            Eigen::VectorXd::Zero(n)};
  core::RandomNumbers random(seed, 3, 0);
  p.pair.areas *= area;
  std::vector<double> areas(p.pair.areas.begin(), p.pair.areas.end());
  p.pair.K = std::make_unique<DenseSymmetric>(areas);
  for (Index a = 0; a < n; ++a)
    for (Index b = a; b < n; ++b) {
      const double K = p.pair.full(a, b) * area * (1 + amount * (2 * random.next() - 1));
      const double error =
          random.next() < 0.3 ? static_cast<double>(static_cast<float>((amount < 0.5 ? 0.1 : 2) * K)) : 0.0;
      p.pair.full(a, b) = p.pair.full(b, a) = K;
      p.pair.errors(a, b) = p.pair.errors(b, a) = error;
      p.pair.K->add(a, b, {K, error});
    }
  core::LocalRun run(1, 1);
  const std::vector<double> sums = p.pair.K->row_sums(run);
  std::vector<double> seen;  // that rows are off by, beyond the environment's noise
  for (Index a = 0; a < n; ++a) {
    const double sum = sums[static_cast<std::size_t>(a)];
    if (open == 0) {
      seen.push_back(std::abs(1 - sum));
      continue;
    }
    const double factor = std::clamp(1 - sum + 0.04 * (random.next() - 0.5), 0.0, 1.0), error = 0.02;
    p.environment.factor.push_back(factor);
    p.environment.standard_error.push_back(error);
    seen.push_back(std::max(0.0, std::abs(1 - sum - factor) - 3 * error));
    p.Z(a) = factor * p.pair.areas(a);
    p.v(a) = std::pow(error * p.pair.areas(a), 2);
  }
  const EntryVariances variances = entry_variances(*p.pair.K, {}, seen, sums, run.get());
  for (Index a = 0; a < n; ++a)
    for (Index b = 0; b < n; ++b)
      p.w(a, b) = variances(
          {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), p.pair.full(a, b), p.pair.errors(a, b)});
  return p;
}

ClosureSettings least_squares(const Problem& p) {
  ClosureSettings settings;
  settings.method = "least-squares";
  settings.largest_row_error = settings.largest_correction = anything;
  if (!p.environment.factor.empty()) settings.environment = &p.environment;
  return settings;
}

/// The smallest change by Dykstra's alternating projections [Boyle, Dykstra 1986], in the norm of 1 / w: slow, and
/// nothing like the method under test.  Unknowns are the pairs a <= b with K > 0, and the environment's.
struct Reference {
  Eigen::MatrixXd K;
  Eigen::VectorXd z;
};
Reference by_alternating_projections(const Problem& p, int rounds) {
  const Index n = p.pair.areas.size();
  std::vector<std::pair<Index, Index>> unknowns;
  for (Index a = 0; a < n; ++a)
    for (Index b = a; b < n; ++b)
      if (p.pair.full(a, b) > 0) unknowns.emplace_back(a, b);
  const bool open = !p.environment.factor.empty();
  const auto pairs = static_cast<Index>(unknowns.size()), m = pairs + (open ? n : 0);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(n, m);
  Eigen::VectorXd x(m), variance(m), most(m);
  for (Index k = 0; k < pairs; ++k) {
    const auto [a, b] = unknowns[static_cast<std::size_t>(k)];
    rows(a, k) = rows(b, k) = 1;
    x(k) = p.pair.full(a, b);
    variance(k) = a == b ? 2 * p.w(a, b) : p.w(a, b);  // one term of the measure on the diagonal, two elsewhere
    most(k) = std::min(p.pair.areas(a), p.pair.areas(b));
  }
  for (Index a = 0; open && a < n; ++a) {
    rows(a, pairs + a) = 1;
    x(pairs + a) = p.Z(a);
    variance(pairs + a) = p.v(a);
    most(pairs + a) = p.pair.areas(a);
  }
  const Eigen::MatrixXd back = variance.asDiagonal() * rows.transpose();
  const Eigen::LDLT<Eigen::MatrixXd> normal(rows * back);
  Eigen::VectorXd of_box = Eigen::VectorXd::Zero(m);  // Dykstra's increment; a plane needs none
  for (int round = 0; round < rounds; ++round) {
    x += back * normal.solve(p.pair.areas - rows * x);
    const Eigen::VectorXd before = x + of_box;
    x = before.cwiseMax(0).cwiseMin(most);
    of_box = before - x;
  }
  Reference out{Eigen::MatrixXd::Zero(n, n), x.tail(m - pairs)};
  for (Index k = 0; k < pairs; ++k) {
    const auto [a, b] = unknowns[static_cast<std::size_t>(k)];
    out.K(a, b) = out.K(b, a) = x(k);
  }
  return out;
}

}  // namespace

// Relative changes of up to 2 are wanted, so that entries end at 0: the bounds are what this is about.
TEST(ClosureLeastSquares, is_the_smallest_change_that_alternating_projections_find) {
  core::LocalRun run(1, 2);
  Index at_bounds = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    for (const double amount : {0.01, 0.9}) {
      Problem p = problem(9, amount, seed);
      const Reference reference = by_alternating_projections(p, 200'000);
      const ClosureReport report = restore_closure(*p.pair.K, run, least_squares(p));
      EXPECT_TRUE(report.converged) << seed;
      const Eigen::MatrixXd K = full(*p.pair.K);
      at_bounds += ((K.array() == 0) && (p.pair.full.array() > 0)).count();
      EXPECT_LE((K - reference.K).cwiseAbs().maxCoeff(), 1e-8 * p.pair.areas.maxCoeff()) << seed << " " << amount;
    }
  EXPECT_GT(at_bounds, 0);
}

TEST(ClosureLeastSquares, with_an_environment_is_the_smallest_change_of_both) {
  core::LocalRun run(1, 2);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Problem p = problem(9, 0.05, seed, 0.5);
    const Reference reference = by_alternating_projections(p, 200'000);
    const ClosureReport report = restore_closure(*p.pair.K, run, least_squares(p));
    EXPECT_TRUE(report.converged) << seed;
    EXPECT_LE((full(*p.pair.K) - reference.K).cwiseAbs().maxCoeff(), 1e-8 * p.pair.areas.maxCoeff()) << seed;
    for (Index a = 0; a < 9; ++a)
      EXPECT_NEAR(report.environment[static_cast<std::size_t>(a)] * p.pair.areas(a), reference.z(a),
                  1e-8 * p.pair.areas.maxCoeff());
  }
}

// Karush, Kuhn and Tucker: g_ab = (K' - K) / w - lambda_a - lambda_b is 0 inside the bounds, >= 0 at 0 and <= 0 at
// min(A_a, A_b).  Multipliers are those that fit the entries inside best.
TEST(ClosureLeastSquares, meets_the_conditions_of_a_minimum) {
  core::LocalRun run(1, 2);
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Index n = 60;
    Problem p = problem(n, 0.9, seed);
    ASSERT_TRUE(restore_closure(*p.pair.K, run, least_squares(p)).converged);
    const Eigen::MatrixXd K = full(*p.pair.K);
    EXPECT_EQ(K, K.transpose());
    const Eigen::VectorXd sums = K.rowwise().sum();
    EXPECT_LE((sums.array() / p.pair.areas.array() - 1).abs().maxCoeff(), 1e-13);
    EXPECT_TRUE(((K.array() > 0) <= (p.pair.full.array() > 0)).all()) << "zeros stay zero";
    const auto most = [&](Index a, Index b) { return std::min(p.pair.areas(a), p.pair.areas(b)); };
    const auto inside = [&](Index a, Index b) { return K(a, b) > 0 && K(a, b) < most(a, b); };
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
    for (Index a = 0; a < n; ++a)
      for (Index b = 0; b < n; ++b)
        if (inside(a, b)) {  // least squares of K' - K = w (lambda_a + lambda_b), weighted with 1 / w
          normal(a, a) += p.w(a, b);
          normal(a, b) += p.w(a, b);
          right(a) += K(a, b) - p.pair.full(a, b);
        }
    const Eigen::VectorXd lambda = normal.ldlt().solve(right);
    Index at_zero = 0;
    for (Index a = 0; a < n; ++a)
      for (Index b = a; b < n; ++b) {
        if (p.pair.full(a, b) == 0) continue;
        const double wanted = p.pair.full(a, b) + p.w(a, b) * (lambda(a) + lambda(b)), rounding = 1e-9 * most(a, b);
        EXPECT_GE(K(a, b), 0);
        EXPECT_LE(K(a, b), most(a, b));
        if (inside(a, b)) {
          EXPECT_NEAR(K(a, b), wanted, rounding);
        } else if (K(a, b) == 0) {
          EXPECT_LE(wanted, rounding);
          ++at_zero;
        } else {
          EXPECT_GE(wanted, most(a, b) - rounding);
        }
      }
    EXPECT_GT(at_zero, 0) << "no bound was met, none was tested";
  }
}

// An element sees the other through one pair only, which would have to be larger than the smaller area; the second pair
// takes the rest.
TEST(ClosureLeastSquares, keeps_entries_below_the_smaller_area) {
  core::LocalRun run(1, 1);
  DenseSymmetric K({1, 1.5, 1.5});
  K.add(0, 1, {0.9, 0.5});
  K.add(0, 2, {0.05, 1e-3});
  K.add(1, 2, {0.6, 0.1});
  ClosureSettings settings;
  settings.method = "least-squares";
  settings.largest_row_error = settings.largest_correction = anything;
  restore_closure(K, run, settings);
  for (const double sum : K.row_sums(run)) EXPECT_NEAR(sum, 1, 1e-13);
  EXPECT_LE(K.entry(0, 1), 1);  // (0, 1) and (0, 2) must be 1/2 each: three rows determine three pairs
  EXPECT_NEAR(K.entry(0, 1), 0.5, 1e-12);
  EXPECT_NEAR(K.entry(1, 2), 1, 1e-12);
}

// F does not depend on the unit of length; bit by bit for powers of two.  Otherwise standard errors, kept as floats,
// are rounded otherwise: weights change by 2^-23, and corrections, below 0.1, by as much of them.
TEST(ClosureRepairs, do_not_depend_on_the_scale) {
  core::LocalRun run(1, 1);
  for (const std::string& method : closure_names())
    for (const double open : {0.0, 0.5}) {
      const auto form_factors = [&](double scale) {
        Problem p = problem(80, 0.05, 21, open, scale * scale);
        ClosureSettings settings = least_squares(p);
        settings.method = method;
        EXPECT_TRUE(restore_closure(*p.pair.K, run, settings).converged) << method << " " << scale;
        const Eigen::MatrixXd K = full(*p.pair.K);
        return Eigen::MatrixXd(p.pair.areas.cwiseInverse().asDiagonal() * K);
      };
      const Eigen::MatrixXd F = form_factors(1);
      EXPECT_EQ(form_factors(0x1p-20), F) << method;
      for (const double scale : {1e-6, 1e6})
        EXPECT_LE((form_factors(scale) - F).cwiseAbs().maxCoeff(), 0.1 * 0x1p-23) << method << " " << scale;
    }
}

TEST(ClosureRepairs, are_the_same_on_either_operator_and_for_any_number_of_threads) {
  for (const std::string& method : closure_names()) {
    Eigen::MatrixXd first;
    for (const unsigned threads : {1u, 3u}) {
      core::LocalRun run(1, threads);
      Problem p = problem(300, 0.02, 22);
      ClosureSettings settings = least_squares(p);
      settings.method = method;
      const auto packed = sparse(p.pair, 0, run.get());
      restore_closure(*p.pair.K, run, settings);
      EXPECT_TRUE(restore_closure(*packed, run, settings).converged);
      const Eigen::MatrixXd K = full(*p.pair.K);
      EXPECT_LE((full(*packed) - K).norm(), 1e-12 * K.norm()) << method;
      if (threads == 1) first = K;
      EXPECT_EQ(K, first) << method;
    }
  }
}

TEST(ClosureRepairs, bring_a_perturbed_furnace_back_to_1_dense_or_with_entries_dropped) {
  core::LocalRun run(1, 2);
  const Index n = 200;
  for (const std::string& method : closure_names())
    for (const double drop_below : {0.0, 1e-3}) {
      Problem p = problem(n, 0.05, 8);
      std::unique_ptr<SymmetricOperator> K = std::move(p.pair.K);
      if (drop_below > 0) K = sparse(p.pair, drop_below, run.get());
      ClosureSettings settings;
      settings.method = method;
      restore_closure(*K, run, settings);
      const solvers::ColumnMatrix rho = solvers::ColumnMatrix::Constant(n, 1, 0.95),
                                  e = solvers::ColumnMatrix::Constant(n, 1, 0.05);
      solvers::SolverState state;
      EXPECT_TRUE(solvers::make_solver("gauss-seidel")
                      ->advance({*K, solvers::Reflection(rho), e}, state, {1e-13, 10000}, run)
                      .converged());
      EXPECT_LE((state.x.array() - 1).abs().maxCoeff(), 1e-10) << method << " " << drop_below;
    }
}

// With noise of known size in some entries alone, least squares moves these and brings K nearer to what it was;
// scaling, which does not know them, moves all.
TEST(ClosureLeastSquares, finds_what_noise_of_a_known_size_has_done) {
  core::LocalRun run(1, 2);
  const Index n = 150;
  double before = 0, by_least_squares = 0, by_scaling = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const OperatorPair exact = random_pair(n, seed, 1, true, true);
    core::RandomNumbers random(seed, 4, 0);
    Eigen::MatrixXd off = exact.full;
    std::unique_ptr<DenseSymmetric> K[2];
    for (auto& k : K) k = std::make_unique<DenseSymmetric>(std::vector<double>(exact.areas.begin(), exact.areas.end()));
    for (Index a = 0; a < n; ++a)
      for (Index b = a; b < n; ++b) {
        const double error = random.next() < 0.02 ? 0.3 * exact.full(a, b) : 0.0;
        off(a, b) = off(b, a) = exact.full(a, b) + std::sqrt(3.0) * error * (2 * random.next() - 1);
        for (auto& k : K) k->add(a, b, {off(a, b), error});
      }
    restore_closure(*K[0], run, {.method = "least-squares"});
    restore_closure(*K[1], run, {.method = "scaling"});
    before += (off - exact.full).norm();
    by_least_squares += (full(*K[0]) - exact.full).norm();
    by_scaling += (full(*K[1]) - exact.full).norm();
  }
  EXPECT_LT(by_least_squares, 0.8 * before);
  EXPECT_LT(by_least_squares, 0.85 * by_scaling);
}

TEST(ClosureRepairs, of_an_open_scene_refuse_in_one_line_what_errors_do_not_explain) {
  core::LocalRun run(1, 1);
  for (const std::string& method : closure_names()) {
    Problem p = problem(60, 1e-3, 23, 0.5);
    ClosureSettings settings;
    settings.method = method;
    settings.environment = &p.environment;
    EXPECT_NO_THROW(restore_closure(*p.pair.K, run, settings));
    p = problem(60, 1e-3, 23, 0.5);
    const Eigen::MatrixXd before = full(*p.pair.K);
    p.environment.factor[7] = std::clamp(p.environment.factor[7] - 0.3, 0.0, 1.0);  // 15 standard errors
    try {
      restore_closure(*p.pair.K, run, settings);
      FAIL() << "an InputError expected";
    } catch (const core::InputError& error) {
      EXPECT_NE(std::string(error.what()).find("element 7 "), std::string::npos) << error.what();
      EXPECT_EQ(core::single_line(error.what()), error.what());
    }
    EXPECT_EQ(full(*p.pair.K), before);
    std::vector<double> bound(60, 0.0);
    bound[7] = 0.3;  // that explains it
    settings.row_bound = bound;
    settings.largest_correction = anything;
    EXPECT_TRUE(restore_closure(*p.pair.K, run, settings).converged);
  }
}

// Elements that see no other, all of whose light leaves.
TEST(ClosureRepairs, leave_what_sees_the_environment_alone) {
  core::LocalRun run(1, 1);
  for (const std::string& method : closure_names()) {
    DenseSymmetric K({1, 2, 1, 1});
    K.add(2, 3, {0.3, 0.02});
    const EnvironmentColumn environment{{1, 0.99, 0.7, 0.72}, {0.01, 0.01, 0.01, 0.01}};
    const ClosureReport report = restore_closure(K, run, {.method = method, .environment = &environment});
    EXPECT_TRUE(report.converged);
    EXPECT_NEAR(report.environment[0], 1, 1e-13);
    EXPECT_NEAR(report.environment[1], 1, 1e-13);
    EXPECT_GT(report.environment[3], 0.7);
    EXPECT_NEAR(report.environment[2] + K.entry(2, 3), 1, 1e-13);
  }
}

TEST(ClosureRepairs, know_their_names) {
  core::LocalRun run(1, 1);
  DenseSymmetric K({1, 1});
  K.add(0, 1, {1, 0});
  EXPECT_THROW(restore_closure(K, run, {.method = "force"}), core::InputError);
  EXPECT_EQ(closure_names(), (std::vector<std::string>{"scaling", "least-squares"}));
}
