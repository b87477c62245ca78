#include "fem/form_factor/element_locator.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/uniform.h"
#include "raycast/ray_caster.h"
#include "tests/support/shapes.h"

namespace interflect::fem {
namespace {

/// A room over a star, and a sphere of 80 facets in it.
scene::Scene star_and_sphere(const interflect::test::Placing& place) {
  scene::SceneBuilder builder({"grey"});
  core::RandomNumbers numbers(5, 0, 0);
  const auto material = builder.add_material(interflect::test::diffuse("grey", 0.5, 0));
  interflect::test::add_prism_room(builder, interflect::test::random_star(9, numbers), 0.8, material, place);
  auto triangles = interflect::test::icosphere(1, 0.2, false);
  for (auto& corners : triangles)
    for (Vec3& corner : corners) corner = place(corner + Vec3(0, 0, 0.4));
  builder.add_facets("sphere", triangles, material);
  return builder.finish();
}

TEST(ElementLocator, finds_what_the_mesh_locates_wherever_a_ray_hits) {
  for (const auto& placing : interflect::test::placings) {
    if (placing.shift.norm() > 0) continue;  // there a rounded point may lie on either side of an edge
    const scene::Scene scene = star_and_sphere(placing);
    const mesh::ElementMesh mesh = mesh::quartered(mesh::uniform(scene, 0.2 * placing.scale));
    const ElementLocator locate(mesh.patches());
    for (const std::string& name : raycast::ray_caster_names()) {
      const auto caster = raycast::make_ray_caster(name, scene);
      for (std::uint64_t i = 0; i < 20'000; ++i) {
        core::RandomNumbers numbers(7, 0, i);
        const Vec3 direction =
            interflect::test::cosine_about(i % 2 == 0 ? Vec3(Vec3::UnitZ()) : Vec3(Vec3::UnitX()), numbers);
        const auto hit = caster->closest({placing(Vec3(0.3, 0.1 * numbers.next(), 0.3)), direction});
        ASSERT_TRUE(hit);
        const auto expected = mesh.locate(*hit);
        ASSERT_EQ(locate(*hit), expected ? static_cast<Index>(expected->element.value) : ElementLocator::none)
            << name << i;
      }
    }
  }
}

// The same answers many at once, also where there is no point, or no element.
TEST(ElementLocator, finds_the_same_one_by_one_and_many_at_once) {
  for (const auto& placing : interflect::test::placings) {
    const scene::Scene scene = star_and_sphere(placing);
    const mesh::ElementMesh mesh = mesh::uniform(scene, 0.1 * placing.scale);
    const ElementLocator locate(mesh.patches());
    const auto caster = raycast::make_ray_caster("embree", scene);
    std::vector<std::optional<scene::SurfacePoint>> hits(1000);
    for (std::uint64_t i = 0; i < hits.size(); ++i) {
      core::RandomNumbers numbers(8, 0, i);
      if (i % 10 != 0)
        hits[i] = caster->closest(
            {placing(Vec3(0.3, 0.1 * numbers.next(), 0.3)), interflect::test::cosine_about(Vec3::UnitX(), numbers)});
      if (i % 15 == 1 && hits[i]) hits[i]->side = scene::Side::back;
    }
    std::vector<Index> elements(hits.size());
    locate(hits, elements);
    for (std::size_t k = 0; k < hits.size(); ++k) {
      const Index one = hits[k] ? locate(*hits[k]) : ElementLocator::none;
      ASSERT_EQ(elements[k], one) << k;
    }
    EXPECT_GT(std::ranges::count_if(elements, [](Index e) { return e != ElementLocator::none; }), 500);
  }
}

// Corners, and points that rounding has put beside the surface's border, belong to some element that touches them.
TEST(ElementLocator, loses_no_corner_of_an_element) {
  const scene::Scene scene = star_and_sphere({});
  const mesh::ElementMesh mesh = mesh::quartered(mesh::uniform(scene, 0.2));
  const ElementLocator locate(mesh.patches());
  for (const scene::SurfacePatch& patch : mesh.patches())
    for (const Vec3& corner : patch.ring()) {
      scene::SurfacePoint point;
      point.surface = patch.surface, point.side = patch.side, point.position = corner + Vec3(1e-14, -1e-14, 1e-14);
      const Index found = locate(point);
      ASSERT_NE(found, ElementLocator::none);
      EXPECT_LT(geometry::box_of(mesh.patches()[static_cast<std::size_t>(found)].ring()).exteriorDistance(corner),
                1e-12);
    }
}

TEST(ElementLocator, finds_nothing_on_sides_without_elements) {
  const scene::Scene scene = star_and_sphere({});
  const mesh::ElementMesh mesh = mesh::uniform(scene, 0.3);
  const ElementLocator locate(mesh.patches());
  scene::SurfacePoint point;
  point.surface = scene::SurfaceId{0}, point.side = scene::Side::back, point.position = mesh.patches()[0].centroid();
  EXPECT_EQ(locate(point), ElementLocator::none);
  point.surface = scene::SurfaceId{1000}, point.side = scene::Side::front;
  EXPECT_EQ(locate(point), ElementLocator::none);
}

}  // namespace
}  // namespace interflect::fem
