#include "fem/specular/specular_chains.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/random.h"
#include "fem/specular/light_caster.h"
#include "fem/specular/smooth_surface.h"
#include "fem/two_views.h"
#include "tests/fem/specular/mirrored_rooms.h"

namespace interflect::fem {
namespace {

using test::both;
using test::of_finish;
using test::parallelogram;

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

/// Counts of exchange by rays, K and its standard error.
ExchangeEntry by_rays(const scene::Scene& scene, const std::vector<scene::SurfacePatch>& patches, Index a, Index b,
                      std::uint64_t rays) {
  const auto caster = make_light_caster("brute", scene, 7);
  FormFactorContext context{scene, patches, *caster, 7};
  context.samples = rays;
  context.by_mirrors = true;
  const auto method = make_form_factor_method("hemisphere-rays", context);
  struct One final : ExchangeSink {
    Index a, b;
    ExchangeEntry found;
    void add(Index i, Index j, const ExchangeEntry& entry) override {
      if (i == a && j == b) found = entry;
    }
  } sink;
  sink.a = a, sink.b = b;
  core::LocalRun run(7, 1);
  const auto n = static_cast<Index>(patches.size());
  method->exchange({patches, 0, n}, {patches, 0, n}, sink, run.get());
  return sink.found;
}

/// K of two elements between which nothing is.
double analytic(const std::vector<scene::SurfacePatch>& patches) {
  scene::SceneBuilder builder({"a"}, scene::Quantity::radiometric);
  for (const scene::SurfacePatch& patch : patches)
    builder.add_polygon("e", {{patch.ring().begin(), patch.ring().end()}, {}}, builder.add_material(test::diffuse(.5)));
  const scene::Scene scene = builder.finish();
  const auto caster = raycast::make_ray_caster("brute", scene);
  const auto method = make_form_factor_method("analytic", {scene, patches, *caster, 1, 1e-9});
  test::MatrixSink sink(patches.size());
  core::LocalRun run(1, 1);
  method->exchange({patches, 0, 2}, {patches, 0, 2}, sink, run.get());
  return sink.K(0, 1);
}

/// Diffuse squares, each an element.
struct Squares {
  scene::SceneBuilder builder{{"a"}, scene::Quantity::radiometric};
  std::vector<scene::SurfacePatch> patches;

