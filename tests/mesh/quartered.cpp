#include <gtest/gtest.h>

#include "tests/mesh/scenes.h"

using namespace interflect;
using namespace interflect::mesh;

TEST(Quartered, lists_the_four_parts_of_element_i_from_4i_and_conserves_its_area) {
  const ElementMesh coarse = uniform(mixed_scene(), 0.5), fine = quartered(coarse);
  ASSERT_EQ(fine.size(), 4 * coarse.size());
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(coarse.size()); ++i) {
    const auto& parent = coarse.patch({i});
    double area = 0;
    Vec3 moment = Vec3::Zero();
    for (std::uint32_t k = 0; k < 4; ++k) {
      const auto& part = fine.patch({4 * i + k});
      EXPECT_EQ(part.surface, parent.surface);
      EXPECT_EQ(part.side, parent.side);
      EXPECT_EQ(part.corners, parent.corners);
      EXPECT_GT(part.normal().dot(parent.normal()), 1 - 1e-12);
      for (const Vec3& corner : part.ring()) {
        const ElementPoint inside = coordinates_in(parent, {i}, corner);
        const Vec3 again = parent.corners == 3 ? Vec3((1 - inside.u - inside.v) * parent.corner[0] +
                                                      inside.u * parent.corner[1] + inside.v * parent.corner[2])
                                               : Vec3((1 - inside.u) * (1 - inside.v) * parent.corner[0] +
                                                      inside.u * (1 - inside.v) * parent.corner[1] +
                                                      inside.u * inside.v * parent.corner[2] +
                                                      (1 - inside.u) * inside.v * parent.corner[3]);
        EXPECT_LE((again - corner).norm(), 1e-14) << "a corner of a part lies in its parent";
      }
      area += part.area;
      moment += part.area * part.centroid();
    }
    EXPECT_NEAR(area, parent.area, 1e-13 * parent.area);
    EXPECT_LE((moment / area - parent.centroid()).norm(), 1e-14);
  }
}

TEST(Quartered, halves_every_edge_and_stays_conforming) {
  const scene::Scene scene = mixed_scene();
  const ElementMesh coarse = uniform(scene, 0.4), fine = quartered(coarse);
  EXPECT_LE(fine.longest_edge(), 0.5 * coarse.longest_edge() * (1 + 1e-12));
  ASSERT_EQ(fine.parts().size(), coarse.parts().size());
  for (std::size_t p = 0; p < fine.parts().size(); ++p) {
    EXPECT_EQ(fine.parts()[p].first, 4 * coarse.parts()[p].first);
    const EdgeCensus of_fine(fine, fine.parts()[p]), of_coarse(coarse, coarse.parts()[p]);
    EXPECT_EQ(of_fine.open().size(), 2 * of_coarse.open().size()) << scene.surface(fine.parts()[p].surface).name;
    for (const auto& [edge, count] : of_fine.edges) EXPECT_EQ(count, 1);
  }
}

TEST(Quartered, in_part_keeps_order_area_and_every_point) {
  const scene::Scene scene = mixed_scene();
  const ElementMesh before = uniform(scene, 0.7);
  std::vector<bool> which(before.patches().size());
  for (std::size_t i = 0; i < which.size(); i += 3) which[i] = true;
  const PartlyQuartered after = quartered(before, which);
  ASSERT_EQ(after.parent.size(), after.mesh.patches().size());
  std::vector<double> area(which.size());
  std::vector<int> children(which.size());
  for (std::size_t i = 0; i < after.parent.size(); ++i) {
    const std::size_t parent = after.parent[i];
    if (i > 0) {
      EXPECT_LE(after.parent[i - 1], parent);
    }
    area[parent] += after.mesh.patches()[i].area;
    ++children[parent];
    EXPECT_EQ(after.mesh.patches()[i].surface, before.patches()[parent].surface);
  }
  for (std::size_t p = 0; p < which.size(); ++p) {
    EXPECT_EQ(children[p], which[p] ? 4 : 1);
    EXPECT_NEAR(area[p], before.patches()[p].area, 1e-13 * area[p]);
  }
  for (std::size_t i = 0; i < after.parent.size(); ++i) {  // where corners hang on edges too
    const scene::SurfacePatch& patch = after.mesh.patches()[i];
    const auto found =
        after.mesh.locate({patch.surface, patch.side, 0, Vec2::Zero(), patch.centroid(), patch.normal()});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->element.value, i);
  }
}
