#include <gtest/gtest.h>

#include <memory>

#include "core/moments.h"
#include "core/random.h"
#include "montecarlo/light/environment.h"
#include "montecarlo/light/point.h"
#include "montecarlo/light/rectangle.h"
#include "montecarlo/light/sky.h"
#include "montecarlo/light/sphere.h"
#include "montecarlo/light/spot.h"
#include "montecarlo/light/sun.h"
#include "montecarlo/light/triangle.h"
#include "tests/montecarlo/statistics.h"

// What leaves a light is what arrives of it.
namespace interflect::montecarlo {
namespace {

constexpr int samples = 200'000;

using test::grey;

/// A square within the unit box, off the axes of all lights and tilted, that light passes from its front.
struct Window {
  Vec3 corner{.6, .7, .6}, u, v, normal;
  Window() {
    normal = Vec3(.3, -.4, 1).normalized();
    u = .4 * normal.cross(Vec3::UnitY()).normalized();
    v = normal.cross(u);
  }
  bool passes(const Vec3& from, const Vec3& way) const {
    const double t = (corner - from).dot(normal) / way.dot(normal);
    if (!(t > 0 && way.dot(normal) < 0)) return false;
    const Vec3 at = from + t * way - corner;
    const double a = at.dot(u) / u.squaredNorm(), b = at.dot(v) / v.squaredNorm();
    return a >= 0 && a <= 1 && b >= 0 && b <= 1;
  }
};

core::ScalarMoments by_what_leaves(const Light& light, const Window& window) {
  core::ScalarMoments flux;
  for (std::uint64_t k = 0; k < samples; ++k) {
    core::RandomNumbers numbers(1, 0, k);
    std::array<double, 4> u;
    for (double& each : u) each = numbers.next();
    const Emission e = light.sample_emission(u);
    flux.add(window.passes(e.position, e.way) ? e.weight[0] : 0);
  }
  return flux;
}

core::ScalarMoments by_what_arrives(const Light& light, const Window& window) {
  core::ScalarMoments flux;
  for (std::uint64_t k = 0; k < samples; ++k) {
    core::RandomNumbers numbers(2, 0, k);
    const double a = numbers.next(), b = numbers.next(), u = numbers.next(), v = numbers.next();
    const auto found = light.sample_arriving({window.corner + a * window.u + b * window.v, window.normal}, u, v);
    const double cosine = found ? std::max(0., found->way.dot(window.normal)) : 0;
    flux.add(cosine > 0 ? found->light[0] * cosine / (light.is_delta() ? 1 : found->pdf_solid_angle) : 0);
  }
  return flux;
}

TEST(LightEmission, brings_through_a_window_what_arrives_there) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  const geometry::Box box(Vec3(0, 0, 0), Vec3(1, 1, 1));
  std::vector<Spectrum> texels;
  for (int k = 0; k < 32; ++k) texels.push_back(grey(k % 5 == 2 ? 7 : 1));
  const scene::EnvironmentMap map{z, y, 4, 8, texels};
  std::vector<std::pair<std::string, std::unique_ptr<Light>>> lights;
  const auto add = [&](const char* name, auto light) { lights.emplace_back(name, std::move(light)); };
  const Spectrum E = grey(2);
  add("rectangle", std::make_unique<RectangleLight>(Vec3(.3, -.2, .9), .9 * y, .6 * x, -z, E));
  add("triangle",
      std::make_unique<TriangleLight>(std::array{Vec3(.3, -.2, .9), Vec3(.4, .9, .9), Vec3(1.1, 0, .9)}, -z, E));
  add("ball", std::make_unique<BallLight>(scene::SphereLight{"ball", Vec3(.7, .1, 1), .3, E}));
  add("point", std::make_unique<PointSource>(scene::PointLight{"point", Vec3(.7, .1, 1), E}));
  add("spot", std::make_unique<Spot>(scene::SpotLight{"spot", Vec3(.9, .1, 1), Vec3(-.6, 0, -.8), E, .95, .6}));
  add("wide sun", std::make_unique<SunLight>(scene::Sun{"sun", Vec3(-.48, .36, -.8), E, .5}, box));
  add("parallel sun", std::make_unique<SunLight>(scene::Sun{"sun", Vec3(-.48, .36, -.8), E, 0}, box));
  add("sky", std::make_unique<SkyLight>(scene::Sky{x, E, grey(0)}, box));
  add("map", std::make_unique<EnvironmentLight>(map, box));
  const Window window;
  const double limit = test::critical_z(test::alpha, lights.size());
  for (const auto& [name, light] : lights) {
    const core::ScalarMoments left = by_what_leaves(*light, window), arrived = by_what_arrives(*light, window);
    const double area = window.u.norm() * window.v.norm();
    const double error = std::hypot(left.standard_error(), area * arrived.standard_error());
    EXPECT_NEAR(left.mean(), area * arrived.mean(), limit * error + 1e-12) << name;
    EXPECT_LT(error, .03 * left.mean()) << name;
  }
}

}  // namespace
}  // namespace interflect::montecarlo
