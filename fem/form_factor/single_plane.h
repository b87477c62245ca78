#pragma once

#include "fem/form_factor/row_method.h"

namespace interflect::fem {

/// "single-plane": one square plane over each element's centroid, at height 1, of half side D = 10, by Warnock's
/// subdivision [Sillion, Puech 1989] "A general two-pass method integrating specular and diffuse reflection", SIGGRAPH
/// 89.
///
/// What arrives from beyond the square is lost, of every row
///
///   1 - 4/pi D/sqrt(1+D²) atan(D/sqrt(1+D²))   = 0.0081 for D = 10
///
/// and reported (PairCounts::lost, and in the bounds of the entries that it is missing from); nothing is renormalised.
/// D = 10 leaves out what stands lower than 5.7 degrees over the horizon: less than the centroid errs by as a single
/// view point in a room of elements of an ordinary size (docs/hemicube.md).  The loss falls as 0.82 / D², so that a
/// greater plane helps a row's sum fast, at little cost, since far cells are large; but whatever D is, the foot of a
/// wall that stands beside the element lies beyond the edge.
///
/// Cells are cut until their form factor is at most that of a hemicube's largest cell, 4 / (pi resolution²).
class SinglePlane final : public RowMethod {
 public:
  static constexpr double usual_half_side = 10;

  explicit SinglePlane(const FormFactorContext& context) : SinglePlane(context, usual_half_side) {}
  /// @param half_side  D > 0
  SinglePlane(const FormFactorContext& context, double half_side);

  std::string name() const override { return "single-plane"; }
  double lost() const override;

 private:
  class View;
  std::unique_ptr<Sight> sight() const override;

  double half_side_;
  int resolution_;
};

}  // namespace interflect::fem
