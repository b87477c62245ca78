#include <gtest/gtest.h>

#include "montecarlo/film/splat_film.h"
#include "montecarlo/light_tracer.h"
#include "montecarlo/render.h"
#include "montecarlo/warp.h"
#include "scene/film_map.h"
#include "tests/montecarlo/statistics.h"
#include "tests/support/shapes.h"

namespace interflect::montecarlo {
namespace {

using namespace scene;  // NOLINT(google-build-using-namespace): its projections

constexpr int width = 12, height = 10;

/// The unit cube with B = 1 inside everywhere, of which half is reflected, and a camera in it, held askew.
Scene furnace(const Projection& projection) {
  SceneBuilder builder({"grey"});
  builder.add_box("cube", {Vec3(0, 0, 0), Vec3(1, 1, 1)}, builder.add_material(test::diffuse("wall", 0.5, 0.5)),
                  SceneBuilder::Facing::inward);
  builder.scene().cameras.push_back(
      {"eye", Vec3(0.5, 0.3, 0.45), Vec3(0.55, 0.8, 0.4), Vec3(0.3, 0.1, 1), projection, width, height});
  return builder.finish();
}

struct Named {
  const char* name;
  Projection projection;
};
const std::vector<Named> projections = {{"pinhole", Pinhole{90}},
                                        {"thin lens", ThinLens{80, 0.1, 0.35}},
                                        {"orthographic", Orthographic{0.4}},
                                        {"panoramic", Panoramic{360, 120}},
                                        {"equidistant", Fisheye{Fisheye::Mapping::equidistant, 220}},
                                        {"equisolid", Fisheye{Fisheye::Mapping::equisolid, 180}}};

enum class Within { disk, rim, nothing };
Within place_of(const Projection& projection, int x, int y) {
  if (!std::holds_alternative<Fisheye>(projection)) return Within::disk;
  const double dx = std::abs(x + 0.5 - width / 2.0), dy = std::abs(y + 0.5 - height / 2.0), r = height / 2.0;
  if (std::hypot(dx + 0.5, dy + 0.5) <= r) return Within::disk;
  return std::hypot(dx - 0.5, dy - 0.5) < r ? Within::rim : Within::nothing;
}

// Every pixel of a furnace is 1 / pi, by every projection; what a fisheye does not show is exactly black, and its rim is
// between them.
TEST(Cameras, show_a_furnace_as_one_even_radiance) {
  for (const auto& [name, projection] : projections) {
    const Scene scene = furnace(projection);
    core::LocalRun run;
    const Rendering found = render(scene, {0}, 256, run);
    const double limit = test::critical_z(test::alpha, width * height + 1);
    double sum = 0;
    int within = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const double L = found.radiance.at(x, y, 0), se = found.standard_error.at(x, y, 0);
        switch (place_of(projection, x, y)) {
          case Within::disk: {
            const double z = (L - inv_pi) / se;
            EXPECT_LT(std::abs(z), limit) << name << ' ' << x << ' ' << y;
            sum += z;
            ++within;
            break;
          }
          case Within::rim:
            EXPECT_LT(L, inv_pi + limit * se) << name << ' ' << x << ' ' << y;
            break;
          case Within::nothing:
            EXPECT_EQ(L, 0) << name << ' ' << x << ' ' << y;
            EXPECT_EQ(se, 0) << name << ' ' << x << ' ' << y;
        }
      }
    EXPECT_GT(within, 40) << name;
    EXPECT_LT(std::abs(sum / std::sqrt(within)), limit) << name;
  }
}

// Light that finds the film by itself: of the furnace's walls, of radiance 1 / pi, points y drawn by area, each joined
// to a point of the lens.  6 m² of walls, in sight of all:  pixel = E[6 / pi |cos_y| pdf_area].  The corners of a frame of
// 90 degrees would be .577 of the middle by one forgotten cosine.
TEST(Cameras, are_found_by_light_as_their_rays_find_it) {
  constexpr std::uint64_t paths = 400'000;
  const auto filter = make_filter("box");
  for (const auto& [name, projection] : projections) {
    const Scene scene = furnace(projection);
    const FilmMap map(scene.camera({0}));
    SplatFilm film(scene, width, height, *filter);
    core::LocalRun run;
    film.expose(paths, run, [&](std::uint64_t path, SplatFilm::Deposits& deposits) {
      core::RandomNumbers numbers(3, 0, path);
      const auto& facet =
          scene.facets[static_cast<std::size_t>(numbers.next() * static_cast<double>(scene.facets.size()))];
      const double u = numbers.next(), v = numbers.next(), r = numbers.next(), phi = numbers.next();
      const Vec3 y = triangle_point(facet.corner[0], facet.corner[1], facet.corner[2], u, v);
      const auto image = map.image_of(y, uniform_disk(r, phi));
      const Eigen::AlignedBox2d picture(Vec2(0, 0), Vec2(width, height));
      if (!image || !picture.contains(image->film)) return;  // parallels beside it begin outside of the cube
      const double cosine = -facet.normal.dot(image->ray.direction);
      ASSERT_GT(cosine, 0);
      deposits.add(image->film, test::grey(6 * inv_pi * cosine * image->pdf_area));
    });
    const double limit = test::critical_z(test::alpha, width * height + 1);
    double sum = 0;
    int within = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const Estimate pixel = film.estimate(x, y, Spectrum(1));
        if (place_of(projection, x, y) == Within::nothing) {
          EXPECT_EQ(pixel.value[0], 0);
        }
        if (place_of(projection, x, y) != Within::disk) continue;
        const double z = (pixel.value[0] - inv_pi) / pixel.standard_error[0];
        EXPECT_LT(std::abs(z), limit) << name << ' ' << x << ' ' << y << ": " << pixel.value[0] * pi;
        sum += z;
        ++within;
      }
    EXPECT_LT(std::abs(sum / std::sqrt(within)), limit) << name;
  }
}

