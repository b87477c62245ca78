#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "core/vec.h"
#include "mesh/element_mesh.h"
#include "mesh/smooth_mesh.h"
#include "results/colour_map.h"
#include "scene/scene.h"

namespace interflect::visual {

/// Polygons with colours at their corners: what is drawn.
struct Polygons {
  std::vector<Vec3> corners;             ///< polygon after polygon [m]
  std::vector<std::uint8_t> sizes;       ///< corners of each: 3 or 4
  std::vector<results::Colour> colours;  ///< one a corner
  void add(std::span<const Vec3> ring, std::span<const results::Colour> ring_colours);
};

/// Every element in one colour.
Polygons flat(const mesh::ElementMesh& mesh, std::span<const results::Colour> colours);

/// Linear red, green, blue over an element.
using Rgb = std::array<double, 3>;

/// Values smoothed inside each side of a surface, for looking: at a corner the mean of what its elements extrapolate to
/// it, each along the gradient that fits its neighbours best (least squares: exact for linear fields), not beyond half
/// of what they vary and not below 0.  Neighbours share a corner and lie within 20 degrees of the same plane.  Each
/// element becomes one triangle per edge.
Polygons smooth(const mesh::ElementMesh& mesh, std::span<const Rgb> values, double white);

/// Quadratic triangles as 16 flat ones each, in the colours of their values.
/// @param of_points  one a point
Polygons curved(const mesh::SmoothMesh& mesh, std::span<const Rgb> of_points, double white);
Polygons curved(const mesh::SmoothMesh& mesh, std::span<const double> of_points,
                const std::function<results::Colour(double)>& colour);

/// sRGB of `value` / white, clipped.
results::Colour display_colour(const Rgb& value, double white);

/// The backs of patches whose surface has no other active side, in one colour.
Polygons black_backs(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches, results::Colour colour);

}  // namespace interflect::visual
