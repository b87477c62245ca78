#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"
#include "scene/camera.h"
#include "visual/display.h"
#include "visual/outlines.h"
#include "visual/shading.h"

namespace interflect::visual {

/// Polygons and the face that each is a part of.
struct Layer {
  Polygons polygons;
  std::vector<std::uint32_t> faces;
};

/// What stands before a camera, drawn without light: colours are what they are.
struct Raster {
  Polygons fronts;  ///< seen from the side around which their corners run counter-clockwise
  /// Of each of them: Samples::back, or the number of what it is a part of, from 1.  May be empty: then there are no
  /// outlines, and specks of backs stay.
  std::vector<std::uint32_t> faces;
  Layer bare;                   ///< besides: what has no edges
  std::vector<Polygons> clear;  ///< bodies behind which all else shows, each other too; all hatched
  std::uint32_t hatched = 0;    ///< faces 1 .. hatched are (hatching.h), wherever they are
  bool edges = false;           ///< of polygons, drawn over them, a quarter dark
  bool outlines = false;        ///< of faces; clear bodies have them anyway
  results::Colour background{255, 255, 255};
  scene::Camera camera;  ///< pixels as in scene::Camera
};

/// [0, 1] sRGB, channels R, G, B.  Every pixel is the mean of 3 x 3 (2 x 2 and 1 above 2 700 and 4 000 pixels a side).
/// @param any_hatched  whether anything in it is, if asked
core::Image rasterised(const Display& display, const Raster& raster, bool* any_hatched = nullptr);

}  // namespace interflect::visual
