#pragma once

#include "scene/scene.h"

/// What every ray caster needs of a scene before it builds anything.
namespace interflect::raycast {

/// Where the scene's facets lie and how large they are.  Rays are traced about `centre`, so that a scene far from the
/// origin loses no more than its own coordinates have lost already.
struct SceneFrame {
  Vec3 centre = Vec3::Zero();  ///< of the facets' box [m]
  double size = 1;             ///< largest dimension of the box [m]; 1 without facets
  double rounding = 0;         ///< 2^-49 of the largest coordinate [m]: how far off its plane a rounded point may lie

  /// Offset for surfaces, `relative` to the size but never below what the coordinates themselves resolve [m].
  double offset(double relative) const { return std::max(relative * size, rounding); }
};

SceneFrame frame_of(const scene::Scene& scene);

/// A hit at barycentric (u, v) of a facet, which may stick out of it by rounding and are clamped into it.  The side is
/// the one that `direction` comes from; the position is computed from the facet's own corners, so that it lies on its
/// plane.
scene::SurfacePoint surface_point(const scene::Facet& facet, std::uint32_t index, const Vec3& direction, double u,
                                  double v);

}  // namespace interflect::raycast
