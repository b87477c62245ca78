#include <gtest/gtest.h>

#include "core/error.h"
#include "raycast/ray_caster.h"
#include "tests/support/shapes.h"

namespace interflect::raycast {
namespace {

using test::placings;

/// Random triangles, of all sizes, that cross each other.
scene::Scene soup(int triangles, std::uint64_t seed, const test::Placing& placing) {
  scene::SceneBuilder builder({"grey"});
  core::RandomNumbers numbers(seed, 0, 0);
  std::vector<test::TriangleCorners> corners;
  for (int i = 0; i < triangles; ++i) {
    const double size = 0.02 + 0.4 * numbers.next() * numbers.next();
    const Vec3 centre = test::random_point(numbers);
    test::TriangleCorners triangle;
    for (Vec3& corner : triangle) corner = placing(centre + size * (test::random_point(numbers) - Vec3(0.5, 0.5, 0.5)));
    corners.push_back(triangle);
  }
  builder.add_facets("soup", corners, builder.add_material(test::diffuse("grey", 0.5, 0)));
  return builder.finish();
}

/// Distance between the line o + t d and the segment ab.
double distance_to_edge(const Vec3& o, const Vec3& d, const Vec3& a, const Vec3& b) {
  const Vec3 e = b - a, w = a - o, n = d.cross(e);
  // The closest point of the edge's line, clamped to the edge; then its distance to the ray's line (|d| = 1).
  const double s = n.squaredNorm() > 0 ? std::clamp(-(w.cross(d)).dot(e.cross(d)) / n.squaredNorm(), 0.0, 1.0) : 0.0;
  return (w + s * e).cross(d).norm();
}

double distance_to_edges(const Vec3& o, const Vec3& d, const scene::Facet& facet) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k)
    nearest = std::min(nearest, distance_to_edge(o, d, facet.corner[k], facet.corner[(k + 1) % 3]));
  return nearest;
}

/// May single precision decide otherwise?  A facet met within 1e-5 of its edge; or two facets, both met well inside,
/// whose crossing points lie within 1e-5 of each other measured across them (they intersect there); or an origin within
/// 1e-5 of a facet.
bool undecided(const scene::Scene& scene, double unit, const Ray& ray, const std::optional<scene::SurfacePoint>& a,
               const std::optional<scene::SurfacePoint>& b) {
  const double near = 1e-5 * unit;
  for (const auto* hit : {&a, &b})
    if (*hit) {
      const scene::Facet& facet = scene.facets[(*hit)->facet];
      if (distance_to_edges(ray.origin, ray.direction, facet) < near) return true;
      if (std::abs((ray.origin - facet.corner[0]).dot(facet.normal)) < near) return true;
    }
  if (!a || !b) return false;
  return std::abs((a->position - b->position).dot(scene.facets[a->facet].normal)) < near ||
         std::abs((a->position - b->position).dot(scene.facets[b->facet].normal)) < near;
}

Ray random_ray(std::uint64_t i, const test::Placing& placing) {
  core::RandomNumbers numbers(11, 1, i);
  const Vec3 from = test::random_point(numbers), to = test::random_point(numbers);
  return {placing(from), (to - from).normalized()};
}

TEST(RayCasters, agree_on_random_triangles_but_for_rays_within_1e_minus_5_of_an_edge) {
  for (const auto& placing : placings) {
    const scene::Scene scene = soup(500, 3, placing);
    const auto embree = make_ray_caster("embree", scene), brute = make_ray_caster("brute", scene);
    int hits = 0, different = 0;
    for (std::uint64_t i = 0; i < 8'000; ++i) {
      const Ray ray = random_ray(i, placing);
      const auto a = embree->closest(ray), b = brute->closest(ray);
      hits += b.has_value();
      if (a.has_value() == b.has_value() && (!a || a->facet == b->facet)) {
        if (!a) continue;
        EXPECT_EQ(a->side, b->side);
        // Single precision is off by 1e-6 of the scene over the cosine of incidence along the ray; across a sliver,
        // whose barycentric coordinates are ill-conditioned, by ten times as much.
        const double cosine = std::abs(ray.direction.dot(b->normal));
        EXPECT_LT((a->position - b->position).norm() * cosine, 1e-5 * placing.scale);
        continue;
      }
      ++different;
      EXPECT_TRUE(undecided(scene, placing.scale, ray, a, b)) << "ray " << i << " scale " << placing.scale;
    }
    EXPECT_GT(hits, 3000);
    EXPECT_LT(different, 20);  // the test of the exceptions shall not swallow a fault
  }
}

