#pragma once

#include <memory>
#include <string>
#include <vector>

#include "solvers/transport_operator.h"

namespace interflect::solvers {

/// b = e + R G^-1 K b, every column a system of its own on the same K.
struct System {
  const TransportOperator& K;
  const Reflection& R;
  ConstColumns e;  ///< exitance coefficients
};

struct StoppingRule {
  double tolerance = 1e-10;  ///< on max_a |e + R G^-1 K b - b| / max_a |b|, per column
  int max_iterations = 10000;
};

struct SolverReport {
  enum class Stopped { converged, iteration_limit, asked_to, nothing_to_do };
  Stopped why = Stopped::iteration_limit;
  int iterations = 0;  ///< sweeps over the matrix
  std::vector<double>
      residual_history{};  ///< relative, as in StoppingRule, one per iteration; the last is the result's
  bool converged() const { return why == Stopped::converged || why == Stopped::nothing_to_do; }
  double residual() const { return residual_history.empty() ? 0.0 : residual_history.back(); }
};
std::string describe(SolverReport::Stopped why);

/// What a solve is in the middle of: x is a start (fresh: e) and becomes the result.
struct SolverState {
  ColumnMatrix x;  ///< radiosity coefficients
  int step = 0;
};

class RadiositySolver {
 public:
  virtual ~RadiositySolver() = default;
  virtual std::string name() const = 0;
  virtual SolverReport advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const = 0;
};

/// "gauss-seidel" or "jacobi".  @throws core::InputError with the names known
std::unique_ptr<RadiositySolver> make_solver(const std::string& name);
std::vector<std::string> solver_names();

}  // namespace interflect::solvers
