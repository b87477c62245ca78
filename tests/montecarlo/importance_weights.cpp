#include "montecarlo/combine/importance_weights.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "core/moments.h"
#include "core/random.h"

namespace interflect::montecarlo {
namespace {

using Function = std::function<double(double)>;

double integral(const Function& f) {
  constexpr int n = 20000;
  double sum = 0;
  for (int k = 0; k < n; ++k) sum += f((k + .5) / n);
  return sum / n;
}

std::array<double, 2> pdfs(double x) { return {1, 2 * x}; }
constexpr std::array<double, 2> one_each{1, 1};

/// Of one sample of each technique, by quadrature.
double variance(const Function& f, Heuristic heuristic) {
  double sum = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto weighed = [&](double x) { return importance_weight(heuristic, one_each, pdfs(x), i) * f(x); };
    const double mean = integral(weighed);
    sum += integral([&](double x) { return pdfs(x)[i] > 0 ? weighed(x) * weighed(x) / pdfs(x)[i] : 0; }) - mean * mean;
  }
  return sum;
}

/// Of the optimal weights, which have learnt by quadrature.
double optimal_variance(const Function& f, Eigen::VectorXd* alpha = nullptr) {
  OptimalWeights weights(one_each);
  constexpr int n = 20000;
  for (int k = 0; k < n; ++k) {
    const double x = (k + .5) / n;
    weights.learn(f(x), pdfs(x), pdfs(x)[0] + pdfs(x)[1]);  // as many as the techniques would draw there
  }
  weights.solve();
  if (alpha) *alpha = weights.alpha();
  double sum = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto score = [&](double x) { return weights.score(f(x), pdfs(x)); };
    const double mean = integral([&](double x) { return score(x) * pdfs(x)[i]; });
    sum += integral([&](double x) { return score(x) * score(x) * pdfs(x)[i]; }) - mean * mean;
  }
  return sum;
}

const Function e_to_x = [](double x) { return std::exp(x); }, line = [](double x) { return .3 + 1.4 * x; };

// By one sample each of 1 and 2x; and the power heuristic is thirty times worse here.
TEST(ImportanceWeights, have_known_variances) {
  EXPECT_NEAR(variance(e_to_x, Heuristic::balance), .0023561674, 1e-8);
  EXPECT_NEAR(variance(e_to_x, Heuristic::power), .0700396199, 1e-8);
  EXPECT_NEAR(variance(line, Heuristic::balance), .0071110324, 1e-8);
  EXPECT_NEAR(variance(line, Heuristic::power), .0242192101, 1e-8);
}

TEST(ImportanceWeights, add_up_to_one) {
  for (const Heuristic heuristic : {Heuristic::balance, Heuristic::power})
    for (std::uint64_t k = 0; k < 1000; ++k) {
      core::RandomNumbers numbers(1, 0, k);
      std::array<double, 4> n, p;
      for (std::size_t i = 0; i < 4; ++i)
        n[i] = 1 + 9 * numbers.next(), p[i] = numbers.next() < .3 ? 0 : numbers.next();
      double sum = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        const double w = importance_weight(heuristic, n, p, i);
        EXPECT_TRUE(p[i] > 0 || w == 0);
        sum += w;
      }
      EXPECT_NEAR(sum, p[0] + p[1] + p[2] + p[3] == 0 ? 0 : 1, 1e-14);
    }
}

TEST(OptimalWeights, have_known_variances) {
  Eigen::VectorXd alpha;
  EXPECT_NEAR(optimal_variance(e_to_x, &alpha), .0020220067, 1e-8);
  EXPECT_NEAR(alpha(0), .90249613, 1e-6);
  EXPECT_NEAR(alpha(1), .81578570, 1e-6);
  EXPECT_NEAR(alpha.sum(), std::exp(1.0) - 1, 1e-6);
  EXPECT_NEAR(optimal_variance(line), 0, 1e-12);
}

// Learnt from a pilot of its own the estimate is unbiased, and nearly as good.
TEST(OptimalWeights, are_unbiased_by_a_pilot) {
  core::ScalarMoments estimates;
  for (std::uint32_t run = 0; run < 2000; ++run) {
    OptimalWeights weights(one_each);
    double sum = 0;
    for (std::uint64_t k = 0; k < 64; ++k) {
      core::RandomNumbers numbers(2, run, k);
      for (const double x : {numbers.next(), std::sqrt(numbers.next())}) {
        if (k < 32) weights.learn(e_to_x(x), pdfs(x));
      }
    }
    weights.solve();
    core::RandomNumbers numbers(3, run, 0);
    sum = weights.constant();
    for (const double x : {numbers.next(), std::sqrt(numbers.next())}) sum += weights.score(e_to_x(x), pdfs(x));
    estimates.add(sum);
  }
  EXPECT_NEAR(estimates.mean(), std::exp(1.0) - 1, 4 * estimates.standard_error());
  EXPECT_LT(estimates.variance(), .0023561674);  // than that of the balance heuristic
}

// Two techniques that are one and the same: A is singular.
TEST(OptimalWeights, of_equal_techniques_are_as_good_as_of_one) {
  OptimalWeights weights(one_each);
  for (std::uint64_t k = 0; k < 100; ++k) {
    core::RandomNumbers numbers(4, 0, k);
    weights.learn(3, std::array<double, 2>{1, 1});
  }
  weights.solve();
  EXPECT_NEAR(weights.alpha()(0), 1.5, 1e-12);
  EXPECT_NEAR(weights.constant() + 2 * weights.score(3, std::array<double, 2>{1, 1}), 3, 1e-12);
}

}  // namespace
}  // namespace interflect::montecarlo
