#include "solvers/bounce.h"

namespace interflect::solvers {

ColumnMatrix bounced(const System& system, ConstColumns x, Run& run) {
  const Eigen::Map<const Eigen::VectorXd> G(system.K.gram().data(), x.rows());
  ColumnMatrix h(x.rows(), x.cols()), b = system.e;
  system.K.apply(x, h, run);
  h.array().colwise() /= G.array();
  system.R.add_reflected(h, b);
  return b;
}

}  // namespace interflect::solvers
