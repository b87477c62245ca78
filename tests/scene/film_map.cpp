#include "scene/film_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/error.h"
#include "core/random.h"

namespace interflect::scene {
namespace {

struct Named {
  const char* name;
  Projection projection;
};

/// @param metre  the scene's scale, for lengths of lenses and pictures
std::vector<Named> projections(double metre) {
  return {{"pinhole", Pinhole{75}},
          {"thin lens", ThinLens{60, 0.04 * metre, 2.5 * metre}},
          {"orthographic", Orthographic{3 * metre}},
          {"panoramic", Panoramic{360, 180}},
          {"panoramic, part", Panoramic{200, 70}},
          {"equidistant", Fisheye{Fisheye::Mapping::equidistant, 200}},
          {"equisolid", Fisheye{Fisheye::Mapping::equisolid, 170}}};
}

Vec3 some_direction(core::RandomNumbers& numbers) {
  const double z = 2 * numbers.next() - 1, phi = 2 * pi * numbers.next(), r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// Somewhere, in a scene of a random size, held with a random upwards.
Camera some_camera(const Projection& projection, double metre, core::RandomNumbers& numbers) {
  Camera camera{"c", metre * some_direction(numbers), {}, some_direction(numbers), projection, 64, 40};
  camera.target = camera.eye + metre * (0.1 + numbers.next()) * some_direction(numbers);
  return camera;
}

double random_metre(core::RandomNumbers& numbers) { return std::pow(10, 8 * numbers.next() - 4); }

/// The ray of a film point finds it, and a place along the ray does, with the same ray and lens.
TEST(FilmMap, finds_the_film_point_of_every_ray_and_of_every_place_along_it) {
  for (std::uint32_t k = 0; k < 400; ++k) {
    core::RandomNumbers numbers(7, 0, k);
    const double metre = random_metre(numbers);
    for (const auto& [name, projection] : projections(metre)) {
      const FilmMap map(some_camera(projection, metre, numbers));
      const Vec2 film(64 * numbers.next(), 40 * numbers.next());
      const double u = numbers.next();
      const Vec2 lens = uniform_disk(u, numbers.next());
      const auto ray = map.ray(film, lens);
      if (!ray) {
        EXPECT_TRUE(std::holds_alternative<Fisheye>(projection)) << name;
        EXPECT_GT((film - Vec2(32, 20)).norm(), 20);
        continue;
      }
      EXPECT_NEAR(ray->direction.norm(), 1, 1e-15) << name;
      const auto back = map.film_of(*ray);
      ASSERT_TRUE(back) << name;
      EXPECT_LT((*back - film).norm(), 64e-12) << name;
      const double distance = metre * (0.5 + 5 * numbers.next());
      const auto image = map.image_of(ray->origin + distance * ray->direction, lens);
      ASSERT_TRUE(image) << name;
      EXPECT_LT((image->film - film).norm(), 64e-12) << name;
      EXPECT_LT((image->ray.direction - ray->direction).norm(), 1e-12) << name;
      EXPECT_LT((image->ray.origin - ray->origin).norm(), 1e-12 * metre) << name;
      EXPECT_NEAR(image->distance, distance, 1e-12 * distance) << name;
    }
  }
}

/// p is the Jacobian of film by direction: with r(x, y) the direction, |r_x x r_y| p = 1, r_x by differences of fourth
/// order, h = 1/64 pixel: an error of h^4 f'''''/30 and rounding 1e-16 / h, both below 1e-9 a pixel of 1/64 of the view.
TEST(FilmMap, knows_its_density_in_solid_angle) {
  constexpr double h = 1.0 / 64;
  for (std::uint32_t k = 0; k < 200; ++k) {
    core::RandomNumbers numbers(8, 0, k);
    for (const auto& [name, projection] : projections(1)) {
      if (std::holds_alternative<Orthographic>(projection)) continue;
      const FilmMap map(some_camera(projection, 1, numbers));
      const double r = 18 * std::sqrt(numbers.next()), phi = 2 * pi * numbers.next();
      const Vec2 film(32 + r * std::cos(phi), 20 + r * std::sin(phi));
      const double u = numbers.next();
      const Vec2 lens = uniform_disk(u, numbers.next());
      const auto at = [&](double x, double y) { return map.ray(film + Vec2(x, y), lens).value().direction; };
      const Vec3 along_x = (8 * (at(h, 0) - at(-h, 0)) - (at(2 * h, 0) - at(-2 * h, 0))) / (12 * h),
                 along_y = (8 * (at(0, h) - at(0, -h)) - (at(0, 2 * h) - at(0, -2 * h))) / (12 * h);
      EXPECT_NEAR(along_x.cross(along_y).norm() * map.pdf_solid_angle(at(0, 0)), 1, 1e-7) << name << ' ' << film.y();
    }
  }
}

/// int W cos dsigma dA over a pixel is 1, by directions a, b, c = sqrt(1 - a² - b²) about its middle ray, dsigma = da db /
/// c, in a window that is a little larger than the pixel; what does not fall on the pixel counts 0.  W is smooth but for
/// its jump at the rim, which 400 x 400 directions meet within 1 / 400 of the width on each side.
TEST(FilmMap, has_an_importance_that_integrates_to_one_over_a_pixel) {
  core::RandomNumbers numbers(9, 0, 0);
  for (const auto& [name, projection] : projections(1)) {
    if (std::holds_alternative<Orthographic>(projection)) continue;
    const Camera camera = some_camera(projection, 1, numbers);
    const FilmMap map(camera);
    const Vec3 forward = (camera.target - camera.eye).normalized();
    const auto* lens_of = std::get_if<ThinLens>(&projection);
    const bool flat = lens_of != nullptr || camera.is_pinhole();
    for (const auto& [px, py] : {std::pair{32, 20}, {25, 8}, {40, 33}}) {
      const double area = lens_of ? pi * lens_of->radius * lens_of->radius : 1;
      double sum = 0;
      const int lenses = lens_of ? 3 : 1;
      for (int l = 0; l < lenses; ++l) {
        const Vec2 lens = lens_of ? uniform_disk((l + .5) / 3, 0.3 * l) : Vec2(0, 0);
        const CameraRay middle = map.ray({px + .5, py + .5}, lens).value();
        const Vec3 side = middle.direction.unitOrthogonal(), other = middle.direction.cross(side);
        double reach = 0;  // of the corners from the middle
        for (const auto& [dx, dy] : {std::pair{0, 0}, {0, 1}, {1, 0}, {1, 1}})
          reach = std::max(reach, (map.ray(Vec2(px + dx, py + dy), lens)->direction - middle.direction).norm());
        const double edge = 1.3 * reach;
        constexpr int n = 400;
        for (int i = 0; i < n; ++i)
          for (int j = 0; j < n; ++j) {
            const double a = edge * (2 * (i + .5) / n - 1), b = edge * (2 * (j + .5) / n - 1),
                         c = std::sqrt(1 - a * a - b * b);
            const Vec3 direction = a * side + b * other + c * middle.direction;
            const auto film = map.film_of({middle.origin, direction});
            if (!film || std::floor(film->x()) != px || std::floor(film->y()) != py) continue;
            const double W = map.importance(direction), cosine = flat ? direction.dot(forward) : 1;
            sum += W * cosine * area / lenses * (4 * edge * edge / (n * n)) / c;
          }
      }
      EXPECT_NEAR(sum, 1, 0.01) << name << ' ' << px << ' ' << py;
    }
  }
}

// The places that a pixel sees in the plane through the target: their area times the density there is 1.
TEST(FilmMap, has_parallels_where_it_is_orthographic) {
  core::RandomNumbers numbers(10, 0, 0);
  const Camera camera = some_camera(Orthographic{3}, 1, numbers);
  const FilmMap map(camera);
  const CameraRay a = map.ray({10, 20}).value(), b = map.ray({11, 20}).value(), c = map.ray({10, 21}).value();
  const Vec3 forward = (camera.target - camera.eye).normalized();
  for (const CameraRay& ray : {a, b, c}) EXPECT_LT((ray.direction - forward).norm(), 1e-15);
  EXPECT_NEAR((b.origin - a.origin).norm(), 3.0 / 40, 1e-14);
  EXPECT_NEAR((c.origin - a.origin).norm(), 3.0 / 40, 1e-14);
  const auto image = map.image_of(a.origin + 2 * a.direction);
  EXPECT_NEAR(image->pdf_area * std::pow(3.0 / 40, 2), 1, 1e-14);
  EXPECT_FALSE(map.image_of(a.origin - 2 * a.direction));
  EXPECT_EQ(map.pdf_solid_angle(forward), 0);
}

// In the plane of focus all rays of a film point meet, where a pinhole's ray arrives.  Elsewhere, at depth z, they fill
// the disk of radius R |z - F| / F about it.
TEST(FilmMap, focuses_a_thin_lens) {
  for (std::uint32_t k = 0; k < 100; ++k) {
    core::RandomNumbers numbers(11, 0, k);
    const double R = 0.1, F = 2;
    Camera camera = some_camera(ThinLens{60, R, F}, 1, numbers);
    const FilmMap lens(camera);
    camera.projection = Pinhole{60};
    const FilmMap pinhole(camera);
    const Vec3 forward = (camera.target - camera.eye).normalized();
    const Vec2 film(64 * numbers.next(), 40 * numbers.next());
    const auto at_depth = [&](const CameraRay& ray, double z) {
      return Vec3(ray.origin +
                  (z - (ray.origin - camera.eye).dot(forward)) / ray.direction.dot(forward) * ray.direction);
    };
    const CameraRay middle = pinhole.ray(film).value();
    for (int i = 0; i < 8; ++i) {
      const Vec2 rim(std::cos(i * pi / 4), std::sin(i * pi / 4));
      const CameraRay ray = lens.ray(film, rim).value();
      EXPECT_NEAR((ray.origin - camera.eye).norm(), R, 1e-15);
      EXPECT_NEAR((ray.origin - camera.eye).dot(forward), 0, 1e-15);
      EXPECT_LT((at_depth(ray, F) - at_depth(middle, F)).norm(), 1e-14);
      for (const double z : {0.5, 1.7, 5.0})
        EXPECT_NEAR((at_depth(ray, z) - at_depth(middle, z)).norm(), R * std::abs(z - F) / F, 1e-13);
    }
    // On the film: what is sharp for the pinhole at depth z is a disk there.
    const Vec3 place = at_depth(middle, 5.0);
    const double pixels_a_radian = 40 / (2 * std::tan(30 * pi / 180));
    for (int i = 0; i < 8; ++i) {
      const auto image = lens.image_of(place, {std::cos(i * pi / 4), std::sin(i * pi / 4)});
      EXPECT_NEAR((image->film - film).norm(), pixels_a_radian * R * (5 - F) / (F * 5), 1e-11);
    }
  }
}

// Longitude and latitude, and circles about the axis, where they are known.
TEST(FilmMap, shows_directions_where_projections_have_them) {
  Camera camera{"c", {0, 0, 0}, {0, 1, 0}, Vec3::UnitZ(), Panoramic{360, 180}, 360, 180};
  const auto near = [](const Vec3& a, const Vec3& b) { return (a - b).norm() < 1e-14; };
  EXPECT_TRUE(near(camera.direction(180, 90), {0, 1, 0}));
  EXPECT_TRUE(near(camera.direction(270, 90), {1, 0, 0}));
  EXPECT_TRUE(near(camera.direction(0, 90), {0, -1, 0}));
  EXPECT_TRUE(near(camera.direction(180, 0), {0, 0, 1}));
  EXPECT_TRUE(near(camera.direction(180, 60), {0, std::cos(pi / 6), std::sin(pi / 6)}));
  camera.projection = Fisheye{Fisheye::Mapping::equidistant, 180};
  EXPECT_TRUE(near(camera.direction(180, 90), {0, 1, 0}));
  EXPECT_TRUE(near(camera.direction(225, 90), Vec3(1, 1, 0).normalized()));
  EXPECT_TRUE(near(camera.direction(180, 45), Vec3(0, 1, 1).normalized()));
  EXPECT_FALSE(camera.ray(275, 90));
  camera.projection = Fisheye{Fisheye::Mapping::equisolid, 180};
  // Half of the hemisphere's solid angle lies within 60 degrees, and within 1 / sqrt(2) of the disk.
  EXPECT_TRUE(near(camera.direction(180 + 90 / std::sqrt(2.0), 90), {std::sin(pi / 3), std::cos(pi / 3), 0}));
}

TEST(FilmMap, tells_which_pixels_a_fisheye_has_none_of) {
  const FilmMap map(Camera{"c", {0, 0, 0}, {0, 1, 0}, Vec3::UnitZ(), Fisheye{}, 64, 40});
  EXPECT_TRUE(map.in_sight({32, 20}, {33, 21}));
  EXPECT_TRUE(map.in_sight({12, 19}, {13, 20}));
  EXPECT_FALSE(map.in_sight({11, 19}, {12, 20}));
  EXPECT_FALSE(map.in_sight({12, 0}, {13, 1}));
  EXPECT_TRUE(map.in_sight({11.5, 19}, {12.5, 20}));  // within a filter's reach
}

TEST(FilmMap, refuses_cameras_that_cannot_be) {
  Camera camera{"c", {0, 0, 0}, {0, 1, 0}, Vec3::UnitZ(), Pinhole{}, 64, 40};
  EXPECT_NO_THROW(require_valid(camera));
  for (const Projection& bad :
       {Projection(Pinhole{180}), Projection(Pinhole{0}), Projection(ThinLens{50, 0, 1}),
        Projection(ThinLens{50, -0.1, 1}), Projection(ThinLens{50, 0.1, 0}), Projection(Orthographic{0}),
        Projection(Panoramic{361, 180}), Projection(Panoramic{360, 0}), Projection(Fisheye{{}, 0}),
        Projection(Fisheye{{}, 361})}) {
    camera.projection = bad;
    EXPECT_THROW(require_valid(camera), core::InputError) << camera.projection_name();
  }
  camera.projection = Pinhole{};
  camera.up = {0, 2, 0};
  EXPECT_THROW(require_valid(camera), core::InputError);
}

}  // namespace
}  // namespace interflect::scene
