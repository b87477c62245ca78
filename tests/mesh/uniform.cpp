#include "mesh/uniform.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "tests/mesh/scenes.h"

using namespace interflect;
using namespace interflect::mesh;

namespace {

class AtEveryScale : public testing::TestWithParam<double> {};

}  // namespace

// A sum of n areas, each with the rounding of coordinates as large as the room beside an element of 1/50 of it.
TEST_P(AtEveryScale, conserves_the_area_of_every_side_of_every_surface) {
  const scene::Scene scene = mixed_scene(GetParam());
  const ElementMesh mesh = uniform(scene, 0.17 * GetParam());
  for (const auto& part : mesh.parts()) {
    double area = 0;
    for (const auto& patch : mesh.patches().subspan(part.first, part.count)) {
      area += patch.area;
      EXPECT_GT(patch.area, 0);
    }
    EXPECT_NEAR(area, scene.area(part.surface), 1e-12 * area) << scene.surface(part.surface).name;
  }
}

TEST_P(AtEveryScale, cuts_until_no_edge_is_longer_than_asked_for) {
  for (const double edge : {10.0, 1.0, 0.3, 0.11}) {
    const ElementMesh mesh = uniform(mixed_scene(GetParam()), edge * GetParam());
    EXPECT_LE(longest_edge(mesh), edge * GetParam() * (1 + 1e-9));
    EXPECT_DOUBLE_EQ(mesh.longest_edge(), longest_edge(mesh));
  }
}

// Every directed edge is run along once; an edge without a partner lies on the surface's boundary, and the boundary
// edges add up to its length: no T-junction, whose long edge and two short ones would be open inside.
TEST_P(AtEveryScale, is_conforming_inside_every_side) {
  const double s = GetParam();
  const scene::Scene scene = mixed_scene(s);
  const ElementMesh mesh = uniform(scene, 0.21 * s);
  for (const auto& part : mesh.parts()) {
    const scene::Surface& surface = scene.surface(part.surface);
    const EdgeCensus census(mesh, part);
    for (const auto& [edge, count] : census.edges) EXPECT_EQ(count, 1) << surface.name;
    double open = 0, perimeter = 0;
    for (const auto& [a, b] : census.open()) open += (b - a).norm();
    const auto add_ring = [&](const geometry::Ring& ring) {
      for (std::size_t k = 0; k < ring.size(); ++k) perimeter += (ring[(k + 1) % ring.size()] - ring[k]).norm();
    };
    if (surface.outline) add_ring(surface.outline->outer);
    if (surface.outline)
      for (const auto& hole : surface.outline->holes) add_ring(hole);
    EXPECT_NEAR(open, perimeter, 1e-9 * s) << surface.name;
  }
}

