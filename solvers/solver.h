#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "solvers/transport_operator.h"

namespace interflect::solvers {

class TransitionSampler;

/// b = e + R G^-1 K b, every column a system of its own on the same K.
struct System {
  const TransportOperator& K;
  const Reflection& R;
  ConstColumns e;  ///< exitance coefficients
  const TransitionSampler* walks =
      nullptr;  ///< of the same K: what solvers go by that sample, and have nothing else of it
  /// t, of unknowns, where one number J = sum_a t_a b_a of each column is asked for; empty: all are.
  std::span<const double> target{};
};

struct StoppingRule {
  double tolerance = 1e-10;  ///< on max_a |e + R G^-1 K b - b| / max_a |b|, per column
  int max_iterations = 10000;
  /// Relative standard error at which those stop that sample: of what is reflected, L2, or of what is asked for.
  double noise = 0.01;
  std::uint64_t samples = 0;  ///< that those take in all, whatever their noise; 0: as many as `noise` asks for
  double unshot = 0;          ///< sum G |r| / sum G |e| at which those stop that shoot
  double max_seconds = std::numeric_limits<double>::infinity();
};

/// What an iteration left and cost.
struct IterationRecord {
  double residual;  ///< relative, as in StoppingRule; of those that sample, `noise`
  double rows;      ///< of K that were used so far, a product being all of them; or draws of a TransitionSampler
  double seconds;   ///< since the start
  /// Times are no result: the same solve has others.
  bool operator==(const IterationRecord& other) const { return residual == other.residual && rows == other.rows; }
};

struct SolverReport {
  enum class Stopped { converged, iteration_limit, time_limit, asked_to, nothing_to_do };
  Stopped why = Stopped::iteration_limit;
  std::vector<IterationRecord> history{};  ///< one an iteration; the last is the result's
  bool converged() const { return why == Stopped::converged || why == Stopped::nothing_to_do; }
  int iterations() const { return static_cast<int>(history.size()); }  ///< sweeps over the matrix, or their like
  double residual() const { return history.empty() ? 0.0 : history.back().residual; }
  double rows() const { return history.empty() ? 0.0 : history.back().rows; }
  std::vector<double> residuals() const;
};
std::string describe(SolverReport::Stopped why);

/// What a solve is in the middle of, to go on from: x is a start (fresh: e) and becomes the result.
struct SolverState {
  ColumnMatrix x;  ///< radiosity coefficients
  int step = 0;
  ColumnMatrix residual{};           ///< e + R G^-1 K x - x, of solvers that keep it: what is not shot yet
  ColumnMatrix standard_error{};     ///< of x, of solvers that sample
  Eigen::RowVectorXd power_error{};  ///< the same of sum G x over elements' first functions: their power
  /// J of every column where a target is asked for, and its standard error: of solvers that sample.
  Eigen::RowVectorXd target{}, target_error{};
  std::function<void(const SolverState&, const SolverReport&)> observer{};  ///< told after every iteration, if any
};

/// What some solvers may be told.
struct SolverSettings {
  double relaxation = 1.2;               ///< of over-relaxation, 0 < w < 2: how much of a Gauss-Seidel step is gone
  int restart = 40;                      ///< directions that gmres keeps
  double overshoot = 0;                  ///< of progressive: the share of the ambient term that is shot ahead, 0 .. 1
  int replications = 32;                 ///< of solvers that sample, 10 or more: standard errors are by how they differ
  std::string sequence = "independent";  ///< that they sample by (core/sample_sequence.h)
  int steps = 0;  ///< of southwell and progressive: how many are an iteration; 0: as many as there are unknowns
};

class RadiositySolver {
 public:
  virtual ~RadiositySolver() = default;
  virtual std::string name() const = 0;
  virtual SolverReport advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const = 0;
};

/// One that is known by name.
struct SolverEntry {
  std::string name, summary;
  /// What it needs beside products with K: nothing; K symmetric; System::walks; those with lines through everything;
  /// with points; in a closed room; those and a System::target.
  enum class Needs { products, symmetry, walks, lines, points, closed_room, target };
  Needs needs;
  /// Its answers have standard errors.
  bool samples() const { return needs != Needs::products && needs != Needs::symmetry; }
  std::unique_ptr<RadiositySolver> (*make)(const SolverSettings&);
  /// Of one that finds nothing of what reflects nothing, scored as it is where walks go on: who does.  Empty: it does.
  std::string finds_black_instead{};
  bool knows_polynomials = false;  ///< of those that sample: not constants alone
};
const std::vector<SolverEntry>& known_solvers();
/// @throws core::InputError with the names known
const SolverEntry& solver_named(const std::string& name);
std::vector<std::string> solver_names();
std::vector<std::string> solver_names(bool samples);  ///< of those that do, or of those that do not
std::vector<std::string> solver_names(std::initializer_list<SolverEntry::Needs> needs);
/// @throws core::InputError  as solver_named; where a setting is out of its range
std::unique_ptr<RadiositySolver> make_solver(const std::string& name, const SolverSettings& settings = {});

}  // namespace interflect::solvers
