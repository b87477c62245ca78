#include "fem/goal/dual_weighted.h"

#include <cmath>

#include "core/error.h"
#include "fem/columns.h"
#include "fem/space/plane_basis.h"

namespace interflect::fem {
namespace {

using solvers::ColumnMatrix;

/// G^-1 K b.
ColumnMatrix arriving(const ElementSystem& system, const ColumnMatrix& b, Run& run) {
  ColumnMatrix h(b.rows(), b.cols());
  system.K.apply(b, h, run);
  divide_by(h, system.K.gram());
  return h;
}

/// Of what functions send from afar: far below what elements lack, wherever it matters.
constexpr double accuracy_of_transport = 1e-5;

/// How fast coefficients fall from degree 1 to the highest, 3, per degree; those that do not matter count as `least`.
/// @param functions  rich functions x channels
double decay_of(const scene::Scene& scene, const Eigen::Ref<const ColumnMatrix>& functions) {
  const auto of_degree = [&](int degree) {
    const Index first = degree == 0 ? 0 : plane_functions(degree - 1), count = plane_functions(degree) - first;
    return scene.weigh(to_spectrum(functions.middleRows(first, count).colwise().norm()));
  };
  constexpr double least = 1e-6;  // of the mean: less matters nowhere, and from afar less than 1e-5 is not known
  const double floor = least * of_degree(0);
  if (!(floor > 0)) return 0;
  return 0.5 * std::log(std::max(of_degree(1), floor) / std::max(of_degree(3), floor));
}

class Estimator {
 public:
  Estimator(const ElementSystem& system, GoalWeights weights)
      : system_(system),
        weights_(std::move(weights)),
        functions_(plane_functions(system.order)),
        rich_functions_(plane_functions(weights_.order)) {}

  /// w = (s + R G^-1 c) + R T_h w.
  ColumnMatrix importance(const solvers::RadiositySolver& solver, const solvers::StoppingRule& stopping,
                          Run& run) const {
    ColumnMatrix e = ColumnMatrix::Zero(system_.e.rows(), system_.e.cols());
    for (Index i = 0; i < system_.mesh.size(); ++i)
      for (Index a = 0; a < functions_; ++a) {
        const Index u = i * functions_ + a;
        e.row(u) = system_.R.row(u) * (direct(i, a) / gram(u));
        if (a == 0) e.row(u).array() += arriving_on(i);
      }
    const solvers::Reflection R(system_.R);
    solvers::SolverState state{e};
    solver.advance({system_.K, R, e}, state, stopping, run);
    run.throw_if_stopped("importance");
    return std::move(state.x);
  }

  Spectrum value(const ColumnMatrix& b, const ColumnMatrix& h) const {
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(b.cols());
    for (Index i = 0; i < system_.mesh.size(); ++i) {
      for (Index a = 0; a < functions_; ++a) sum += direct(i, a) * b.row(i * functions_ + a);
      sum += area(i) * arriving_on(i) * h.row(i * functions_);
    }
    return to_spectrum(sum);
  }

  /// <z_h, e>, z_h = c_h + T_h w: of exitance, which is constant on elements.
  /// @param h_w  G^-1 K w
  Spectrum by_importance(const ColumnMatrix& h_w) const {
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(h_w.cols());
    for (Index i = 0; i < system_.mesh.size(); ++i)
      for (Index a = 0; a < functions_; ++a) {
        const Index u = i * functions_ + a;
        sum += (direct(i, a) + gram(u) * h_w.row(u).array()).matrix().cwiseProduct(system_.e.row(u));
      }
    return to_spectrum(sum);
  }

  /// Of K's entries of constants, pair by pair.
  Spectrum quadrature(const ColumnMatrix& b, const ColumnMatrix& w, const Run& run) const {
    Spectrum out;
    for (Index c = 0; c < b.cols(); ++c) {
      const double sum = system_.K.sum_over_entries(run, [&](Index i, Index j, double K) {
        if (i % functions_ != 0 || j % functions_ != 0) return 0.0;
        const double change = (w(i, c) * b(j, c) + w(j, c) * b(i, c)) * K;
        return 0.5 * change * change;  // pairs are visited as two entries
      });
      out[static_cast<int>(c)] = system_.tolerance * std::sqrt(sum);
    }
    return out;
  }

