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

}  // namespace interflect::solvers