TEST_P(AtEveryScale, keeps_elements_planar_and_turned_the_way_their_side_looks) {
  const double s = GetParam();
  const scene::Scene scene = mixed_scene(s);
  const ElementMesh mesh = uniform(scene, 0.25 * s);
  for (const auto& patch : mesh.patches()) {
    const Vec3 normal = patch.normal();
    for (const Vec3& corner : patch.ring()) EXPECT_NEAR(normal.dot(corner - patch.corner[0]), 0, 1e-14 * s);
    const scene::Surface& surface = scene.surface(patch.surface);
    const double sign = patch.side == scene::Side::front ? 1 : -1;
    if (surface.outline) {
      EXPECT_GT(sign * normal.dot(geometry::plane_of(surface.outline->outer).normal), 1 - 1e-12);
    } else {
      EXPECT_GT(sign * normal.dot(patch.centroid().normalized()), 0.9) << "the sphere looks outward";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scales, AtEveryScale, testing::Values(1.0, 1e-6, 1e6), [](const auto& which) {
  return which.param == 1 ? "metres" : which.param < 1 ? "micrometres" : "megametres";
});

TEST(Uniform, lists_surfaces_in_order_and_fronts_before_backs) {
  const scene::Scene scene = mixed_scene();
  const ElementMesh mesh = uniform(scene, 0.5);
  std::uint32_t next = 0;
  std::size_t at = 0;
  for (const auto id : scene.surface_ids())
    for (const auto side : {scene::Side::front, scene::Side::back}) {
      if (!scene.material(id).active(side)) continue;
      ASSERT_LT(at, mesh.parts().size());
      const auto& part = mesh.parts()[at++];
      EXPECT_EQ(part.surface, id);
      EXPECT_EQ(part.side, side);
      EXPECT_EQ(part.first, next);
      next += part.count;
      for (const auto& patch : mesh.patches().subspan(part.first, part.count)) {
        EXPECT_EQ(patch.surface, id);
        EXPECT_EQ(patch.side, side);
      }
    }
  EXPECT_EQ(at, mesh.parts().size());
  EXPECT_EQ(next, mesh.size());
}

TEST(Uniform, gives_both_sides_the_same_elements_from_either_side) {
  const scene::Scene scene = mixed_scene();
  const ElementMesh mesh = uniform(scene, 0.2);
  int backs = 0;
  for (std::size_t p = 0; p + 1 < mesh.parts().size(); ++p) {
    const auto &front = mesh.parts()[p], &back = mesh.parts()[p + 1];
    if (back.side != scene::Side::back) continue;
    ++backs;
    ASSERT_EQ(front.count, back.count);
    for (std::uint32_t i = 0; i < front.count; ++i) {
      const auto &f = mesh.patch({front.first + i}), &b = mesh.patch({back.first + i});
      EXPECT_NEAR(f.area, b.area, 1e-15);
      EXPECT_LT(f.normal().dot(b.normal()), -1 + 1e-12);
      EXPECT_LT((f.centroid() - b.centroid()).norm(), 1e-15);
    }
  }
  EXPECT_EQ(backs, 2);
}

TEST(Uniform, cuts_a_rectangle_into_a_grid_of_quads) {
  scene::SceneBuilder builder({"grey"});
  builder.add_polygon("floor", {ring_at(1, {{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}}), {}},
                      builder.add_material(material()));
  const scene::Scene scene = builder.finish();
  EXPECT_EQ(uniform(scene, 0.5).size(), 6 * 4) << "a length that is a multiple of the edge does not spill over";
  EXPECT_EQ(uniform(scene, 0.49).size(), 7 * 5);
  EXPECT_EQ(uniform(scene, 5).size(), 1);
  const ElementMesh mesh = uniform(scene, 0.1);
  for (const auto& patch : mesh.patches()) {
    EXPECT_EQ(patch.corners, 4);
    EXPECT_NEAR(patch.area, 0.01, 1e-15);
  }
}

TEST(Uniform, meshes_a_quad_with_a_corner_in_mid_edge_or_pointing_inward_by_triangles) {
  scene::SceneBuilder builder({"grey"});
  const auto m = builder.add_material(material());
  builder.add_polygon("straight", {ring_at(1, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 2, 0}}), {}}, m);
  builder.add_polygon("arrow", {ring_at(1, {{0, 0, 1}, {2, 0, 1}, {0.5, 0.5, 1}, {0, 2, 1}}), {}}, m);
  const scene::Scene scene = builder.finish();
  const ElementMesh mesh = uniform(scene, 0.3);
  double area = 0;
  for (const auto& patch : mesh.patches()) {
    EXPECT_EQ(patch.corners, 3);
    area += patch.area;
  }
  EXPECT_NEAR(area, 2.0 + 1.0, 1e-12);
}

// triangulate_refined asks for 20.7 degrees where the outline allows: here its corners are right angles.
TEST(Uniform, makes_well_shaped_triangles_of_a_polygon_with_a_hole) {
  scene::SceneBuilder builder({"grey"});
  builder.add_polygon("L", l_with_hole(1), builder.add_material(material()));
  const scene::Scene scene = builder.finish();
  for (const double edge : {2.0, 0.5, 0.1}) {
    const ElementMesh mesh = uniform(scene, edge);
    for (const auto& patch : mesh.patches()) EXPECT_GT(smallest_angle_deg(patch), 20.0);
  }
}

TEST(Uniform, refuses_an_edge_that_is_no_positive_length) {
  const scene::Scene scene = mixed_scene();
  for (const double bad :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(uniform(scene, bad), core::InputError) << bad;
}

// 3 m / 1e-20 m is beyond every integer.
TEST(Uniform, refuses_more_elements_than_can_be_numbered_in_one_line) {
  scene::SceneBuilder builder({"grey"});
  const auto m = builder.add_material(material());
  builder.add_polygon("floor", {ring_at(1, {{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}}), {}}, m);
  scene::SceneBuilder of_triangles({"grey"});
  of_triangles.add_facets("mesh", test::icosphere(0, 1, false), of_triangles.add_material(material()));
  for (const scene::Scene& scene : {builder.finish(), of_triangles.finish(), mixed_scene()})
    for (const double edge : {2e-5, 1e-20, 1e-200, 1e-308}) {
      try {
        uniform(scene, edge);
        FAIL() << "an InputError expected: " << edge;
      } catch (const core::InputError& error) {
        EXPECT_EQ(core::single_line(error.what()), error.what());
        EXPECT_NE(std::string(error.what()).find("element size"), std::string::npos) << error.what();
      }
    }
}

TEST(Uniform, repeats_itself_bit_by_bit) {
  const ElementMesh a = uniform(mixed_scene(), 0.2), b = uniform(mixed_scene(), 0.2);
  ASSERT_EQ(a.size(), b.size());
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(a.size()); ++i)
    EXPECT_EQ(a.patch({i}).corner, b.patch({i}).corner);
}
