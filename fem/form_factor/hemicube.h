#pragma once

#include <string>

#include "fem/form_factor/hemicube_grid.h"
#include "fem/form_factor/row_method.h"

namespace interflect::fem {

/// Form factors by a Z-buffer on half a cube about each element's centroid [Cohen, Greenberg 1985] "The hemi-cube: a
/// radiosity solution for complex environments", SIGGRAPH 85.  What differs here: cells by exact integrals, so that a
/// closed row sums to 1; a random azimuth; and an error with each entry (row_method.h).
///
/// Its three assumptions [Baum, Rushmeier, Winget 1989] stay: that the distance is large against the element (one at
/// the centre of a unit square converges to 0.1901 for the perpendicular square at its edge, whose form factor is
/// 0.2000), that visibility is the same all over the element, and that items are larger than cells.
class Hemicube : public RowMethod {
 public:
  std::string name() const override { return name_; }

 protected:
  Hemicube(const FormFactorContext& context, std::string name, HemicubeGrid grid);

 private:
  std::unique_ptr<Sight> sight() const override;

  std::string name_;
  HemicubeGrid grid_;
};

/// "hemicube": equal cells, weights exact.
class ExactHemicube final : public Hemicube {
 public:
  explicit ExactHemicube(const FormFactorContext& context);
};

/// "hemicube-midpoint": equal cells, weights as printed in 1985, whose sum is 1 + 0.54 / resolution².
class MidpointHemicube final : public Hemicube {
 public:
  explicit MidpointHemicube(const FormFactorContext& context);
};

/// "hemicube-max": cells that err least for their number (max_cells.h).
class MaxHemicube final : public Hemicube {
 public:
  explicit MaxHemicube(const FormFactorContext& context);
};

}  // namespace interflect::fem
