#include <gtest/gtest.h>

#include <functional>

#include "montecarlo/light/balls.h"
#include "montecarlo/light/environment.h"
#include "montecarlo/light/point.h"
#include "montecarlo/light/rectangle.h"
#include "montecarlo/light/sky.h"
#include "montecarlo/light/sphere.h"
#include "montecarlo/light/spot.h"
#include "montecarlo/light/sun.h"
#include "montecarlo/light/triangle.h"
#include "montecarlo/warp/cone.h"
#include "tests/montecarlo/light_numbers.h"
#include "tests/montecarlo/statistics.h"

// Lights by themselves: what they draw, how densely, and what it is worth.  (Picks among many: light_tree.cpp; solid
// angles: light_warps.cpp; in paths: lit_scenes.cpp.)
namespace interflect::montecarlo {
namespace {

using test::grey;
using test::numbers_of;

Spectrum colour(double a, double b) {
  Spectrum s;
  s[0] = a, s[1] = b;
  return s;
}

const geometry::Box unit_box(Vec3(0, 0, 0), Vec3(1, 1, 1));

/// A bright and a dim half, a dark row, a single bright texel.
scene::EnvironmentMap some_map(const Vec3& up = Vec3::UnitZ()) {
  std::vector<Spectrum> texels;
  for (int r = 0; r < 8; ++r)
    for (int c = 0; c < 16; ++c)
      texels.push_back(r == 2 ? Spectrum::zero() : r == 1 && c == 5 ? colour(90, 5) : colour(c < 8 ? 1 : 3, 2));
  const Vec3 middle = up.z() > 0.5 ? Vec3::UnitY() : Vec3(-Vec3::UnitZ());
  return {up, middle, 8, 16, std::move(texels)};
}

struct Named {
  std::string name;
  std::unique_ptr<Light> light;
  Place at;
  /// Where a ray from `at` meets it.
  std::function<std::optional<Vec3>(const Vec3& way)> met;
  Vec3 axis;    ///< directions that are drawn lie in a cone about it,
  double cone;  ///< of this 1 - cosine
};

std::optional<Vec3> on_plane(const Vec3& x, const Vec3& way, const Vec3& corner, const Vec3& normal) {
  const double t = (corner - x).dot(normal) / way.dot(normal);
  return t > 0 && way.dot(normal) < 0 ? std::optional<Vec3>(x + t * way) : std::nullopt;
}

const Spectrum shines = colour(2, 5);

/// A plane that is parallel to none of the axes.
struct Askew {
  Vec3 n = Vec3(1, -2, -3).normalized(), s = n.cross(Vec3::UnitX()).normalized(), t = n.cross(s);
  Vec3 corner{1, 2, 3};
};
Named triangle_from(double d) {
  const Askew plane;
  const std::array<Vec3, 3> corner{plane.corner, plane.corner + 2 * plane.t + plane.s, plane.corner + 1.5 * plane.s};
  const Vec3 up = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
  const Vec3 middle = (corner[0] + corner[1] + corner[2]) / 3, x = middle + d * up + .1 * plane.t;
  const auto met = [=](const Vec3& way) -> std::optional<Vec3> {
    const auto y = on_plane(x, way, corner[0], up);
    if (!y) return y;
    for (std::size_t k = 0; k < 3; ++k)
      if ((corner[(k + 1) % 3] - corner[k]).cross(*y - corner[k]).dot(up) < 0) return std::nullopt;
    return y;
  };
  return {"triangle", std::make_unique<TriangleLight>(corner, up, shines),
          {x, -up},   met,
          -up,        d > 1 ? 1 - d / std::hypot(d, 2.2) : 1};
}
Named rectangle_from(double d) {
  const Askew plane;
  const Vec3 a = plane.corner, s = plane.s, t = plane.t, u = 2 * s, v = 1.2 * t, down = -u.cross(v).normalized(),
             x = a + u / 2 + v / 3 + d * down;
  const auto met = [=](const Vec3& way) -> std::optional<Vec3> {
    const auto y = on_plane(x, way, a, down);
    if (!y) return y;
    const double p = (*y - a).dot(s), q = (*y - a).dot(t);
    return p >= 0 && p <= 2 && q >= 0 && q <= 1.2 ? y : std::nullopt;
  };
  return {"rectangle", std::make_unique<RectangleLight>(a, u, v, down, shines),
          {x, -down},  met,
          -down,       d > 1 ? 1 - d / std::hypot(d, 1.3) : 1};
}
Named ball_from(double d) {
  const scene::SphereLight ball{"ball", Vec3(0, 0, d), .5, shines};
  const auto met = [=](const Vec3& way) -> std::optional<Vec3> {
    Balls balls;
    balls.add(ball.centre, ball.radius);
    const auto hit = balls.closest(Vec3::Zero(), way, infinite);
    return hit ? std::optional<Vec3>(hit->position) : std::nullopt;
  };
  return {"sphere",       std::make_unique<BallLight>(ball), {Vec3::Zero(), Vec3::UnitZ()}, met, Vec3::UnitZ(),
          d < 1 ? 1 : .05};
}
/// Which arrives at a side that faces up, or as it says.
void add_from_afar(std::vector<Named>& kinds) {
  static const scene::EnvironmentMap map = some_map(), turned = some_map(Vec3::UnitY());
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ(), sunward = Vec3(1, 1, 2).normalized();
  const scene::Sky sky{z, shines, {}}, ground{z, shines, colour(1, 1)};
  const auto add = [&](const char* name, std::unique_ptr<Light> light, const Vec3& facing, const Vec3& axis,
                       double cone) {
    const auto anywhere = [](const Vec3&) { return std::optional<Vec3>(Vec3::Zero()); };
    kinds.push_back({name, std::move(light), {Vec3::Zero(), facing}, anywhere, axis, cone});
  };
  add("sun", std::make_unique<SunLight>(scene::Sun{"sun", -sunward, shines}, unit_box), z, sunward, 1.5e-5);
  add("sun", std::make_unique<SunLight>(scene::Sun{"wide", -sunward, shines, .3}, unit_box), z, sunward, .1);
  add("sky", std::make_unique<SkyLight>(sky, unit_box), z, z, 1);
  add("sky and ground", std::make_unique<SkyLight>(ground, unit_box), x, x, 1);
  add("sky from both sides", std::make_unique<SkyLight>(ground, unit_box), Vec3::Zero(), z, 2);
  add("map", std::make_unique<EnvironmentLight>(map, unit_box), z, z, 2);
  add("map, y up", std::make_unique<EnvironmentLight>(turned, unit_box), z, y, 2);
}

/// Everything that draws ways with a density, near and far.
std::vector<Named> all_kinds() {
  std::vector<Named> kinds;
  for (const double d : {.15, .5, 6.}) {
    kinds.push_back(triangle_from(d));
    kinds.push_back(rectangle_from(d));
  }
  for (const double d : {.51, 2.}) kinds.push_back(ball_from(d));
  add_from_afar(kinds);
  return kinds;
}

/// Whose ways or places have no density.
void add_without_size(std::vector<Named>& kinds) {
  const auto add = [&](const char* name, std::unique_ptr<Light> light, const Vec3& axis) {
    kinds.push_back({name, std::move(light), {}, {}, axis, 2});
  };
  const Vec3 position(1, 2, 3), axis = Vec3(1, 2, 2) / 3;
  add("point", std::make_unique<PointSource>(scene::PointLight{"p", position, colour(1, 2)}), Vec3::UnitZ());
  for (const auto& [beam, field] : {std::pair(.9, .6), std::pair(.5, .5), std::pair(1., -.5)})
    add("spot", std::make_unique<Spot>(scene::SpotLight{"s", position, axis, colour(1, 2), beam, field}), axis);
  add("parallel", std::make_unique<SunLight>(scene::Sun{"s", Vec3(0, 0, -1), colour(1, 2), 0}, unit_box),
      Vec3::UnitZ());
}

// Half a million ways fall where the pdf says; the pdf of a draw is that of its inverse; all of them integrate to 1.
TEST(Lights, draw_what_arrives_as_they_say) {
  constexpr int n = 500'000, rows = 16, columns = 16, fine = 32;
  std::uint32_t stream = 0;
  const std::vector<Named> kinds = all_kinds();
  test::Family family(test::tails_of_counts * kinds.size());
  for (const Named& of : kinds) {
    const Frame frame = frame_around(of.axis);
    std::vector<double> counts(rows * columns), expected(rows * columns);
    for (int a = 0; a < rows * fine; ++a)
      for (int b = 0; b < columns * fine; ++b) {
        const Vec3 way = frame.to_world(uniform_cone(of.cone, (a + .5) / (rows * fine), (b + .5) / (columns * fine)));
        const auto y = of.met(way);
        if (!y || of.light->radiance(*y, -way).is_zero()) continue;
        const double p = of.light->pdf_arriving_solid_angle(of.at, way, *y) * 2 * pi * of.cone;
        expected[static_cast<std::size_t>(a / fine * columns + b / fine)] += n * p / (rows * fine * columns * fine);
      }
    ++stream;
    double drawn = 0;
    for (std::uint64_t k = 0; k < n; ++k) {
      const auto u = numbers_of(stream, k);
      const auto s = of.light->sample_arriving(of.at, u[0], u[1]);
      if (!s) continue;
      ++drawn;
      const Vec2 at = uniform_cone_inverse(of.cone, frame.to_local(s->way));
      ASSERT_LT(at.x(), 1 + 1e-9) << of.name;
      const int a = std::min(rows - 1, static_cast<int>(at.x() * rows)),
                b = std::min(columns - 1, static_cast<int>(at.y() * columns));
      ++counts[static_cast<std::size_t>(a * columns + b)];
      if (k % 64 != 0) continue;
      EXPECT_NEAR(s->way.norm(), 1, 1e-12);
      EXPECT_NEAR(of.light->pdf_arriving_solid_angle(of.at, s->way, s->position) / s->pdf_solid_angle, 1, 1e-9)
          << of.name;
      EXPECT_EQ(of.light->radiance(s->position, -s->way), s->light) << of.name;
      if (!of.light->is_infinite()) {
        EXPECT_NEAR((of.at.position + s->distance * s->way - s->position).norm(), 0, 1e-12) << of.name;
        EXPECT_NEAR(s->normal.norm(), 1, 1e-12);
      }
    }
    EXPECT_GT(drawn, 0);
    test::expect_as_expected(counts, expected, family, of.name);
  }
}

// What leaves has the density that is said; its mean weight is the flux; and it arrives at what it passes as it should.
TEST(Lights, send_out_as_they_say) {
  std::vector<Named> kinds = all_kinds();
  add_without_size(kinds);
  std::uint32_t stream = 100;
  test::Family family(2 * kinds.size());
  for (const Named& of : kinds) {
    ++stream;
    constexpr int n = 200'000;
    double sum = 0, squares = 0;
    for (std::uint64_t k = 0; k < n; ++k) {
      const Emission e = of.light->sample_emission(numbers_of(stream, k));
      sum += e.weight[0], squares += e.weight[0] * e.weight[0];
      if (k % 64 != 0) continue;
      const EmissionPdfs p = of.light->pdfs_emission(e.position, e.way);
      EXPECT_NEAR(p.area / e.pdf_area, 1, 1e-12) << of.name;
      EXPECT_NEAR(p.solid_angle / e.pdf_solid_angle, 1, 1e-9) << of.name;
      if (of.light->is_delta()) continue;
      const double cosine = e.normal.dot(e.way), L = of.light->radiance(e.position, e.way)[0];
      EXPECT_NEAR(e.weight[0] * e.pdf_area * e.pdf_solid_angle, L * cosine, 1e-9 * L) << of.name;
    }
    const double flux = of.light->flux()[0], noise = std::sqrt(std::max(0., squares / n - sum / n * sum / n) / n);
    EXPECT_NEAR(sum / n, flux, family.z() * noise + 1e-9 * flux) << of.name;
  }
}

// A spot's intensity integrates to its flux in closed form, and ways are drawn in proportion to it.
TEST(Spots, send_a_flux_of_closed_form) {
  const std::array cosines{std::pair(.95, .8), std::pair(.5, .5), std::pair(1., 0.), std::pair(.2, -.9)};
  test::Family family(test::tails_of_counts * cosines.size());
  for (const auto& [beam, field] : cosines) {
    const scene::SpotLight spot{"s", Vec3::Zero(), Vec3::UnitZ(), grey(3), beam, field};
    double sum = 0;
    constexpr int n = 200'000;
    for (int k = 0; k < n; ++k) sum += spot.falloff(2 * (k + .5) / n - 1);
    EXPECT_NEAR(sum * 2 / n * 2 * pi * 3, spot.flux()[0], 1e-4 * spot.flux()[0]);
    const Spot light(spot);
    constexpr int bins = 40, m = 400'000;
    std::vector<double> counts(bins), expected(bins);
    for (std::uint64_t k = 0; k < m; ++k) {
      const double cosine = light.sample_emission(numbers_of(60, k)).way.z();
      ++counts[static_cast<std::size_t>(std::min<int>(bins - 1, static_cast<int>((cosine + 1) / 2 * bins)))];
    }
    for (int k = 0; k < n; ++k) {
      const double cosine = 2 * (k + .5) / n - 1;
      const Vec3 way(std::sqrt(1 - cosine * cosine), 0, cosine);
      expected[static_cast<std::size_t>((cosine + 1) / 2 * bins)] +=
          m * light.pdfs_emission({}, way).solid_angle * 4 * pi / n;
    }
    test::expect_as_expected(counts, expected, family, "spot");
  }
}

TEST(SunLight, has_the_radiance_of_a_small_disk) {
  const scene::Sun sun{"sun", -Vec3::UnitZ(), grey(1)};
  EXPECT_NEAR(sun.irradiance[0] / sun.radiance()[0], 6.796665596e-5, 1e-13);
  EXPECT_NEAR(2 * pi * sun.one_minus_cosine(), 6.796702357e-5, 1e-13);
}

// A map of one radiance is a sky, and one bright texel lights as its solid angle says.
TEST(EnvironmentLight, lights_as_its_texels_do) {
  const scene::EnvironmentMap even(Vec3::UnitZ(), Vec3::UnitY(), 6, 12, std::vector<Spectrum>(72, colour(2, 3)));
  const EnvironmentLight map(even, unit_box);
  const SkyLight sky({Vec3::UnitZ(), colour(2, 3), colour(2, 3)}, unit_box);
  EXPECT_NEAR(map.flux()[1] / sky.flux()[1], 1, 1e-14);
  const Place at{Vec3::Zero(), Vec3::Zero()};
  for (std::uint64_t k = 0; k < 1000; ++k) {
    const auto u = numbers_of(80, k);
    const auto s = map.sample_arriving(at, u[0], u[1]);
    EXPECT_NEAR(s->pdf_solid_angle, 1 / (4 * pi), 1e-14);
    EXPECT_EQ(s->light, colour(2, 3));
  }
  for (const int row : {0, 1, 2}) {
    std::vector<Spectrum> texels(72);
    texels[static_cast<std::size_t>(12 * row + 3)] = colour(7, 1);
    const scene::EnvironmentMap one(Vec3::UnitZ(), Vec3::UnitY(), 6, 12, texels);
    const EnvironmentLight light(one, unit_box);
    const double a = pi * row / 6, b = pi * (row + 1) / 6, dphi = 2 * pi / 12;
    const double known = 7 * dphi * (std::sin(b) * std::sin(b) - std::sin(a) * std::sin(a)) / 2;
    double sum = 0;
    constexpr int n = 300;
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        const auto s = light.sample_arriving(at, (j + .5) / n, (k + .5) / n);
        sum += s->light[0] * s->way.z() / s->pdf_solid_angle;
        // Column 3 of 12: a quarter of a turn to a third before the middle, which is +y: to its left, -x.
        EXPECT_LT(s->way.x(), 0);
      }
    EXPECT_NEAR(sum / n / n, known, 1e-9 * known) << row;
  }
}

// Light from afar reaches the rim of a scene that is long and thin: flux through the disk is pi R² times what comes.
TEST(LightFromAfar, covers_a_long_thin_scene) {
  const geometry::Box box(Vec3(-50, -.5, 0), Vec3(50, .5, 0));
  const scene::EnvironmentMap even(Vec3::UnitZ(), Vec3::UnitY(), 6, 12, std::vector<Spectrum>(72, grey(1)));
  std::vector<std::pair<std::unique_ptr<Light>, double>> lights;  // with the irradiance of the floor
  lights.emplace_back(std::make_unique<SkyLight>(scene::Sky{Vec3::UnitZ(), grey(1), {}}, box), pi);
  lights.emplace_back(std::make_unique<EnvironmentLight>(even, box), pi);
  lights.emplace_back(std::make_unique<SunLight>(scene::Sun{"s", Vec3(.6, 0, -.8), grey(2)}, box), 1.6);
  lights.emplace_back(std::make_unique<SunLight>(scene::Sun{"s", Vec3(.6, 0, -.8), grey(2), 0}, box), 1.6);
  test::Family family(2 * 2 * lights.size());
  for (const auto& [light, H] : lights) {
    double rim = 0, middle = 0;
    constexpr int n = 4'000'000;
    for (std::uint64_t k = 0; k < n; ++k) {
      const Emission e = light->sample_emission(numbers_of(90, k));
      if (!(e.way.z() < 0)) continue;
      const Vec3 y = e.position - e.position.z() / e.way.z() * e.way;
      if (std::abs(y.y()) > .5 || std::abs(y.x()) > 50) continue;
      (std::abs(y.x()) > 49 ? rim : middle) += e.weight[0] / n;
    }
    // Hits are of one weight for each light but rare: w sqrt(count) / n.
    const double w = light->flux()[0] * (H == pi ? 2 : 1);
    EXPECT_NEAR(rim, 2 * H, family.z() * std::sqrt(2 * H * w / n)) << H;
    EXPECT_NEAR(middle, 98 * H, family.z() * std::sqrt(98 * H * w / n)) << H;
  }
}

TEST(BallLight, is_dark_within) {
  const BallLight light({"b", Vec3(1, 0, 0), 2, grey(3)});
  const Place within{Vec3(0, 0, 0), Vec3::UnitZ()};
  EXPECT_FALSE(light.sample_arriving(within, .3, .4));
  EXPECT_EQ(light.pdf_arriving_solid_angle(within, Vec3::UnitX(), Vec3(3, 0, 0)), 0);
  EXPECT_TRUE(light.radiance(Vec3(3, 0, 0), -Vec3::UnitX()).is_zero());
  EXPECT_NEAR(light.flux()[0], 4 * pi * 4 * 3, 1e-12);
}

}  // namespace
}  // namespace interflect::montecarlo
