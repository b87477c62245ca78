#pragma once

#include <memory>

#include "fem/form_factor/method.h"
#include "fem/form_factor/proximity.h"

namespace interflect::fem {

/// Methods that see a whole row at once from the element's centroid: K_ab = A_a F_{centroid -> b}.
///
/// The azimuth of the view is random, keyed by (seed, element), so that edges that are parallel in the scene do not err
/// together.
///
/// An entry's bound is an estimate, of which 95 % or more hold (tests/fem/hemicube.cpp):
///
///   A_a ( 3 sqrt(border / 17) + proximity + beyond )
///
/// where `border` sums the squares of cells that the item's edges may cut (three standard deviations of aliasing,
/// seen_items.h), `proximity` is what one view point costs (proximity.h), and `beyond` is the part that lies outside of
/// the view.  An item that no cell sees has an entry of K = 0, with a bound.
class RowMethod : public FormFactorMethod {
 public:
  Granularity granularity() const final { return Granularity::row; }
  PairCounts exchange(const ElementBlock& rows, const ElementBlock& columns, ExchangeSink& sink,
                      const Run& run) const final;

 protected:
  explicit RowMethod(const FormFactorContext& context);

  virtual std::unique_ptr<Sight> sight() const = 0;
  /// Part of every row that the view leaves out, in [0, 1).
  virtual double lost() const { return 0; }

 private:
  struct Memory;
  void look(Index element, Memory& memory) const;
  ExchangeEntry entry(Index a, Index b, const Memory& memory, PairCounts& counts) const;

  std::uint64_t seed_;
  ElementShapes shapes_;
  ViewScene scene_;
  ProximityError proximity_;
};

/// Cells across a view for what a user asks for: even, and at least 2.
int even_resolution(int asked);

}  // namespace interflect::fem
