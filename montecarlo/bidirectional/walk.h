#pragma once

#include <limits>
#include <vector>

#include "measure/path_classes.h"
#include "montecarlo/bidirectional/partial_weights.h"
#include "montecarlo/bsdf/bsdf.h"
#include "montecarlo/light/light_set.h"
#include "montecarlo/warp.h"
#include "scene/place.h"

namespace interflect::montecarlo {

/// A place of a surface, or of what is measured, that a walk has come to.
struct WalkVertex {
  Vec3 position;
  Frame frame;         ///< about the normal of the front
  Vec3 back;           ///< in the frame: to the vertex before; of a receiver its normal
  const Bsdf* bsdf;    ///< null: black
  Spectrum carried{};  ///< from a light flux [W | lm], from the eye what radiance that leaves from here counts
  PartialWeights weights;
  int vertices = 1;  ///< of the walk, with its end and this one

  Vec3 to_local(const Vec3& world) const { return frame.to_local(world); }
  /// The side that a direction of the frame leads to.
  Vec3 side(const Vec3& local) const { return local.z() >= 0 ? frame.n : Vec3(-frame.n); }
  /// As lights are picked for it.
  Place place() const { return {position, bsdf != nullptr && bsdf->transmits() ? Vec3(Vec3::Zero()) : side(back)}; }
};

/// A light that a walk set out from.
struct LightStart {
  std::uint32_t light = 0;
  Vec3 position, normal, way;  ///< Emission
  double pdf = 0;              ///< of x_0, with the pick [1/m²; 1/sr from afar; 1 of a point]
  double pdf_way = 0;          ///< of the rest [1/sr; 1/m² across the way from afar]
};

struct LightVertex : WalkVertex {
  scene::SurfacePoint hit;
  measure::PathClasses::FromLight letters;  ///< of the walk so far, without what is done here
  double pdf_area;                          ///< with which it was arrived at
};

inline Spectrum no_number() { return Spectrum(std::numeric_limits<double>::quiet_NaN()); }

/// What a walk carries to a place that it arrives at with this density per area.
///
/// f / p where p is 0 is no number, and is made none: it shows in what is found, and is counted there as samples that
/// are not finite are (SampleReport).  It would be a bug: a walk goes where it has drawn with p > 0 alone.  A walk
/// within the surface that it meets, |cos| = 0, is another matter, and is left out before: f has the same factor G as
/// p, so that paths by that place bring nothing, whatever comes before or after.
/// Test: tests/montecarlo/zero_density.cpp
inline Spectrum carried_to(const Spectrum& carried, double pdf_area) { return pdf_area > 0 ? carried : no_number(); }

/// A walk from a light: its vertices on surfaces, x_1 first.
struct LightWalk {
  LightStart start;
  std::vector<LightVertex> vertices;
};

}  // namespace interflect::montecarlo
