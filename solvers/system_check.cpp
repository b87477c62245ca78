#include "solvers/system_check.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "core/format.h"
#include "solvers/transition_sampler.h"

namespace interflect::solvers {
namespace {

constexpr double rounding = 1e-9;

/// The least reflectance of a block, which must be one.
double least_of(const Reflection::Block& block, const Eigen::MatrixXd& R, Index unknowns) {
  if (R.rows() != R.cols() || block.first < 0 || block.first + R.rows() > unknowns)
    throw core::PreconditionError("solve: a block of R has another shape");
  const Eigen::VectorXd rho = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(R, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(rho.minCoeff() >= -rounding && rho.maxCoeff() <= 1 + rounding) || !R.isApprox(R.transpose(), rounding))
    throw core::InputError(
        core::format("reflectance of unknowns from %td on: 0 <= reflectance <= 1 expected", block.first));
  return rho.minCoeff();
}

/// Something must absorb, in every channel.
void require_absorption(const System& system) {
  const ColumnMatrix& rho = system.R.reflectance();
  std::vector<bool> in_block(static_cast<std::size_t>(rho.rows()), false);
  std::vector<bool> absorbs(static_cast<std::size_t>(rho.cols()), rho.rows() == 0);
  for (const Reflection::Block& block : system.R.blocks()) {
    if (block.of_channel.size() != absorbs.size())
      throw core::PreconditionError("solve: a block of R has another number of channels");
    for (std::size_t c = 0; c < absorbs.size(); ++c)
      if (least_of(block, block.of_channel[c], rho.rows()) < 1 - rounding) absorbs[c] = true;
    if (absorbs.empty()) continue;
    for (Index a = 0; a < block.of_channel[0].rows(); ++a) in_block[static_cast<std::size_t>(block.first + a)] = true;
  }
  for (std::size_t c = 0; c < absorbs.size(); ++c) {
    for (Index a = 0; a < rho.rows() && !absorbs[c]; ++a)
      absorbs[c] = !in_block[static_cast<std::size_t>(a)] && rho(a, static_cast<Index>(c)) < 1;
    if (!absorbs[c]) throw core::InputError("every reflectance is 1: where nothing is absorbed there is no answer");
  }
}

void require_finite_target(std::span<const double> target) {
  for (std::size_t a = 0; a < target.size(); ++a)
    if (!std::isfinite(target[a]))
      throw core::InputError(core::format("target %g of unknown %zu: a finite number expected", target[a], a));
}

}  // namespace

void require_solvable(const System& system) {
  const ColumnMatrix& rho = system.R.reflectance();
  const Index n = system.K.layout().unknowns();
  const std::span<const double> G = system.K.gram();
  if (static_cast<Index>(G.size()) != n || system.e.rows() != n || rho.rows() != n || rho.cols() != system.e.cols())
    throw core::PreconditionError("solve: K, R and e have different shapes");
  require_absorption(system);
  require_finite_target(system.target);
  for (Index a = 0; a < n; ++a) {
    if (const double area = G[static_cast<std::size_t>(a)]; !(area > 0) || !std::isfinite(area))
      throw core::InputError(
          core::format("unknown %td: the area of its element is %g m2, a positive one expected", a, area));
    for (Index c = 0; c < rho.cols(); ++c) {
      const double r = rho(a, c);
      if (!(r >= 0 && r <= 1))
        throw core::InputError(core::format("reflectance %g of unknown %td: 0 <= reflectance <= 1 expected", r, a));
      if (!std::isfinite(system.e(a, c)))
        throw core::InputError(core::format("exitance %g of unknown %td: a finite number expected", system.e(a, c), a));
    }
  }
}

namespace {

void require_diagonal(const System& system, const std::string& solver) {
  if (!system.R.diagonal())
    throw core::InputError("solver '" + solver + "'", "reflectance varies inside elements; use 'automatic' here");
}

}  // namespace

const RowAccess& required_rows(const System& system, const std::string& solver) {
  const RowAccess* rows = system.K.rows();
  if (rows == nullptr)
    throw core::InputError("solver '" + solver + "'", "an operator with rows expected; use 'automatic' here");
  require_diagonal(system, solver);
  return *rows;
}

const RowAccess& required_columns(const System& system, const std::string& solver) {
  const RowAccess* columns = system.K.columns();
  if (columns == nullptr)
    throw core::InputError("solver '" + solver + "'",
                           "a symmetric operator with rows, or one with columns, expected; use 'automatic' here");
  require_diagonal(system, solver);
  return *columns;
}

void require_walks(const System& system, const std::string& solver) {
  const auto refuse = [&](const char* what) { throw core::InputError("solver '" + solver + "'", what); };
  if (system.walks == nullptr) refuse("rays between elements expected");
  require_diagonal(system, solver);
  const Layout& layout = system.K.layout();
  if (layout.constants()) return;
  const PointTransitions* points = system.walks->points();
  if (points == nullptr || layout.elements() * points->functions() != layout.unknowns())
    refuse("rays with the functions of the operator expected");
}

void require_constants(const System& system, const std::string& solver) {
  if (!system.K.layout().constants())
    throw core::InputError("solver '" + solver + "'", "constants on elements expected; use 'stochastic-jacobi' here");
}

void require_lines(const System& system, const std::string& solver) {
  if (system.walks->lines() == nullptr)
    throw core::InputError("solver '" + solver + "'", "lines through everything expected");
}

void require_points(const System& system, const std::string& solver) {
  if (system.walks->points() == nullptr)
    throw core::InputError("solver '" + solver + "'", "rays between points expected");
}

void require_target(const System& system, const std::string& solver) {
  if (system.target.empty()) throw core::InputError("solver '" + solver + "'", "a target expected: what is asked for");
  if (static_cast<Index>(system.target.size()) != system.e.rows())
    throw core::PreconditionError("solve: the target has another shape than the exitance");
}

void require_replications(const SolverSettings& settings) {
  if (settings.replications < 10)
    throw core::InputError("solvers that sample", "10 replications or more expected: errors are by how they differ");
}

bool prepare(const System& system, SolverState& state) {
  if (state.x.size() == 0) state.x = system.e;
  if (state.x.rows() != system.e.rows() || state.x.cols() != system.e.cols())
    throw core::PreconditionError("solve: the start has another shape than the exitance");
  if (!state.x.allFinite()) throw core::InputError("start of the solve: finite numbers expected");
  bool any = false;
  for (Index c = 0; c < system.e.cols(); ++c) {
    const bool dark = (system.e.col(c).array() == 0).all();
    if (dark) state.x.col(c).setZero();
    any = any || !dark;
  }
  if (!any) {
    for (ColumnMatrix* of_x : {&state.residual, &state.standard_error}) of_x->setZero();
    for (Eigen::RowVectorXd* of_column : {&state.power_error, &state.target, &state.target_error}) of_column->setZero();
  }
  return any;
}

double relative_size(ConstColumns residual, ConstColumns x) {
  double largest = 0;
  for (Index c = 0; c < x.cols(); ++c) {
    const double r = residual.col(c).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(), size = x.col(c).cwiseAbs().maxCoeff();
    if (std::isnan(r)) return r;
    if (r > 0) largest = std::max(largest, size > 0 ? r / size : 1.0);
  }
  return largest;
}

}  // namespace interflect::solvers
