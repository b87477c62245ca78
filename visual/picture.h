#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "core/image.h"
#include "mesh/element_mesh.h"
#include "mesh/smooth_mesh.h"
#include "results/colour_map.h"
#include "scene/scene.h"
#include "visual/display.h"
#include "visual/scale.h"

/// Pictures of values on elements, drawn off-screen.
///
/// A view is a camera of the scene, framed pixel by pixel as the path tracer frames it (sides without an element are
/// drawn dark); or, without one, from outside, through the walls whose backs one would see.  What is beside everything
/// is white in false colour, and grey where white is a colour of the map.
namespace interflect::visual {

/// Numbers as colours, with a legend.
struct FalseColour {
  std::string title;      ///< of the legend, with the unit: "irradiance [lx]" ("m2" is set as m²)
  std::string caption;    ///< over the picture
  std::string note = {};  ///< below it
  results::ColourMap map = results::ColourMap::plasma;
  /// May be logarithmic.  Default: 0 to the 99th percentile by area, rounded up; symmetric for blue_white_red.
  std::optional<Range> range = {};
  std::optional<scene::Camera> camera = {};
  int width = 1200, height = 900;  ///< of the view from outside [pixels]; a camera has its own
  bool edges = false;              ///< of the elements
  bool outlines = true;            ///< of faces of bodies, which one colour would hide
};

/// @param values  one per element; NaN: grey
core::Image false_colour(const Display& display, const scene::Scene& scene, const mesh::ElementMesh& mesh,
                         std::span<const double> values, const FalseColour& options);

/// The same of a continuous field, in colours that change inside elements; options have a range.
/// @param of_points  one per point of `smooth`, which is made of the mesh
core::Image false_colour(const Display& display, const scene::Scene& scene, const mesh::ElementMesh& mesh,
                         const mesh::SmoothMesh& smooth, std::span<const double> of_points, const FalseColour& options);

/// What an eye would see, tone mapped as results::ToneMapping says.
struct TrueColour {
  std::string caption;
  std::string note = {};  ///< below the picture
  double white = 0;       ///< value shown as white; 0: the 99th percentile by area
  bool smooth = true;     ///< interpolated inside surfaces; else each element in one colour
  std::optional<scene::Camera> camera = {};
  int width = 1200, height = 900;
};

/// @param rgb  linear red, green, blue per element, for instance scene.rgb(radiosity / pi)
core::Image true_colour(const Display& display, const scene::Scene& scene, const mesh::ElementMesh& mesh,
                        std::span<const std::array<double, 3>> rgb, const TrueColour& options);

/// The same of a continuous field; options have a white.
core::Image true_colour(const Display& display, const scene::Scene& scene, const mesh::ElementMesh& mesh,
                        const mesh::SmoothMesh& smooth, std::span<const std::array<double, 3>> of_points,
                        const TrueColour& options);

}  // namespace interflect::visual
