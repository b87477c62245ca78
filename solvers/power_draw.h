#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solvers/transport_operator.h"

namespace interflect::solvers {

/// sum |power| of each column, by a pass over memory as it lies.
Eigen::RowVectorXd column_sizes(const ColumnMatrix& power);

/// Unknowns drawn with a probability in proportion to the power that they send, columns having an equal say: by
/// inversion, with a guide table [Chen, Asau 1974], in a time that does not grow with their number.
class PowerDraw {
 public:
  /// @param power  [W | lm], unknowns x columns; signs do not matter
  explicit PowerDraw(const ColumnMatrix& power);

  struct Drawn {
    Index unknown;
    double probability;
  };
  /// @param u  in [0, 1): areas of its interval onto unknowns, so that evenly spread numbers are drawn evenly
  Drawn operator()(double u) const;
  double probability(Index unknown) const {
    const auto a = static_cast<std::size_t>(unknown);
    return (cumulative_[a] - (a == 0 ? 0 : cumulative_[a - 1])) / cumulative_.back();
  }
  bool nothing() const { return !(cumulative_.back() > 0); }
  const Eigen::RowVectorXd& sizes() const { return sizes_; }  ///< sum |power| of each column

 private:
  void make_guide();

  Eigen::RowVectorXd sizes_;
  std::vector<double> cumulative_;
  std::vector<std::uint32_t> guide_;  ///< where to begin looking, by u in as many equal parts as there are unknowns
};

/// Half in proportion to power and half to area, of each column: so that what sends little, or nothing yet, is drawn as
/// well.
ColumnMatrix half_by_area(const ColumnMatrix& power, std::span<const double> areas);

/// Radiosity times area: what unknowns send.
ColumnMatrix power_of(std::span<const double> areas, ConstColumns radiosity);

}  // namespace interflect::solvers
