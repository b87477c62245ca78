#include "mesh/smooth_mesh.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/mesh/scenes.h"

namespace interflect::mesh {
namespace {

/// Elements cut in part twice over, so that two corners hang on some edges.
ElementMesh hanging(const scene::Scene& scene) {
  ElementMesh mesh = uniform(scene, 0.9);
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<bool> which(mesh.patches().size());
    for (std::size_t i = static_cast<std::size_t>(pass); i < which.size(); i += 5) which[i] = true;
    mesh = quartered(mesh, which).mesh;
  }
  return mesh;
}

// Triangles cover each element: the middles of their edges are there, their areas add up.
TEST(SmoothMesh, covers_the_elements) {
  const ElementMesh mesh = hanging(mixed_scene());
  const SmoothMesh smooth = smooth_mesh(mesh);
  std::vector<double> area(mesh.patches().size());
  for (std::size_t t = 0; t < smooth.triangles.size(); ++t) {
    std::array<Vec3, 6> p;
    for (std::size_t k = 0; k < 6; ++k) p[k] = smooth.points[smooth.triangles[t][k]];
    for (std::size_t k = 0; k < 3; ++k) EXPECT_LE((p[3 + k] - 0.5 * (p[k] + p[(k + 1) % 3])).norm(), 1e-15);
    const Vec3 twice = (p[1] - p[0]).cross(p[2] - p[0]);
    area[smooth.element[t]] += 0.5 * twice.dot(mesh.patches()[smooth.element[t]].normal());
  }
  for (std::size_t i = 0; i < area.size(); ++i) EXPECT_NEAR(area[i], mesh.patches()[i].area, 1e-12 * area[i]);
}

// Inside a plane every edge but those of its outline is the edge of two triangles, with the same three points: no
// cracks.
TEST(SmoothMesh, has_no_cracks) {
  const scene::Scene scene = mixed_scene();
  const ElementMesh mesh = hanging(scene);
  const SmoothMesh smooth = smooth_mesh(mesh);
  std::map<std::array<std::uint32_t, 3>, int> edges;  // ends in order, and the middle
  std::size_t elements_between = 0;
  for (std::size_t n = 0; n < smooth.triangles.size(); ++n) {
    const SmoothMesh::Triangle& t = smooth.triangles[n];
    if (scene.surface(mesh.patches()[smooth.element[n]].surface).name == "lamp") continue;  // a ball: no outline
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      ++edges[{std::min(a, b), std::max(a, b), t[3 + k]}];
    }
  }
  double open = 0;
  for (const auto& [edge, count] : edges) {
    EXPECT_LE(count, 2);
    if (count == 2) elements_between += smooth.around[edge[2]].size() == 2;
    if (count == 1) open += (smooth.points[edge[0]] - smooth.points[edge[1]]).norm();
  }
  // Outlines: of the six walls and the desk's sides, which share none; of two sides each of the screen and the shelf.
  double expected = 4 * (5 + 4) + 4 * (4 + 3) + 4 * (5 + 3);
  expected += 4 * (1 + .7) + 4 * (.7 + .7) + 4 * (1 + .7);
  const double screen = 1 + std::hypot(.3, 1.2) + std::hypot(.6, .3) + std::hypot(.1, .9);
  const double shelf = .3 * (2 * (4 + 3) + 4 * .5);
  expected += 2 * (screen + shelf);
  EXPECT_NEAR(open, expected, 1e-9);
  EXPECT_GT(elements_between, 0u);
}

// A quadratic function comes back at every point; one that differs from element to element as the mean.
TEST(SmoothMesh, takes_means_at_points) {
  const ElementMesh mesh = hanging(mixed_scene());
  const SmoothMesh smooth = smooth_mesh(mesh);
  const auto f = [](const Vec3& x) { return x.x() * x.y() + x.z() * x.z(); };
  const auto values = smoothed<double>(smooth, [&](std::uint32_t, const Vec3& x) { return f(x); });
  const auto numbers = smoothed<double>(smooth, [](std::uint32_t i, const Vec3&) { return static_cast<double>(i); });
  for (std::size_t p = 0; p < values.size(); ++p) {
    EXPECT_NEAR(values[p], f(smooth.points[p]), 1e-12);
    double sum = 0;
    for (const std::uint32_t i : smooth.around[p]) sum += i;
    EXPECT_DOUBLE_EQ(numbers[p], sum / static_cast<double>(smooth.around[p].size()));
  }
}

}  // namespace
}  // namespace interflect::mesh
