#include <gtest/gtest.h>

#include "core/error.h"
#include "tests/mesh/scenes.h"

using namespace interflect;
using namespace interflect::mesh;

namespace {

/// (1-u-v) c0 + u c1 + v c2, or (1-u)(1-v) c0 + u (1-v) c1 + u v c2 + (1-u) v c3: written again, as the header says it.
Vec3 place(const scene::SurfacePatch& p, const ElementPoint& at) {
  const auto& c = p.corner;
  const double u = at.u, v = at.v;
  if (p.corners == 3) return (1 - u - v) * c[0] + u * c[1] + v * c[2];
  return (1 - u) * (1 - v) * c[0] + u * (1 - v) * c[1] + u * v * c[2] + (1 - u) * v * c[3];
}

scene::SurfacePoint random_point(const scene::Scene& scene, core::RandomNumbers& random) {
  const auto f = static_cast<std::uint32_t>(random.next() * static_cast<double>(scene.facets.size()));
  const scene::Facet& facet = scene.facets[f];
  const double r = std::sqrt(random.next()), s = random.next();
  const Vec2 uv(r * (1 - s), r * s);
  const auto side = scene.material(facet.surface).active(scene::Side::back) && random.next() < 0.5 ? scene::Side::back
                                                                                                   : scene::Side::front;
  const Vec3 position = (1 - uv.x() - uv.y()) * facet.corner[0] + uv.x() * facet.corner[1] + uv.y() * facet.corner[2];
  return {facet.surface, side, f, uv, position, side == scene::Side::front ? facet.normal : Vec3(-facet.normal)};
}

class LocateAtEveryScale : public testing::TestWithParam<double> {};

}  // namespace

// 1e5 random points, facets with equal chance: rounding is that of coordinates of the room's size, 5 x 2^-53, a few
// operations.
TEST_P(LocateAtEveryScale, finds_the_element_of_any_point_and_coordinates_that_reproduce_it) {
  const double s = GetParam();
  const scene::Scene scene = mixed_scene(s);
  const ElementMesh mesh = uniform(scene, 0.2 * s);
  core::RandomNumbers random(11, 0, 0);
  double worst = 0;
  for (int i = 0; i < 100'000; ++i) {
    const scene::SurfacePoint point = random_point(scene, random);
    const auto found = mesh.locate(point);
    ASSERT_TRUE(found.has_value());
    const scene::SurfacePatch& patch = mesh.patch(found->element);
    ASSERT_EQ(patch.surface, point.surface);
    ASSERT_EQ(patch.side, point.side);
    ASSERT_TRUE(found->u >= 0 && found->v >= 0 && found->u <= 1 && found->v <= 1);
    ASSERT_TRUE(patch.corners == 4 || found->u + found->v <= 1 + 1e-15);
    worst = std::max(worst, (place(patch, *found) - point.position).norm());
  }
  EXPECT_LE(worst, 1e-14 * s);
}

INSTANTIATE_TEST_SUITE_P(Scales, LocateAtEveryScale, testing::Values(1.0, 1e-6, 1e6), [](const auto& which) {
  return which.param == 1 ? "metres" : which.param < 1 ? "micrometres" : "megametres";
});

TEST(Locate, inverts_the_coordinates_of_general_quads) {
  core::RandomNumbers random(12, 0, 0);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vec3(3, -1, 2).normalized()).toRotationMatrix();
  for (int i = 0; i < 2000; ++i) {
    // A square whose corners move by up to 0.2: convex.
    std::array<Vec3, 4> ring{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
    for (Vec3& x : ring) x = turn * (x + 0.4 * Vec3(random.next() - 0.5, random.next() - 0.5, 0));
    const scene::SurfacePatch patch = scene::make_patch({0}, scene::Side::front, ring);
    const ElementPoint at{{0}, random.next(), random.next()};
    const ElementPoint back = coordinates_in(patch, {0}, place(patch, at));
    EXPECT_NEAR(back.u, at.u, 1e-13);
    EXPECT_NEAR(back.v, at.v, 1e-13);
  }
}

TEST(Locate, takes_the_nearest_element_for_points_that_rounding_moved_off_the_surface) {
  const scene::Scene scene = mixed_scene();
  const ElementMesh mesh = uniform(scene, 0.2);
  core::RandomNumbers random(13, 0, 0);
  for (int i = 0; i < 2000; ++i) {
    scene::SurfacePoint point = random_point(scene, random);
    const Vec3 shift = 1e-9 * Vec3(random.next() - 0.5, random.next() - 0.5, random.next() - 0.5);
    point.position += shift;
    const auto found = mesh.locate(point);
    ASSERT_TRUE(found.has_value());
    EXPECT_LE((place(mesh.patch(found->element), *found) - point.position).norm(), shift.norm() + 1e-15);
  }
}

TEST(Locate, finds_corners_and_edges_in_one_of_their_elements) {
  const scene::Scene scene = mixed_scene();
  const ElementMesh mesh = uniform(scene, 0.4);
  for (const auto& patch : mesh.patches())
    for (std::size_t k = 0; k < patch.corners; ++k)
      for (const Vec3& x : {patch.corner[k], Vec3(0.5 * (patch.corner[k] + patch.corner[(k + 1) % patch.corners]))}) {
        const auto found = mesh.locate({patch.surface, patch.side, 0, Vec2::Zero(), x, patch.normal()});
        ASSERT_TRUE(found.has_value());
        EXPECT_LE((place(mesh.patch(found->element), *found) - x).norm(), 1e-14);
      }
}

TEST(Locate, finds_nothing_on_a_side_without_elements) {
  const scene::Scene scene = mixed_scene();
  const ElementMesh mesh = uniform(scene, 0.5);
  EXPECT_FALSE(mesh.locate({{0}, scene::Side::back, 0, Vec2::Zero(), Vec3::Zero(), Vec3::UnitX()}).has_value());
  EXPECT_FALSE(mesh.locate({{999}, scene::Side::front, 0, Vec2::Zero(), Vec3::Zero(), Vec3::UnitX()}).has_value());
  EXPECT_FALSE(
      ElementMesh({}).locate({{0}, scene::Side::front, 0, Vec2::Zero(), Vec3::Zero(), Vec3::UnitX()}).has_value());
}

TEST(ElementMesh, refuses_elements_out_of_order) {
  const std::array<Vec3, 3> ring{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const auto patch = [&](std::uint32_t surface, scene::Side side) { return scene::make_patch({surface}, side, ring); };
  EXPECT_THROW(ElementMesh({patch(1, scene::Side::front), patch(0, scene::Side::front)}), core::PreconditionError);
  EXPECT_THROW(ElementMesh({patch(0, scene::Side::back), patch(0, scene::Side::front)}), core::PreconditionError);
}

TEST(ElementMesh, refuses_an_element_without_area) {
  const std::array<Vec3, 3> line{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)};
  EXPECT_THROW(ElementMesh({scene::make_patch({0}, scene::Side::front, line)}), core::InputError);
}
