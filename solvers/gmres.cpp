#include "solvers/gmres.h"

#include <cmath>
#include <limits>
#include <vector>

#include "solvers/bounce.h"
#include "solvers/iterations.h"
#include "solvers/system_check.h"

namespace interflect::solvers {
namespace {

/// One column's space: an orthonormal basis V, and (I - R G^-1 K) V = V H with H made triangular by rotations.
class Space {
 public:
  Space(const Eigen::VectorXd& residual, int most)
      : H_(Eigen::MatrixXd::Zero(most + 1, most)), g_(Eigen::VectorXd::Zero(most + 1)) {
    g_(0) = residual.norm();
    if (g_(0) > 0) V_.push_back(residual / g_(0));
  }

  /// Nothing more can be gained: the residual is 0, or what comes next lies in the space.
  bool closed() const { return closed_ || V_.empty(); }
  const Eigen::VectorXd& newest() const { return V_.back(); }

  /// @param image  (I - R G^-1 K) newest()
  void add(Eigen::VectorXd image) {
    const Index k = used_++;
    for (Index i = 0; i <= k; ++i) {
      const Eigen::VectorXd& v = V_[static_cast<std::size_t>(i)];
      H_(i, k) = v.dot(image);
      image -= H_(i, k) * v;
    }
    H_(k + 1, k) = image.norm();
    closed_ = !(H_(k + 1, k) > 0);
    if (!closed_) V_.push_back(image / H_(k + 1, k));
    for (Index i = 0; i < k; ++i) rotate(H_(i, k), H_(i + 1, k), rotations_[static_cast<std::size_t>(i)]);
    const double r = std::hypot(H_(k, k), H_(k + 1, k));
    if (!(r > 0)) {
      closed_ = true;
      --used_;
      return;
    }
    rotations_.push_back({H_(k, k) / r, H_(k + 1, k) / r});
    rotate(H_(k, k), H_(k + 1, k), rotations_.back());
    rotate(g_(k), g_(k + 1), rotations_.back());
  }

  /// What of the space makes the residual least.
  Eigen::VectorXd best(Index n) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(n);
    if (used_ == 0) return sum;
    const Eigen::VectorXd y = H_.topLeftCorner(used_, used_).triangularView<Eigen::Upper>().solve(g_.head(used_));
    for (Index i = 0; i < used_; ++i) sum += y(i) * V_[static_cast<std::size_t>(i)];
    return sum;
  }
  /// And the residual itself, by the rotations: g_k of what is left, on (V rotated)'s last vector.
  Eigen::VectorXd residual(Index n) const {
    Eigen::VectorXd in_basis = Eigen::VectorXd::Zero(used_ + 1);
    in_basis(used_) = g_(used_);
    for (Index i = used_ - 1; i >= 0; --i) {
      const auto& [c, s] = rotations_[static_cast<std::size_t>(i)];
      const double a = in_basis(i), b = in_basis(i + 1);
      in_basis(i) = c * a - s * b;
      in_basis(i + 1) = s * a + c * b;
    }
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(n);
    for (Index i = 0; i <= used_ && i < std::ssize(V_); ++i) sum += in_basis(i) * V_[static_cast<std::size_t>(i)];
    return sum;
  }

 private:
  struct Rotation {
    double cosine, sine;
  };
  static void rotate(double& a, double& b, const Rotation& r) {
    const double before = a;
    a = r.cosine * before + r.sine * b;
    b = r.cosine * b - r.sine * before;
  }

  std::vector<Eigen::VectorXd> V_;
  Eigen::MatrixXd H_;
  Eigen::VectorXd g_;
  std::vector<Rotation> rotations_;
  Index used_ = 0;
  bool closed_ = false;
};

/// All columns of (I - R G^-1 K) v.
ColumnMatrix image_of(const System& system, const ColumnMatrix& v, Run& run) {
  const ColumnMatrix nothing = ColumnMatrix::Zero(v.rows(), v.cols());
  return v - bounced({system.K, system.R, nothing}, v, run);
}

}  // namespace

SolverReport Gmres::advance(const System& system, SolverState& state, const StoppingRule& rule, Run& run) const {
  require_solvable(system);
  if (!prepare(system, state)) return {.why = SolverReport::Stopped::nothing_to_do};

  const Index n = state.x.rows(), columns = state.x.cols();
  Iterations iterations(state, rule, run);
  for (;;) {
    const ColumnMatrix start = state.x;
    ColumnMatrix residual = residual_of(system, start, run);
    if (!residual.allFinite()) iterations.next({std::numeric_limits<double>::quiet_NaN(), 0});  // throws
    std::vector<Space> spaces;
    for (Index c = 0; c < columns; ++c) spaces.emplace_back(residual.col(c), restart_);
    for (int k = 0; k < restart_; ++k) {
      ColumnMatrix newest = ColumnMatrix::Zero(n, columns), x = start;
      for (Index c = 0; c < columns; ++c)
        if (const Space& space = spaces[static_cast<std::size_t>(c)]; !space.closed()) newest.col(c) = space.newest();
      const ColumnMatrix images = image_of(system, newest, run);
      for (Index c = 0; c < columns; ++c) {
        Space& space = spaces[static_cast<std::size_t>(c)];
        if (!space.closed()) space.add(images.col(c));
        x.col(c) += space.best(n);
        residual.col(c) = space.residual(n);
      }
      // A space closes where there is nothing to add, and where what there is is no number.
      const bool finite = images.allFinite() && residual.allFinite();
      const double relative = finite ? relative_size(residual, x) : std::numeric_limits<double>::quiet_NaN();
      if (!iterations.next(x, {relative, static_cast<double>((k == 0 ? 2 : 1) * n)})) return iterations.report();
    }
  }
}

}  // namespace interflect::solvers
