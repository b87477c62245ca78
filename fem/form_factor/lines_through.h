#pragma once

#include <span>
#include <vector>

#include "fem/form_factor/element_locator.h"
#include "raycast/ray_caster.h"
#include "solvers/transition_sampler.h"

namespace interflect::fem {

/// Lines through all elements, uniform in the measure of integral geometry [Sbert 1993, 1996]: a direction uniform on
/// the sphere, a point uniform on the disk of radius R across it, R and its centre those of a ball that holds all
/// elements. Such a line has density 1 / (4 pi) [1/sr] times 1 / (pi R²) [1/m²], so that
///
///   P(it crosses a planar element) = int |cos| dw A / (4 pi pi R²) = A / (2 pi R²);
///                                    S / (4 pi R²) for a convex body of surface S
///   P(it leaves i and meets j next) = int_i int_j cos cos V / r² / (4 pi² R²) = K_ij / (4 pi R²),
///                                    the same for j and i
///
/// All that a line meets is taken in order; each two that follow each other, the first seen from behind and the second
/// from in front, are an exchange.
class LinesThrough final : public solvers::LineExchanges {
 public:
  /// All outlive this.
  LinesThrough(std::span<const scene::SurfacePatch> patches, const raycast::RayCaster& rays,
               const ElementLocator& locate);

  double radius() const { return radius_; }  ///< R [m]
  /// A line as a ray from outside.  @param u  four numbers in [0, 1)
  raycast::Ray line(std::span<const double> u) const;
  /// What exchanges light along a line.  @param hits  memory to reuse  @param pairs  overwritten
  void pairs_along(const raycast::Ray& line, std::vector<scene::SurfacePoint>& hits,
                   std::vector<Exchange>& pairs) const;

  int dimensions() const override { return 4; }
  double measure() const override { return 4 * pi * radius_ * radius_; }
  void along(std::span<const double> u, std::vector<Exchange>& exchanges) const override;

 private:
  const raycast::RayCaster& rays_;
  const ElementLocator& locate_;
  Vec3 centre_;
  double radius_ = 0;
};

}  // namespace interflect::fem
