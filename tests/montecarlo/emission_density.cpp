#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

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
#include "tests/support/family.h"

// What leaves lights, place and way together, against the densities that they state.
namespace interflect::montecarlo {
namespace {

using Four = std::array<double, 4>;

/// A particle, and how much area and solid angle a unit of its coordinates is there: 1 of what is delta.
struct Leaving {
  Vec3 position, way;
  double area = 1, solid_angle = 1;
};

/// Coordinates in [0, 1]⁴ of all that can leave a light, by its geometry: of the place, then of the way.
struct Chart {
  Four cells;  ///< 1 of what is delta
  std::function<Leaving(const Four&)> at;
  std::function<Four(const Vec3& position, const Vec3& way)> of;
};
constexpr double by_place = 4, by_way = 6, by_way_alone = 16;

struct Named {
  std::string name;
  std::unique_ptr<Light> light;
  Chart chart;
};

/// Ways within a cone about an axis, of 1 - cosine up to k.
struct Cone {
  Vec3 axis;
  double k;
  Vec3 way(double c, double d) const { return frame_around(axis).to_world(uniform_cone(k, c, d)); }
  Vec2 of(const Vec3& way) const { return uniform_cone_inverse(k, frame_around(axis).to_local(way)); }
  double solid_angle() const { return 2 * pi * k; }
};

const geometry::Box box(Vec3(0, 0, 0), Vec3(1, 2, .5));

/// The disk across a way that light from afar departs from, behind what is in the box.
struct Disk {
  Vec3 centre = box.center();
  double radius = 0.5 * (1 + 1e-6) * box.diagonal().norm();
  Vec3 place(const Vec3& way, double a, double b) const {
    const Frame frame = frame_around(way);
    const double r = radius * std::sqrt(a);
    return centre - radius * way + r * (std::cos(2 * pi * b) * frame.s + std::sin(2 * pi * b) * frame.t);
  }
  Vec2 of(const Vec3& position, const Vec3& way) const {
    const Vec3 local = frame_around(way).to_local(position - centre);
    return {(local.x() * local.x() + local.y() * local.y()) / (radius * radius), core::turns_about_z(local)};
  }
  double area() const { return pi * radius * radius; }
};

/// The triangle of p and q at a, a + x p + y (1 - x) q, or the rectangle, a + x p + y q.
Chart flat_chart(const Vec3& a, const Vec3& p, const Vec3& q, bool is_triangle) {
  const Vec3 area = p.cross(q);
  const Cone ways{area.normalized(), 1};
  const auto left = [=](double x) { return is_triangle ? 1 - x : 1.; };
  return {{by_place, by_place, by_way, by_way},
          [=](const Four& x) {
            return Leaving{a + x[0] * p + x[1] * left(x[0]) * q, ways.way(x[2], x[3]), area.norm() * left(x[0]),
                           ways.solid_angle()};
          },
          [=](const Vec3& position, const Vec3& way) {
            const Vec3 d = position - a;
            const double x = d.cross(q).dot(area) / area.squaredNorm(), y = p.cross(d).dot(area) / area.squaredNorm();
            const Vec2 c = ways.of(way);
            return Four{x, y / left(x), c.x(), c.y()};
          }};
}

Chart ball_chart(const Vec3& centre, double radius) {
  const Cone normals{Vec3::UnitZ(), 2};
  return {
      {by_place, by_place, by_way, by_way},
      [=](const Four& x) {
        const Vec3 normal = normals.way(x[0], x[1]);
        const Cone ways{normal, 1};
        return Leaving{centre + radius * normal, ways.way(x[2], x[3]), 4 * pi * radius * radius, ways.solid_angle()};
      },
      [=](const Vec3& position, const Vec3& way) {
        const Vec3 normal = (position - centre) / radius;
        const Vec2 n = normals.of(normal), c = Cone{normal, 1}.of(way);
        return Four{n.x(), n.y(), c.x(), c.y()};
      }};
}

Chart point_chart(const Vec3& position, const Vec3& axis, double k) {
  const Cone ways{axis, k};
  return {{1, 1, by_way_alone, by_way_alone},
          [=](const Four& x) {
            return Leaving{position, ways.way(x[2], x[3]), 1, ways.solid_angle()};
          },
          [=](const Vec3&, const Vec3& way) {
            const Vec2 c = ways.of(way);
            return Four{.5, .5, c.x(), c.y()};
          }};
}

/// Light that comes from within a cone.
Chart afar_chart(const Vec3& towards, double k) {
  const Cone ways{-towards, k};
  const Disk disk;
  return {{by_place, by_place, by_way, by_way},
          [=](const Four& x) {
            const Vec3 way = ways.way(x[2], x[3]);
            return Leaving{disk.place(way, x[0], x[1]), way, disk.area(), ways.solid_angle()};
          },
          [=](const Vec3& position, const Vec3& way) {
            const Vec2 p = disk.of(position, way), c = ways.of(way);
            return Four{p.x(), p.y(), c.x(), c.y()};
          }};
}

Chart parallel_chart(const Vec3& way) {
  const Disk disk;
  return {{by_way_alone, by_way_alone, 1, 1},
          [=](const Four& x) {
            return Leaving{disk.place(way, x[0], x[1]), way, disk.area(), 1};
          },
          [=](const Vec3& position, const Vec3& along) {
            const Vec2 p = disk.of(position, along);
            return Four{p.x(), p.y(), .5, .5};
          }};
}

/// Two by two cells of ways a texel.
Chart map_chart(const scene::EnvironmentMap& map) {
  const Disk disk;
  return {{by_place, by_place, 2. * map.rows(), 2. * map.columns()},
          [=, &map](const Four& x) {
            const double theta = pi * x[2];
            const Vec3 way = -map.direction(std::cos(theta), x[3]);
            return Leaving{disk.place(way, x[0], x[1]), way, disk.area(), 2 * pi * pi * std::sin(theta)};
          },
          [=, &map](const Vec3& position, const Vec3& way) {
            const Vec2 p = disk.of(position, way);
            return Four{p.x(), p.y(), std::acos(std::clamp(map.cosine(-way), -1., 1.)) / pi, map.turns(-way)};
          }};
}

/// Of bright and dim texels, a dark row among them.
scene::EnvironmentMap some_map() {
  std::vector<Spectrum> texels;
  for (int r = 0; r < 6; ++r)
    for (int c = 0; c < 8; ++c) texels.emplace_back(r == 3 ? 0 : r == 1 && c == 5 ? 20 : c < 4 ? 1 : 3);
  return {Vec3::UnitY(), -Vec3::UnitZ(), 6, 8, std::move(texels)};
}

/// Of all of them: what they bring, where they are, and where they shine.
const Spectrum shines(2);
const Vec3 corner(1, 2, 3), aim = Vec3(1, 2, 2) / 3;

void add_surfaces(std::vector<Named>& kinds) {
  const Vec3 a = corner, p = Vec3(2, 1, -.5), q = Vec3(-.3, 1.2, 2), beside = p.cross(q).cross(p).normalized();
  const std::array triangle{a, Vec3(a + p), Vec3(a + q)};
  kinds.push_back({"triangle", std::make_unique<TriangleLight>(triangle, p.cross(q).normalized(), shines),
                   flat_chart(a, p, q, true)});
  kinds.push_back({"rectangle", std::make_unique<RectangleLight>(a, p, beside, p.cross(beside).normalized(), shines),
                   flat_chart(a, p, beside, false)});
  kinds.push_back(
      {"sphere", std::make_unique<BallLight>(scene::SphereLight{"ball", a, .7, shines}), ball_chart(a, .7)});
}

void add_points(std::vector<Named>& kinds) {
  kinds.push_back({"point", std::make_unique<PointSource>(scene::PointLight{"point", corner, shines}),
                   point_chart(corner, Vec3::UnitZ(), 2)});
  for (const auto& [beam, field] : {std::pair(.9, .6), std::pair(.5, .5), std::pair(1., -.5)})
    kinds.push_back({"spot of " + std::to_string(beam),
                     std::make_unique<Spot>(scene::SpotLight{"spot", corner, aim, shines, beam, field}),
                     point_chart(corner, aim, 1 - field)});
}

void add_from_afar(std::vector<Named>& kinds) {
  static const scene::EnvironmentMap map = some_map();
  const auto add = [&](std::string name, std::unique_ptr<Light> light, Chart chart) {
    kinds.push_back({std::move(name), std::move(light), std::move(chart)});
  };
  for (const double angle : {scene::Sun::seen_from_earth, .3}) {
    const scene::Sun sun{"sun", aim, shines, angle};
    add("sun of " + std::to_string(angle), std::make_unique<SunLight>(sun, box),
        afar_chart(-aim, 2 * std::pow(std::sin(angle / 2), 2)));
  }
  add("parallel sun", std::make_unique<SunLight>(scene::Sun{"sun", aim, shines, 0}, box), parallel_chart(aim));
  add("sky", std::make_unique<SkyLight>(scene::Sky{aim, shines, {}}, box), afar_chart(aim, 1));
  add("sky and ground", std::make_unique<SkyLight>(scene::Sky{aim, shines, shines / 2}, box), afar_chart(aim, 2));
  add("map", std::make_unique<EnvironmentLight>(map, box), map_chart(map));
}

std::vector<Named> all_kinds() {
  std::vector<Named> kinds;
  add_surfaces(kinds);
  add_points(kinds);
  add_from_afar(kinds);
  return kinds;
}

std::size_t cell_of(const Four& x, const Four& cells) {
  double cell = 0;
  for (std::size_t k = 0; k < 4; ++k) cell = cell * cells[k] + std::min(cells[k] - 1, std::floor(x[k] * cells[k]));
  return static_cast<std::size_t>(cell);
}

/// n times what the pdfs say of each cell, by midpoints: 2 a cell along each coordinate of the place, 6 of the way.
std::vector<double> expected_of(const Named& of, double n) {
  const Four& cells = of.chart.cells;
  Four steps;
  double all_cells = 1, all_steps = 1;
  for (std::size_t k = 0; k < 4; ++k) {
    steps[k] = cells[k] == 1 ? 1 : cells[k] * (k < 2 ? 2 : 6);
    all_cells *= cells[k], all_steps *= steps[k];
  }
  std::vector<double> expected(static_cast<std::size_t>(all_cells));
  Four x;
  for (double i = 0; i < steps[0]; ++i)
    for (double j = 0; j < steps[1]; ++j)
      for (double k = 0; k < steps[2]; ++k)
        for (double l = 0; l < steps[3]; ++l) {
          x = {(i + .5) / steps[0], (j + .5) / steps[1], (k + .5) / steps[2], (l + .5) / steps[3]};
          const Leaving at = of.chart.at(x);
          const EmissionPdfs pdf = of.light->pdfs_emission(at.position, at.way);
          expected[cell_of(x, cells)] += n * pdf.area * at.area * pdf.solid_angle * at.solid_angle / all_steps;
        }
  return expected;
}

// Chi-squared in four dimensions at once, 4 x 4 cells of the place by 6 x 6 of the way, so that places and ways that
// depended on each other would show; in two, 16 x 16, where one of them is delta.  Draws lie on the light.
TEST(LightEmission, falls_where_its_pdfs_say) {
  constexpr int n = 200'000;
  const std::vector<Named> kinds = all_kinds();
  test::Family family(test::tails_of_counts * kinds.size());
  std::uint32_t stream = 500;
  for (const Named& of : kinds) {
    const std::vector<double> expected = expected_of(of, n);
    std::vector<double> counts(expected.size());
    ++stream;
    for (std::uint64_t k = 0; k < n; ++k) {
      const Emission e = of.light->sample_emission(test::numbers_of(stream, k));
      const Four x = of.chart.of(e.position, e.way);
      for (const double each : x) ASSERT_TRUE(each > -1e-9 && each < 1 + 1e-9) << of.name << " " << each;
      const Leaving back = of.chart.at(x);
      ASSERT_LT((back.position - e.position).norm() + (back.way - e.way).norm(), 1e-6) << of.name;
      ++counts[cell_of(x, of.chart.cells)];
    }
    test::expect_as_expected(counts, expected, family, of.name);
  }
}

}  // namespace
}  // namespace interflect::montecarlo