  /// @param h     [G^-1 K b, G^-1 K w]
  /// @param at    [T b, T w] at the nodes
  void estimate(const ColumnMatrix& h, const ElementNodes& nodes, const ColumnMatrix& at, DualWeighted& out) const {
    const Index channels = h.cols() / 2;
    Eigen::RowVectorXd correction = Eigen::RowVectorXd::Zero(channels);
    for (Index i = 0; i < system_.mesh.size(); ++i) {
      const std::size_t element = static_cast<std::size_t>(i);
      const scene::SurfacePatch& patch = system_.mesh.patches()[element];
      const PlaneBasis basis(weights_.order, patch.ring(), patch.normal());
      const Index active = plane_functions(system_.degree[element]);
      Eigen::RowVectorXd product = Eigen::RowVectorXd::Zero(channels), r_squares = product, z_squares = product;
      ColumnMatrix r_functions = ColumnMatrix::Zero(rich_functions_, channels),
                   of_transported = ColumnMatrix::Zero(rich_functions_, 2 * channels);
      for (std::size_t q = nodes.first[element]; q < nodes.first[element + 1]; ++q) {
        const SurfaceNode& node = nodes.nodes[q];
        const PlaneBasis::Values N = basis.at(node.position);
        const Eigen::RowVectorXd defect =
            at.row(static_cast<Index>(q)) - N.head(active).transpose() * h.middleRows(i * functions_, active);
        const Eigen::RowVectorXd r = defect.head(channels).cwiseProduct(system_.R.row(i * functions_)),
                                 zeta = defect.tail(channels);
        product += node.weight * r.cwiseProduct(zeta);
        r_squares += node.weight * r.cwiseAbs2();
        z_squares += node.weight * zeta.cwiseAbs2();
        r_functions += (node.weight / patch.area) * N * r;
        of_transported += (node.weight / patch.area) * N * at.row(static_cast<Index>(q));
      }
      Eigen::RowVectorXd size = (r_squares.array() * z_squares.array()).sqrt();
      for (Index a = active; a < rich_functions_; ++a) {
        const Eigen::RowVectorXd of_direct = direct(i, a) * r_functions.row(a);
        product += of_direct;
        size += of_direct.cwiseAbs();
      }
      correction += product;
      out.of_elements.push_back(to_spectrum(product));
      out.size.push_back(to_spectrum(size));
      out.decay.push_back(decay_of(system_.scene, of_transported.leftCols(channels)) +
                          decay_of(system_.scene, of_transported.rightCols(channels)));
    }
    out.correction = to_spectrum(correction);
  }

 private:
  double direct(Index i, Index a) const { return weights_.direct[static_cast<std::size_t>(i * rich_functions_ + a)]; }
  double arriving_on(Index i) const {
    return weights_.arriving.empty() ? 0.0 : weights_.arriving[static_cast<std::size_t>(i)];
  }
  double gram(Index u) const { return system_.K.gram()[static_cast<std::size_t>(u)]; }
  double area(Index i) const { return system_.mesh.patches()[static_cast<std::size_t>(i)].area; }

  const ElementSystem& system_;
  GoalWeights weights_;
  Index functions_, rich_functions_;
};

}  // namespace

DualWeighted dual_weighted(const ElementSystem& system, solvers::ConstColumns b, const Goal& goal,
                           const raycast::RayCaster& rays, const solvers::RadiositySolver& solver,
                           const solvers::StoppingRule& stopping, Run& run) {
  constexpr int rich = ElementBasis::highest_order;
  if (system.order >= rich) throw core::PreconditionError("dual_weighted: an order of 0 .. 2 expected");
  const Estimator estimator(system, weights_of(goal, system.scene, system.mesh, rays, rich, run));
  const Index channels = b.cols();
  ColumnMatrix both(b.rows(), 2 * channels);
  both << b, estimator.importance(solver, stopping, run);
  const ColumnMatrix h = arriving(system, both, run);
  DualWeighted out;
  out.value = estimator.value(b, h.leftCols(channels));
  out.by_importance = estimator.by_importance(h.rightCols(channels));
  out.quadrature = estimator.quadrature(both.leftCols(channels), both.rightCols(channels), run);
  const PointViewFactors factors(system.scene, system.mesh.patches(), system.order, accuracy_of_transport);
  const ElementNodes nodes = element_nodes(system.mesh.patches(), rich + 1);
  estimator.estimate(h, nodes, iterated_transport(factors, system.mesh.patches(), nodes, both, run), out);
  return out;
}

}  // namespace interflect::fem
