#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "fem/bounds/bounds.h"
#include "fem/bounds/linear_field.h"

namespace interflect::fem {

/// What a cell may receive from a part of an element; in single precision, since there are many.
struct Exchange {
  enum class Known : std::uint8_t {
    parts,  ///< F_j is known, of unknown parts of the node
    whole,  ///< of the node as a whole, and what is not constant over it is worth `across`
  };
  std::uint32_t source;  ///< element * QuarterTree::nodes + node
  Known known;
  float value, remainder, across, least, most;
  std::array<float, 5> derivatives;  ///< s, t, ss, st, tt
};

/// sum_j b_j F_j(x) of smooth F_j, about a point: per channel.
class SmoothSum {
 public:
  explicit SmoothSum(Index channels)
      : value(Eigen::RowVectorXd::Zero(channels)), doubt(value), derivatives(Eigen::MatrixXd::Zero(5, channels)) {}

  void move(const Vec2& way);
  void scale(const Eigen::RowVectorXd& by);  ///< >= 0
  /// Over a cell about whose centre it is.
  Bounds everywhere(const Cell& cell) const;
  Bounds mean(const Cell& cell) const;

  Eigen::RowVectorXd value, doubt;
  Eigen::Matrix<double, 5, Eigen::Dynamic> derivatives;  ///< s, t, ss, st, tt
};

/// sum_j (b_j - m) F_j and sum_j F_j beside it, so that m may be changed.
class ShiftedSum {
 public:
  ShiftedSum(Index channels, Eigen::RowVectorXd m) : of_b(channels), of_factors(1), middle(std::move(m)) {}

  /// @param from  a FactorRange or an Exchange
  template <class Factor>
  void add(const Factor& from, Index channel, double b, double further_doubt = 0) {
    const double part = b - middle[channel];
    of_b.value[channel] += double{from.value} * part;
    of_b.doubt[channel] += double{from.remainder} * std::abs(part) + further_doubt;
    for (std::size_t k = 0; k < 5; ++k)
      of_b.derivatives(static_cast<Index>(k), channel) += double{from.derivatives[k]} * part;
  }
  template <class Factor>
  void add_factor(const Factor& from) {
    of_factors.value[0] += double{from.value};
    of_factors.doubt[0] += double{from.remainder};
    for (std::size_t k = 0; k < 5; ++k) of_factors.derivatives(static_cast<Index>(k), 0) += double{from.derivatives[k]};
  }
  void move(const Vec2& way) {
    of_b.move(way);
    of_factors.move(way);
  }
  void shift(const Eigen::RowVectorXd& m);

  SmoothSum of_b, of_factors;
  Eigen::RowVectorXd middle;
};

/// A cell or a part of it, and what is far from it but near to what it is a part of.
struct Branch {
  Cell cell;
  std::size_t parent;         ///< an earlier branch; its own number for the first
  std::vector<Exchange> far;  ///< about the cell's centre
};

/// A branch that is not cut any further.
struct Leaf {
  std::size_t branch;
  double share;                ///< of the whole's area
  Bounds everywhere, mean;     ///< of T b
  SmoothSum polynomial;        ///< of T b, with all that is near in its doubt
  std::vector<Exchange> near;  ///< sum_j F_j - least_j of all is at most `left`
  double left;
};

/// (T b)(x) = int k(x, y) b(y) dy of what is linear on elements, over a cell: of a part P that is known, with the mean
/// b_P,
///
///   |int_P k b - F_P(x) b_P| <= across mean |b - b_P|                                             (factor_range.h)
///
/// From within the box around the scene sum_P F_P = 1, so that with any number m
///
///   (T b)(x) = m + sum_P (b_P - m) F_P(x)
///
/// m is the median of near parts' b_P, by the most that they may send: what the cell's neighbours across an edge have.
/// From outside m = 0.  Of far parts derivatives add up with their signs, gradients are worth nothing over the mean of
/// a cell; remainders in sum |b_P - m| remainder_P.  Near parts have
///
///   max and min of sum_P (b - m) F_P,    least_P <= F_P <= most_P,    sum_P F_P <= 1 - sum over far parts
///
/// of the most and the least b on them.  A cell most of whose doubt comes from near parts is cut into four, in which
/// those alone are looked at again.
struct CellTransport {
  std::vector<Branch> branches;
  std::vector<Leaf> leaves;

  const Cell& cell() const { return branches.front().cell; }
  const Cell& cell_of(const Leaf& leaf) const { return branches[leaf.branch].cell; }
};
/// @param deepest  how often the cell may be cut
CellTransport transport_over(const Surroundings& around, const Cell& cell, const LinearField& b, bool closed,
                             int deepest);

/// Memory that it takes [bytes].
std::size_t bytes_of(const CellTransport& transport);

}  // namespace interflect::fem
