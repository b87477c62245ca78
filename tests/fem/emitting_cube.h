#pragma once

#include "tests/fem/rooms.h"

namespace interflect::fem::test {

/// Of `cube`, whose walls are alike.
inline const scene::SurfaceId floor_id{4}, ceiling_id{5}, wall_id{0};

/// The unit cube of docs/truths.md 2.6: floor emits 1.
inline scene::Scene cube(double reflectance, double size = 1.0, const Vec3& low = Vec3::Zero()) {
  Room room;
  room.box(low, {size, size, size}, 1, true, reflectance);
  scene::Scene scene = room.finish();
  scene.materials[scene.surface(floor_id).material.value].exitance = Spectrum(1.0);
  return scene;
}

}  // namespace interflect::fem::test
