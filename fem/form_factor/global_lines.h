#pragma once

#include <atomic>
#include <vector>

#include "fem/form_factor/element_locator.h"
#include "fem/form_factor/element_shapes.h"
#include "fem/form_factor/lines_through.h"
#include "fem/form_factor/method.h"

namespace interflect::fem {

/// Form factors of all pairs at once, by lines through everything [Sbert 1993, 1996].
///
/// Lines are uniform as integral geometry has them, and each exchange along one (lines_through.h) is used both ways. 
/// With N_ij of them among N lines,
///
///   K_ij = 2 pi R² N_ij / N
///
/// N_ij is binomial, exactly, since a line meets a plane once: the standard error is that of counted_exchange.h.
/// Entries are correlated: pairs of one side of an element exclude each other on a line (covariance -K K' / N each, as
/// in a multinomial), pairs of different elements may come on one line (positive where they lie behind each other); a
/// convex room has one pair a line, and sums of a row are binomial like its entries.
///
/// The reach of the method: an element gets N A / (2 pi R²) lines, however small it is.  An entry above the smaller
/// area is pulled back; of elements that expect few hits that cuts much, and it is counted.
///
/// Samples: N lines as asked for; 0: as many as give the element of mean area 1 / tolerance² of them, 16 384 at most.
class GlobalLines final : public FormFactorMethod {
 public:
  explicit GlobalLines(const FormFactorContext& context);
  std::string name() const override { return "global-lines"; }
  Granularity granularity() const override { return Granularity::all; }
  PairCounts exchange(const ElementBlock& rows, const ElementBlock& columns, ExchangeSink& sink,
                      const Run& run) const override;
  double trial(const Run& run) const override;

  const LinesThrough& through() const { return through_; }
  std::uint64_t lines() const { return lines_; }
  /// Line k, a function of (seed, k).
  raycast::Ray line(std::uint64_t k) const;

 private:
  class Counts;

  PairCounts add_row(Index a, const Counts& found, ExchangeSink& sink) const;
  void shoot(std::uint64_t begin, std::uint64_t end, Counts& found) const;

  FormFactorContext context_;
  std::uint64_t seed_;
  ElementShapes shapes_;
  ElementLocator locate_;
  LinesThrough through_;
  std::uint64_t lines_ = 0;
};

}  // namespace interflect::fem
