#pragma once

#include <atomic>
#include <vector>

#include "fem/form_factor/element_locator.h"
#include "fem/form_factor/element_shapes.h"
#include "fem/form_factor/method.h"

namespace interflect::fem {

/// Form factors of all pairs at once, by lines through everything [Sbert 1993, 1996].
///
/// Lines are uniform in the measure of integral geometry: a direction uniform on the sphere, a point uniform on the
/// disk of radius R across it, R and its centre those of a ball that holds all elements.  Such a line has density 1 /
/// (4 pi) [1/sr] times 1 / (pi R²) [1/m²], so that
///
///   P(it crosses a planar element) = int |cos| dw A / (4 pi pi R²) = A / (2 pi R²);  S / (4 pi R²) for a convex body of surface S
///   P(it leaves i and meets j next) = int_i int_j cos cos V / r² / (4 pi² R²) = K_ij / (4 pi R²),    the same for j and i
///
/// All that a line meets is taken in order; each two that follow each other, the first seen from behind and the second
/// from in front, are an exchange used both ways.  With N_ij of them among N lines,
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

  double radius() const { return radius_; }  ///< R [m]
  std::uint64_t lines() const { return lines_; }

  /// Elements that leave and meet the line in turn, along one line.
  struct Pair {
    Index from, to;
  };
  /// Line k as a ray from outside, a function of (seed, k).
  raycast::Ray line(std::uint64_t k) const;
  /// The exchanges along a line. @param hits  memory to reuse  @param pairs  overwritten
  void pairs_along(const raycast::Ray& line, std::vector<scene::SurfacePoint>& hits, std::vector<Pair>& pairs) const;

 private:
  class Counts;

  PairCounts add_row(Index a, const Counts& found, ExchangeSink& sink) const;
  void shoot(std::uint64_t begin, std::uint64_t end, Counts& found) const;

  FormFactorContext context_;
  std::uint64_t seed_;
  ElementShapes shapes_;
  ElementLocator locate_;
  Vec3 centre_;
  double radius_ = 0;
  std::uint64_t lines_ = 0;
};

}  // namespace interflect::fem
