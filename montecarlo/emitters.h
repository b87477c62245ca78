#pragma once

#include "montecarlo/alias_table.h"
#include "scene/scene.h"

namespace interflect::montecarlo {

/// A point on a light.
struct EmitterSample {
  Vec3 position, normal;  ///< of the emitting side
  Spectrum exitance;      ///< E; its radiance is E / pi
  double pdf_area;        ///< [1/m²]
};

/// The facets whose front emits.  A facet is picked by A max_c E_c and a point of it uniformly, so that
///
///   pdf_area(y) = max_c E_c(y) / sum_facets A max_c E_c   [1/m²].
class Emitters {
 public:
  explicit Emitters(const scene::Scene& scene);

  bool empty() const { return picks_.size() == 0; }
  /// @param pick, u, v  uniform in [0, 1); not for a scene without emitters
  EmitterSample sample(double pick, double u, double v) const;
  /// What `sample` would have done to arrive at a point of this facet's front; 0 if it does not emit [1/m²].
  double pdf_area(std::uint32_t facet) const { return pdf_area_[facet]; }
  const Spectrum& max_exitance() const { return max_exitance_; }  ///< channel by channel [W/m² | lm/m²]

 private:
  struct Emitter {
    std::array<Vec3, 3> corner;
    Vec3 normal;
    Spectrum exitance;
    double pdf_area;
  };
  std::vector<Emitter> emitters_;
  AliasTable picks_;
  std::vector<double> pdf_area_;  ///< per facet of the scene
  Spectrum max_exitance_;
};

}  // namespace interflect::montecarlo
