#pragma once

#include <string>

#include "core/vec.h"

namespace interflect::scene {

/// A pinhole camera.  A pixel's value is the mean radiance over its area on the image plane.
struct Camera {
  std::string name;
  Vec3 eye, target;
  Vec3 up;
  double fov_y_deg = 50;  ///< full vertical angle of view
  int width = 800, height = 600;

  /// Unit direction through image point (x, y) in pixels from the top left: pixel (i, j) covers [i, i+1) x [j, j+1).
  Vec3 direction(double x, double y) const;
};

}  // namespace interflect::scene
