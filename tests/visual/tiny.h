#pragma once

#include <array>

#include "mesh/element_mesh.h"
#include "scene/scene.h"

namespace tiny {

using namespace interflect;

/// Surface "floor": n x n square elements of [0, 2]² in z = 0, facing up, moved by `offset`.
struct Floor {
  scene::Scene scene;
  mesh::ElementMesh mesh;
  Vec3 offset;

  explicit Floor(int n, const Vec3& by = Vec3::Zero()) : mesh(elements(n, by)), offset(by) {
    const Vec3 &a = by, b = by + Vec3(2, 0, 0), c = by + Vec3(2, 2, 0), d = by + Vec3(0, 2, 0);
    scene.channels = {"grey"};
    scene.materials = {{"paint", Spectrum(0.5), {}, scene::Sides::front}};
    scene.surfaces = {{"floor", {}, 0, 2, {}}};
    scene.facets = {{{}, {a, b, c}, Vec3::UnitZ(), 2}, {{}, {a, c, d}, Vec3::UnitZ(), 2}};
  }

  scene::Camera camera(double height) const {
    return {"above", offset + Vec3(1.1, 0.9, height), offset + Vec3(1.1, 0.9, 0), Vec3::UnitY(), 40, 120, 90};
  }

  static std::vector<scene::SurfacePatch> elements(int n, const Vec3& by) {
    std::vector<scene::SurfacePatch> patches;
    const double h = 2.0 / n;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const Vec3 a = by + Vec3(i * h, j * h, 0), b = by + Vec3((i + 1) * h, j * h, 0),
                   c = by + Vec3((i + 1) * h, (j + 1) * h, 0), d = by + Vec3(i * h, (j + 1) * h, 0);
        patches.push_back(make_patch(scene::SurfaceId{0}, scene::Side::front, std::array{a, b, c, d}));
      }
    return patches;
  }
};

}  // namespace tiny
