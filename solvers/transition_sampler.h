#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/vec.h"

namespace interflect::solvers {

/// Rays between points of elements: for functions that are no constants, and for walks that go on from where they
/// arrived.
class PointTransitions {
 public:
  struct Point {
    Index element;
    Vec3 position;  ///< [m], in whatever place the points themselves mean
  };
  virtual ~PointTransitions() = default;
  /// How many functions an element has.
  virtual int functions() const = 0;
  virtual double area(Index element) const = 0;  ///< A [m²]
  /// A point of density 1 / A on an element.  @param u  two numbers in [0, 1)
  virtual Point point_on(Index element, std::span<const double> u) const = 0;
  /// Where a direction of density cos / pi leads.  @param u  two numbers in [0, 1)
  virtual std::optional<Point> from_point(const Point& point, std::span<const double> u) const = 0;
  /// N_a(x) of the functions of its element.  @param values  overwritten: functions()
  virtual void functions_at(const Point& point, std::span<double> values) const = 0;
};

/// Lines through everything, uniform as integral geometry has them: what leaves each other along one.
class LineExchanges {
 public:
  struct Exchange {
    Index from, to;
  };
  virtual ~LineExchanges() = default;
  /// How many uniform numbers a line takes.
  virtual int dimensions() const = 0;
  /// 4 pi R² [m²], R of the ball that lines cross: a line expects K_ij / measure() exchanges from i to j.
  virtual double measure() const = 0;
  /// @param u  in [0, 1)  @param exchanges  overwritten.  From any thread.
  virtual void along(std::span<const double> u, std::vector<Exchange>& exchanges) const = 0;
};

/// What random walks see of geometry: where light that leaves an unknown arrives.  Of constants, whose unknowns are
/// elements.
///
///   P(from_element(i) = j) = F_ij = K_ij / G_i,     nothing: it arrives nowhere, 1 - sum_j F_ij
class TransitionSampler {
 public:
  virtual ~TransitionSampler() = default;
  /// How many uniform numbers a draw takes.
  virtual int dimensions() const = 0;
  /// @param u  in [0, 1).  From any thread.
  virtual std::optional<Index> from_element(Index i, std::span<const double> u) const = 0;

  static constexpr Index nowhere = -1;
  /// The same of many: arrived[k] of from[k], or nowhere.  By default one after the other.
  /// @param u  dimensions() numbers of each after the other  @param arrived  overwritten; as many as `from`
  virtual void from_elements(std::span<const Index> from, std::span<const double> u, std::span<Index> arrived) const {
    const auto draw = static_cast<std::size_t>(dimensions());
    for (std::size_t k = 0; k < from.size(); ++k)
      arrived[k] = from_element(from[k], u.subspan(k * draw, draw)).value_or(nowhere);
  }

  virtual const PointTransitions* points() const { return nullptr; }
  virtual const LineExchanges* lines() const { return nullptr; }
};

}  // namespace interflect::solvers