// A black card of radiance 1 on its left half, in the plane of focus and twice as far: its edge, which a pinhole has
// between two pixels, is that sharp in focus, and else spread over R |z - F| / F / z of the plane at unit distance.
TEST(Cameras, focus_on_what_is_at_their_distance) {
  for (const double z : {1.0, 2.0}) {
    SceneBuilder builder({"grey"});
    builder.add_polygon("card", {{Vec3(-9, 9, -z), Vec3(-9, -9, -z), Vec3(0, -9, -z), Vec3(0, 9, -z)}, {}},
                        builder.add_material(test::diffuse("card", 0, pi)));
    builder.scene().cameras.push_back(
        {"lens", Vec3(0, 0, 0), -Vec3::UnitZ(), Vec3::UnitY(), ThinLens{90, 0.5, 1}, 8, 8});
    const Scene scene = builder.finish();
    const auto rays = raycast::make_ray_caster("embree", scene);
    // Of the plane a pixel is 1/4 wide; the edge is blurred over a disk of radius 1/4 there: pixels 3 and 4 lie in it.
    // Left of the edge by a in units of the radius, uniform in [0, 1], the disk is cut off beyond a:
    // mean dark part = int_0^1 (acos a - a sqrt(1 - a²)) / pi da = (1 - 1/3) / pi.
    const double dark = z == 1 ? 0 : 2 / (3 * pi);
    for (const char* integrator : {"path", "bidirectional", "distributed", "whitted"}) {
      RenderSettings settings;
      settings.integrator = integrator;
      settings.samples = 4096;
      settings.paths = measure::PathClasses::of("AE");
      core::LocalRun run;
      const Rendering found = render(scene, {0}, settings, run, *rays);
      for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
          const double truth = x < 3 ? 1 : x == 3 ? 1 - dark : x == 4 ? dark : 0;
          const double L = found.radiance.at(x, y, 0), se = found.standard_error.at(x, y, 0);
          EXPECT_LE(std::abs(L - truth),
                    (truth == 0 ? 0 : 1e-6) + test::critical_z(test::alpha, 512) * (truth == 0 ? 0 : se))
              << integrator << ' ' << z << ' ' << x << ' ' << y;
        }
    }
  }
}

TEST(Cameras, that_cannot_be_are_refused) {
  core::LocalRun run;
  const Scene scene = furnace(ThinLens{80, -1, 1});
  EXPECT_THROW(render(scene, {0}, 4, run), core::InputError);
  const std::vector<measure::Measurement> pixel{measure::PixelRadiance{{0}, 0, 0}};
  EXPECT_THROW(PathTracer({.samples = 4}).answer(scene, pixel, run), core::InputError);
  EXPECT_THROW(LightTracer({.samples = 4}).answer(scene, pixel, run), core::InputError);
}

}  // namespace
}  // namespace interflect::montecarlo
