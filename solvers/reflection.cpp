#include <Eigen/Eigenvalues>

#include "solvers/transport_operator.h"

namespace interflect::solvers {

void Reflection::add_reflected(ConstColumns h, Columns b) const {
  b.array() += reflectance_.array() * h.array();
  for (const Block& block : blocks_)
    for (std::size_t c = 0; c < block.of_channel.size(); ++c) {
      const Eigen::MatrixXd& R = block.of_channel[c];
      const auto column = static_cast<Index>(c);
      b.col(column).segment(block.first, R.rows()) += R * h.col(column).segment(block.first, R.rows());
    }
}

Reflection Reflection::root() const {
  std::vector<Block> roots = blocks_;
  for (Block& block : roots)
    for (Eigen::MatrixXd& R : block.of_channel) {
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of_block(R);
      const Eigen::VectorXd rho = of_block.eigenvalues().cwiseMax(0.0).cwiseSqrt();  // rounding may be below 0
      R = of_block.eigenvectors() * rho.asDiagonal() * of_block.eigenvectors().transpose();
    }
  return Reflection(reflectance_.cwiseSqrt(), std::move(roots));
}

}  // namespace interflect::solvers
