#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "raycast/ray_caster.h"
#include "tests/support/shapes.h"

namespace interflect::raycast {
namespace {

/// Squares of side 1 in the planes z = heights, fronts up.
scene::Scene storeys(std::span<const double> heights, const test::Placing& placing = {}) {
  scene::SceneBuilder builder({"grey"});
  const auto material = builder.add_material(test::diffuse("grey", 0.5, 0));
  for (const double z : heights) {
    const geometry::Ring ring{placing({0, 0, z}), placing({1, 0, z}), placing({1, 1, z}), placing({0, 1, z})};
    builder.add_polygon("storey", {ring, {}}, material);
  }
  return builder.finish();
}

TEST(AllHits, come_in_order_with_their_sides_however_the_scene_lists_them) {
  const std::vector<double> heights{0.5, 0.1, 0.9, 0.3, 0.7};
  for (const auto& placing : test::placings) {
    const scene::Scene scene = storeys(heights, placing);
    for (const std::string& name : ray_caster_names()) {
      const auto caster = make_ray_caster(name, scene);
      std::vector<scene::SurfacePoint> hits;
      caster->all({placing({0.3, 0.4, 2}), -Vec3::UnitZ()}, hits);
      const std::vector<std::uint32_t> down{2, 4, 0, 3, 1};
      ASSERT_EQ(hits.size(), down.size()) << name;
      for (std::size_t k = 0; k < hits.size(); ++k) {
        EXPECT_EQ(hits[k].surface.value, down[k]);
        EXPECT_EQ(hits[k].side, scene::Side::front);
      }
      caster->all({placing({0.3, 0.4, 0.4}), Vec3::UnitZ()}, hits);  // from between two of them
      ASSERT_EQ(hits.size(), 3u) << name;
      EXPECT_EQ(hits[0].surface.value, 0u);
      EXPECT_EQ(hits[0].side, scene::Side::back);
    }
  }
}

// Far closer than single precision tells apart: the order is still the right one, and none is missed.
TEST(AllHits, tell_the_order_of_surfaces_1e_minus_9_apart) {
  const std::vector<double> heights{0.5, 0.5 - 1e-9, 0.5 + 1e-9, 0.0};
  const scene::Scene scene = storeys(heights);
  for (const std::string& name : ray_caster_names()) {
    const auto caster = make_ray_caster(name, scene);
    for (std::uint64_t i = 0; i < 1000; ++i) {
      core::RandomNumbers numbers(3, 0, i);
      const Vec3 target(0.25 + 0.5 * numbers.next(), 0.25 + 0.5 * numbers.next(), 0.5);
      const Vec3 origin = target + Vec3(0.2 * numbers.next(), 0.2 * numbers.next(), 1);
      std::vector<scene::SurfacePoint> hits;
      caster->all({origin, (target - origin).normalized()}, hits);
      ASSERT_GE(hits.size(), 3u) << name;
      EXPECT_EQ(hits[0].surface.value, 2u) << name;
      EXPECT_EQ(hits[1].surface.value, 0u) << name;
      EXPECT_EQ(hits[2].surface.value, 1u) << name;
    }
  }
}

// 60 triangles in a unit cube; the first of all hits is the closest, distances rise, and both casters and the default
// meet the same facets but for rays that pass an edge within single precision.
TEST(AllHits, begin_with_the_closest_and_are_the_same_for_every_caster) {
  /// What a caster that does not know better does: one closest hit after the other.
  class Plain final : public RayCaster {
   public:
    explicit Plain(const RayCaster& of) : of_(of) {}
    std::string name() const override { return "plain"; }
    std::optional<scene::SurfacePoint> closest(const Ray& ray) const override { return of_.closest(ray); }
    bool occluded(const Segment& segment) const override { return of_.occluded(segment); }
    void occluded(std::span<const Segment> s, std::span<std::uint8_t> b) const override { of_.occluded(s, b); }
    double offset() const override { return of_.offset(); }

   private:
    const RayCaster& of_;
  };
  for (const auto& placing : test::placings) {
    scene::SceneBuilder builder({"grey"});
    core::RandomNumbers numbers(7, 0, 0);
    std::vector<test::TriangleCorners> triangles(60);
    for (auto& corners : triangles)
      for (Vec3& corner : corners) corner = placing(test::random_point(numbers));
    builder.add_facets("soup", triangles, builder.add_material(test::diffuse("grey", 0.5, 0)));
    const scene::Scene scene = builder.finish();
    const auto embree = make_ray_caster("embree", scene), brute = make_ray_caster("brute", scene);
    const Plain plain(*brute);
    int different = 0;
    std::size_t met = 0;
    for (std::uint64_t i = 0; i < 2000; ++i) {
      core::RandomNumbers of_ray(8, 1, i);
      const Vec3 from = test::random_point(of_ray), to = test::random_point(of_ray);
      const Ray ray{placing(2 * from - to), (to - from).normalized()};
      std::vector<scene::SurfacePoint> exact, fast, stepwise;
      brute->all(ray, exact);
      embree->all(ray, fast);
      plain.all(ray, stepwise);
      const auto closest = brute->closest(ray);
      ASSERT_EQ(closest.has_value(), !exact.empty());
      if (closest) {
        EXPECT_EQ(closest->facet, exact[0].facet);
      }
      for (std::size_t k = 1; k < exact.size(); ++k)
        EXPECT_GE((exact[k].position - exact[k - 1].position).dot(ray.direction),
                  -1e-12 * placing.scale - 1e-15 * placing.shift.norm());
      const auto same = [&](const auto& others) {
        return std::equal(exact.begin(), exact.end(), others.begin(), others.end(),
                          [](const auto& a, const auto& b) { return a.facet == b.facet && a.side == b.side; });
      };
      different += !same(fast) + !same(stepwise);
      met += exact.size();
    }
    EXPECT_GT(met, 5000u);
    EXPECT_LE(different, 4) << placing.scale;
  }
}

TEST(AllHits, are_none_in_an_empty_scene_and_overwrite_what_was_there) {
  const scene::Scene scene = scene::SceneBuilder({"grey"}).finish();
  for (const std::string& name : ray_caster_names()) {
    std::vector<scene::SurfacePoint> hits(3);
    make_ray_caster(name, scene)->all({Vec3(0, 0, 0), Vec3::UnitX()}, hits);
    EXPECT_TRUE(hits.empty());
  }
}

TEST(AllHits, may_be_asked_by_several_threads_from_the_first_on) {
  const std::vector<double> heights{0.2, 0.4, 0.6};
  const scene::Scene scene = storeys(heights);
  const auto caster = make_ray_caster("embree", scene);
  std::atomic<int> right = 0;
  std::vector<std::jthread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      std::vector<scene::SurfacePoint> hits;
      for (int i = 0; i < 100; ++i) {
        caster->all({Vec3(0.3, 0.4, 2), -Vec3::UnitZ()}, hits);
        right += hits.size() == 3;
      }
    });
  threads.clear();
  EXPECT_EQ(right, 400);
}

}  // namespace
}  // namespace interflect::raycast
