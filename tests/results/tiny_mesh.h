#pragma once

#include <array>

#include "mesh/element_mesh.h"

namespace tiny {

using namespace interflect;

/// Surface 0: two unit squares side by side in z = 0, from x = 0 to 2, facing up.  Surface 1: a triangle in z = 1, its
/// back.
inline mesh::ElementMesh mesh() {
  using scene::Side, scene::SurfaceId;
  const std::array<Vec3, 4> left{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
  const std::array<Vec3, 4> right{Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(2, 1, 0), Vec3(1, 1, 0)};
  const std::array<Vec3, 3> triangle{Vec3(0, 0, 1), Vec3(0, 1, 1), Vec3(1, 0, 1)};
  return mesh::ElementMesh({make_patch(SurfaceId{0}, Side::front, left), make_patch(SurfaceId{0}, Side::front, right),
                            make_patch(SurfaceId{1}, Side::back, triangle)});
}

}  // namespace tiny
