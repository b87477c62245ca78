// How close the dense operator comes to a plain read of its bytes, with one column and with three, and a sparse one
// beside it: ratios within one interleaved run.
//
//   bench_dense_operator [n ...]      default: 5000 10000

#include <sys/mman.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <vector>

#include "core/random.h"
#include "core/run.h"
#include "fem/operator/dense_symmetric.h"
#include "fem/operator/sparse_symmetric.h"
#include "solvers/conjugate_gradients.h"
#include "solvers/gauss_seidel.h"

using namespace interflect;

namespace {

constexpr int rounds = 25, iterations = 20;
constexpr std::size_t large_page = std::size_t{2} << 20;

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Other programs on the machine only slow a round down: the fastest one tells what it takes.
double fastest(const std::vector<double>& times) { return *std::min_element(times.begin(), times.end()); }

/// Sums an array, on the threads of a run: what memory can do.
double plain_sum(const double* data, Index count, const Run& run) {
  return core::reduce_in_blocks(run.threads, count, Index{1} << 18, 0.0, [&](Index begin, Index end) {
    Eigen::Array<double, 32, 1> sums = Eigen::Array<double, 32, 1>::Zero();
    for (; begin + 32 <= end; begin += 32) sums += Eigen::Map<const Eigen::Array<double, 32, 1>>(data + begin);
    return sums.sum();
  });
}

struct Problem {
  explicit Problem(Index n)
      : K(std::vector<double>(static_cast<std::size_t>(n), 1.0)), count(static_cast<Index>(K.bytes() / 8)) {
    for (Index a = 0; a < n; ++a) {
      RandomRow random{1, static_cast<std::uint32_t>(a), 0};
      for (Index j = a; j < n; ++j) K.add(a, j, {random.next() / static_cast<double>(n), 0});
    }
    const std::size_t bytes = (static_cast<std::size_t>(count) * 8 + large_page - 1) / large_page * large_page;
    plain.reset(static_cast<double*>(std::aligned_alloc(large_page, bytes)));
    madvise(plain.get(), bytes, MADV_HUGEPAGE);
    std::fill(plain.get(), plain.get() + count, 1.0);
  }
  using RandomRow = core::RandomNumbers;
  struct Free {
    void operator()(double* p) const { std::free(p); }
  };
  fem::DenseSymmetric K;
  Index count;
  std::unique_ptr<double[], Free> plain;
};

/// Of those after the first, which has preparations in it.
double seconds_an_iteration(const solvers::RadiositySolver& solver, const solvers::System& system,
                            core::LocalRun& run) {
  solvers::SolverState state;
  const solvers::SolverReport report = solver.advance(system, state, {0.0, iterations}, run);
  return (report.history.back().seconds - report.history.front().seconds) / (iterations - 1);
}

void compare(const Problem& problem, Index columns, unsigned threads, double& sink) {
  core::LocalRun run(1, threads);
  std::vector<double> read, apply, sweep, krylov;
  const solvers::ColumnMatrix b = solvers::ColumnMatrix::Random(problem.K.size(), columns);
  solvers::ColumnMatrix out(b.rows(), columns);
  const solvers::Reflection R(solvers::ColumnMatrix::Constant(problem.K.size(), columns, 0.5));
  const solvers::System system{problem.K, R, b};
  for (int round = 0; round < rounds; ++round) {
    read.push_back(seconds([&] { sink += plain_sum(problem.plain.get(), problem.count, run.get()); }));
    apply.push_back(seconds([&] { problem.K.apply(b, out, run); }));
    sweep.push_back(seconds_an_iteration(solvers::GaussSeidel(), system, run));
    krylov.push_back(seconds_an_iteration(solvers::ConjugateGradients(), system, run));
    sink += out.sum();
  }
  const double gigabytes = static_cast<double>(problem.count) * 8e-9;
  std::printf("%7td %7td %7u %11.2f %11.2f %9.0f %% %18.2f %17.2f\n", problem.K.size(), columns, threads,
              gigabytes / fastest(read), gigabytes / fastest(apply), 100 * fastest(read) / fastest(apply),
              fastest(krylov) / fastest(read), fastest(sweep) / fastest(read));
}

/// Eigen's product of the same matrix, all of its n² entries stored.
void compare_eigen(const Problem& problem, double& sink) {
  const Index n = problem.K.size();
  Eigen::MatrixXd full(n, n);
  for (Index a = 0; a < n; ++a)
    for (Index b = 0; b < n; ++b) full(a, b) = problem.K.entry(a, b);
  core::LocalRun run(1, 1);
  const solvers::ColumnMatrix b = solvers::ColumnMatrix::Random(n, 3);
  solvers::ColumnMatrix out(n, 3);
  std::vector<double> read, product;
  for (int round = 0; round < 5; ++round) {
    read.push_back(seconds([&] { sink += plain_sum(full.data(), n * n, run.get()); }));
    product.push_back(seconds([&] { out.noalias() = full * b; }));
    sink += out.sum();
  }
  std::printf("%7td       3       1   Eigen's full(n, n) * b(n, 3): %.0f %% of a plain read of its 8 n^2 bytes\n", n,
              100 * fastest(read) / fastest(product));
}

/// A sparse operator of a tenth of the pairs: its product against a plain read of its 12 bytes a pair, and against the
/// dense product.
void compare_sparse(const Problem& problem, unsigned threads, double& sink) {
  const Index n = problem.K.size();
  core::LocalRun run(1, threads);
  fem::SparseAssembly assembly(std::vector<double>(static_cast<std::size_t>(n), 1.0), 0.9 / static_cast<double>(n));
  for (Index a = 0; a < n; ++a)
    for (Index b = a; b < n; ++b) assembly.add(a, b, {problem.K.entry(a, b), 0});
  const auto K = assembly.packed(run.get());
  const auto count = static_cast<Index>(K->bytes() / 8);
  const solvers::ColumnMatrix b = solvers::ColumnMatrix::Random(n, 3);
  solvers::ColumnMatrix out(n, 3);
  std::vector<double> read, product, dense;
  for (int round = 0; round < rounds; ++round) {
    read.push_back(seconds([&] { sink += plain_sum(problem.plain.get(), count, run.get()); }));
    product.push_back(seconds([&] { K->apply(b, out, run); }));
    dense.push_back(seconds([&] { problem.K.apply(b, out, run); }));
    sink += out.sum();
  }
  std::printf(
      "%7td       3 %7u   sparse, %.0f %% of the pairs kept: %.1f MB, %.0f %% of a plain read, %.2f of the dense "
      "product's "
      "time\n",
      n, threads, 100 * K->kept_share(), 1e-6 * K->bytes(), 100 * fastest(read) / fastest(product),
      fastest(product) / fastest(dense));
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<Index> sizes;
  for (int i = 1; i < argc; ++i) sizes.push_back(std::atol(argv[i]));
  if (sizes.empty()) sizes = {5000, 10000};
  double sink = 0;
  std::printf(
      "      n columns threads   read GB/s  apply GB/s  apply / read  CG iteration / read  GS sweep / read (times)\n");
  for (Index n : sizes) {
    Problem problem(n);
    for (const Index columns : {1, 3})
      for (unsigned threads : {1u, 2u}) compare(problem, columns, threads, sink);
    for (unsigned threads : {1u, 2u}) compare_sparse(problem, threads, sink);
    compare_eigen(problem, sink);
  }
  return sink == 12345 ? 1 : 0;  // so that nothing is optimised away
}