  void add(const Vec3& corner, const Vec3& u, const Vec3& v) {
    const auto id = builder.add_polygon("square", parallelogram(corner, u, v), builder.add_material(test::diffuse(.5)));
    const Vec3 ring[] = {corner, corner + u, corner + u + v, corner + v};
    patches.push_back(scene::make_patch(id, scene::Side::front, ring));
  }
};

/// Two squares beside each other, that face up, under a wide mirror at height h.
struct UnderMirror {
  explicit UnderMirror(double scale, double reflectance) {
    scene::SceneBuilder builder({"a", "b"}, scene::Quantity::radiometric);
    const auto square = [&](double at, double side) {
      const Vec3 corner = scale * at * x, u = scale * side * x, v = scale * side * y;
      const auto id =
          builder.add_polygon("square", parallelogram(corner, u, v), builder.add_material(test::diffuse(.5)));
      const Vec3 ring[] = {corner, corner + u, corner + u + v, corner + v};
      patches.push_back(scene::make_patch(id, scene::Side::front, ring));
      std::vector<Vec3> image;
      for (const Vec3& p : {ring[0], ring[3], ring[2], ring[1]}) image.emplace_back(p.x(), p.y(), 2 * scale * height);
      images.push_back(scene::make_patch(id, scene::Side::front, image));
    };
    square(0, 1);
    square(1.2, .7);
    builder.add_polygon("mirror", parallelogram(scale * Vec3(-50, -50, height), 100 * scale * y, 100 * scale * x),
                        builder.add_material(of_finish(scene::Mirror{Spectrum(reflectance)})));
    scene = builder.finish();
  }
  static constexpr double height = .8;
  scene::Scene scene;
  std::vector<scene::SurfacePatch> patches, images;
};

// The exchange by a mirror is that with the mirror image: of what faces away, and of an element with itself.
TEST(SpecularChains, see_mirror_images) {
  for (const double scale : {1.0, 1e-6, 1e6}) {
    const UnderMirror room(scale, .7);
    for (const auto& [a, b] : {std::pair<std::size_t, std::size_t>{0, 1}, {1, 0}, {0, 0}, {1, 1}}) {
      const double image = .7 * analytic({room.patches[a], room.images[b]});
      const ExchangeEntry found = by_rays(room.scene, room.patches, Index(a), Index(b), 1 << 17);
      EXPECT_NEAR(found.K, image, 4.5 * found.standard_error) << a << b << " at scale " << scale;
      EXPECT_LT(found.standard_error, .02 * image);
    }
  }
}

// Through a pane: the mean of its transmittance over the pairs of points, by quadrature of small parts.
TEST(SpecularChains, pass_panes) {
  Squares squares;
  auto& [builder, patches] = squares;
  squares.add(Vec3::Zero(), x, y);
  squares.add(Vec3(0, 0, 1), y, 2 * x);
  const scene::Material pane = of_finish(scene::Pane{Spectrum(.6)});
  builder.add_polygon("pane", parallelogram(Vec3(-9, -9, .5), 20 * x, 20 * y), builder.add_material(pane));
  const scene::Scene scene = builder.finish();
  double K = 0;  // sum over points' kernels, cos cos T / (pi r²)
  constexpr int n = 24;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < 2 * n; ++k)
        for (int l = 0; l < n; ++l) {
          const Vec3 d((k + .5) / n - (i + .5) / n, (l + .5) / n - (j + .5) / n, 1);
          const double r = d.norm(), cosine = 1 / r;
          K += smooth_parts(pane, cosine, scene::Side::front).passed[0] * cosine * cosine / (pi * r * r) /
               std::pow(n, 4);
        }
  const ExchangeEntry found = by_rays(scene, patches, 0, 1, 1 << 18);
  EXPECT_NEAR(found.K, K, 4 * found.standard_error + 1e-3 * K);
  EXPECT_LT(found.standard_error, .01 * K);
}

// A_i F_ij = A_j F_ji by way of a block of glass, whose rays are bent, and of total reflection within it.
TEST(SpecularChains, are_reciprocal_through_glass) {
  Squares squares;
  auto& [builder, patches] = squares;
  squares.add(Vec3::Zero(), x, y);
  squares.add(Vec3(1.2, .1, 1), .6 * y, .5 * x);
  builder.add_box("glass", {Vec3(-.3, -.3, .2), Vec3(1.8, 1.4, .7)},
                  builder.add_material(of_finish(scene::Glass{1.5, 0})));
  const scene::Scene scene = builder.finish();
  const ExchangeEntry there = by_rays(scene, patches, 0, 1, 1 << 19), back = by_rays(scene, patches, 1, 0, 1 << 19);
  EXPECT_NEAR(there.K, back.K, 4 * std::hypot(there.standard_error, back.standard_error));
  EXPECT_LT(std::hypot(there.standard_error, back.standard_error), .02 * there.K);
}

constexpr int chains_drawn = 40000;

/// Of chains along rays that `draw` draws, the mean weight of those that end on that surface.
template <class Draw>
Spectrum mean_weight(const scene::Scene& scene, const std::string& surface, const Draw& draw) {
  const auto rays = raycast::make_ray_caster("brute", scene);
  const SpecularChains chains(scene, *rays, 1);
  Spectrum sum;
  core::RandomNumbers random(3, 0, 0);
  for (int k = 0; k < chains_drawn; ++k) {
    const SpecularChains::End end = chains.follow(draw(random));
    if (end.at && scene.surface(end.at->surface).name == surface) sum += end.weight / double{chains_drawn};
  }
  return sum;
}

// Weights of coloured chains are what chance did not take, in the mean: R of each channel.
TEST(SpecularChains, carry_colours) {
  scene::SceneBuilder builder({"a", "b"}, scene::Quantity::radiometric);
  builder.add_polygon("floor", parallelogram(Vec3(-9, -9, 0), 18 * x, 18 * y), builder.add_material(test::diffuse(.5)));
  builder.add_polygon("mirror", parallelogram(Vec3(-9, -9, 1), 18 * y, 18 * x),
                      builder.add_material(of_finish(scene::Mirror{both(.9, .3)})));
  const scene::Scene scene = builder.finish();
  EXPECT_FALSE(are_smooth_ones_grey(scene));
  const Spectrum mean = mean_weight(scene, "floor", [](core::RandomNumbers& random) {
    const double across = random.next() - .5, along = random.next() - .5;
    return raycast::Ray{Vec3(0, 0, .5), Vec3(across, along, 1).normalized()};
  });
  EXPECT_NEAR(mean[0], .9, 4 * std::sqrt(.09 / chains_drawn));
  EXPECT_NEAR(mean[1], .3, 4 * std::sqrt(.01 / chains_drawn));
}

// The same of what passes: T of each channel, at right angles.
TEST(SpecularChains, carry_colours_through_panes) {
  scene::SceneBuilder builder({"a", "b"}, scene::Quantity::radiometric);
  builder.add_polygon("ceiling", parallelogram(Vec3(-9, -9, 2), 18 * y, 18 * x),
                      builder.add_material(test::diffuse(.5)));
  builder.add_polygon("pane", parallelogram(Vec3(-9, -9, 1), 18 * y, 18 * x),
                      builder.add_material(of_finish(scene::Pane{both(.8, .3)})));
  const Spectrum mean = mean_weight(builder.finish(), "ceiling", [](core::RandomNumbers& random) {
    const double across = random.next(), along = random.next();
    return raycast::Ray{Vec3(across, along, .5), z};
  });
  EXPECT_NEAR(mean[0], .8, 4 * std::sqrt(.16 / chains_drawn));
  EXPECT_NEAR(mean[1], .3, 4 * std::sqrt(.07 / chains_drawn));
}

// A pair is seen twice, an element by itself once.
TEST(TwoViews, of_an_element_with_itself_are_one) {
  TwoViews views(2);
  views.add(0, 0, {.3, .02, .01});
  views.add(0, 1, {.4, .02, 0});
  views.add(1, 0, {.4, .02, 0});
  EXPECT_NEAR(views.joined(0, 0).K, .3, 1e-7);
  EXPECT_NEAR(views.joined(0, 0).standard_error, .02, 1e-8);
  EXPECT_NEAR(views.joined(0, 0).bound, .01, 1e-8);
  EXPECT_NEAR(views.joined(0, 1).standard_error, .02 / std::sqrt(2), 1e-8);
}

TEST(SpecularChains, refuse_what_stands_inside_glass) {
  scene::SceneBuilder builder = test::furnace();
  builder.add_box("glass", {Vec3(1, .5, .2), Vec3(2, 1.5, .8)}, builder.add_material(of_finish(scene::Glass{1.5, 0})));
  builder.add_box("inside", {Vec3(1.3, .8, .4), Vec3(1.6, 1.1, .6)}, builder.add_material(test::painted(.5, .5)));
  const scene::Scene scene = builder.finish();
  std::vector<std::string> refusals;  // one and the same, whatever the threads
  for (const unsigned threads : {1u, 2u, 3u}) try {
      test::solved_by_rays(scene, .5, 256, threads);
      FAIL();
    } catch (const core::InputError& error) {
      refusals.emplace_back(error.what());
      EXPECT_NE(refusals.back().find("inside"), std::string::npos) << error.what();
      EXPECT_EQ(refusals.back(), refusals.front());
    }
  EXPECT_THROW(test::solved_by_rays(scene, .5, 256, 2, 1, "stochastic-jacobi"), core::InputError);
}

}  // namespace
}  // namespace interflect::fem