// In any number, through a soup that some rays leave.
TEST(RayCasters, find_the_same_one_by_one_and_many_at_once) {
  const scene::Scene scene = soup(200, 4, {});
  for (const std::string& name : ray_caster_names()) {
    const auto caster = make_ray_caster(name, scene);
    std::vector<Ray> rays;
    for (std::uint64_t i = 0; i < 150; ++i) rays.push_back(random_ray(i, {}));
    std::vector<std::optional<scene::SurfacePoint>> hits(rays.size());
    caster->closest_each(rays, hits);
    std::size_t met = 0;
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const auto hit = caster->closest(rays[k]);
      ASSERT_EQ(hits[k].has_value(), hit.has_value()) << name << k;
      if (!hit) continue;
      ++met;
      EXPECT_EQ(hits[k]->facet, hit->facet);
      EXPECT_EQ(hits[k]->side, hit->side);
      EXPECT_EQ(hits[k]->position, hit->position);
    }
    EXPECT_GT(met, 20u);
    EXPECT_LT(met, rays.size());
    EXPECT_THROW(caster->closest_each(rays, std::span(hits).first(3)), core::PreconditionError);
  }
}

// In groups that fill no packet, and at edges and corners of a closed body, where two facets are met at once.
TEST(RayCasters, find_as_much_one_by_one_and_many_at_once_wherever_rays_go) {
  scene::SceneBuilder builder({"grey"});
  builder.add_box("room", geometry::Box(Vec3(0, 0, 0), Vec3(1, 1, 1)),
                  builder.add_material(test::diffuse("grey", .5, 0)), scene::SceneBuilder::Facing::inward);
  const scene::Scene scene = builder.finish();
  for (const std::string& name : ray_caster_names()) {
    const auto caster = make_ray_caster(name, scene);
    std::vector<Ray> rays;
    for (int x = 0; x <= 4; ++x)
      for (int y = 0; y <= 4; ++y)
        for (int z = 0; z <= 4; ++z) {
          const Vec3 from(.4, .45, .55), to(x / 4., y / 4., z / 4.);
          rays.push_back({from, (to - from).normalized()});
        }
    for (const std::size_t count :
         {std::size_t{0}, std::size_t{1}, std::size_t{7}, std::size_t{8}, std::size_t{9}, rays.size()}) {
      std::vector<std::optional<scene::SurfacePoint>> hits(count);
      caster->closest_each(std::span(rays).first(count), hits);
      for (std::size_t k = 0; k < count; ++k) {
        const auto hit = caster->closest(rays[k]);
        ASSERT_TRUE(hit.has_value() && hits[k].has_value()) << name << k;  // no ray leaks
        EXPECT_LT((hits[k]->position - hit->position).norm(), 1e-6) << name << k;
      }
    }
  }
}

TEST(RayCasters, agree_on_occlusion_one_by_one_and_eight_by_eight) {
  for (const auto& placing : placings) {
    const scene::Scene scene = soup(300, 5, placing);
    const auto embree = make_ray_caster("embree", scene), brute = make_ray_caster("brute", scene);
    std::vector<Segment> segments;
    for (std::uint64_t i = 0; i < 4'003; ++i) {  // not a multiple of eight
      core::RandomNumbers numbers(13, 1, i);
      const Vec3 from = test::random_point(numbers), to = test::random_point(numbers);
      segments.push_back({placing(from), placing(from + 0.3 * (to - from))});
    }
    std::vector<std::uint8_t> by_eight(segments.size(), 7), by_brute(segments.size(), 7);
    embree->occluded(segments, by_eight);
    brute->occluded(segments, by_brute);
    int blocked = 0, different = 0;
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const Segment& s = segments[i];
      EXPECT_EQ(embree->occluded(s), by_eight[i] == 1) << i;
      EXPECT_EQ(brute->occluded(s), by_brute[i] == 1) << i;
      blocked += by_brute[i];
      if (by_eight[i] == by_brute[i]) continue;
      ++different;
      const Vec3 along = (s.to - s.from).normalized();
      bool near = false;
      for (const scene::Facet& facet : scene.facets)
        near = near || distance_to_edges(s.from, along, facet) < 1e-5 * placing.scale ||
               std::abs((s.from - facet.corner[0]).dot(facet.normal)) < 1e-5 * placing.scale ||
               std::abs((s.to - facet.corner[0]).dot(facet.normal)) < 1e-5 * placing.scale;
      EXPECT_TRUE(near) << "segment " << i << " scale " << placing.scale;
    }
    EXPECT_GT(blocked, 200);
    EXPECT_LT(blocked, 3800);
    EXPECT_LT(different, 10);
  }
}

TEST(RayCasters, call_a_segment_occluded_where_the_closest_hit_is_nearer_than_its_end) {
  const scene::Scene scene = soup(400, 7, {});
  for (const std::string& name : ray_caster_names()) {
    const auto caster = make_ray_caster(name, scene);
    int occluded = 0;
    for (std::uint64_t i = 0; i < 4'000; ++i) {
      const Ray ray = random_ray(i, {});
      const double length = 0.5;
      const auto hit = caster->closest(ray);
      const double distance = hit ? (hit->position - ray.origin).norm() : 2;
      if (std::abs(distance - length) < 1e-5) continue;  // single precision
      EXPECT_EQ(caster->occluded(Segment{ray.origin, ray.origin + length * ray.direction}), distance < length)
          << name << i;
      occluded += distance < length;
    }
    EXPECT_GT(occluded, 700);
  }
}

}  // namespace
}  // namespace interflect::raycast
