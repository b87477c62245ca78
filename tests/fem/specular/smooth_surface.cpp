#include "fem/specular/smooth_surface.h"

#include <gtest/gtest.h>

#include "core/fresnel.h"

namespace interflect::fem {
namespace {

using scene::Side;

scene::Material of(scene::Finish finish) {
  scene::Material material;
  material.finish = std::move(finish);
  material.sides = scene::Sides::both;
  return material;
}

TEST(SmoothSurface, glass_loses_nothing_and_is_the_same_from_both_sides_of_a_ray) {
  const scene::Material glass = of(scene::Glass{1.5, 0});
  for (double cosine : {1.0, 0.9, 0.5, 0.1, 0.01}) {
    const SmoothParts in = smooth_parts(glass, cosine, Side::front);
    EXPECT_NEAR(in.reflected[0] + in.passed[0], 1, 1e-15);
    EXPECT_EQ(in.eta, 1.5);
    const SmoothParts out = smooth_parts(glass, *core::refracted_cosine(cosine, 1.5), Side::back);
    EXPECT_NEAR(in.passed[0], out.passed[0], 1e-13);
  }
  EXPECT_NEAR(smooth_parts(glass, 1, Side::front).reflected[0], 0.04, 1e-15);
  EXPECT_EQ(smooth_parts(glass, 0.5, Side::back).passed[0], 0);  // all is reflected
}

// At right angles: a pane's given part; ((n - 1)² + k²) / ((n + 1)² + k²) of a metal; R_0.
TEST(SmoothSurface, is_what_it_is_known_by_at_normal_incidence) {
  Spectrum tint;
  tint[0] = .8, tint[1] = .3;
  const SmoothParts pane = smooth_parts(of(scene::Pane{tint}), 1, Side::front);
  EXPECT_NEAR(pane.passed[0], .8, 1e-12);
  EXPECT_NEAR(pane.passed[1], .3, 1e-12);
  EXPECT_LE(pane.passed[0] + pane.reflected[0], 1);
  const scene::Metal::Index gold{Spectrum(.27), Spectrum(2.78)};
  EXPECT_NEAR(smooth_parts(of(scene::Metal{gold, 0}), 1, Side::front).reflected[0],
              (.73 * .73 + 2.78 * 2.78) / (1.27 * 1.27 + 2.78 * 2.78), 1e-12);
  const scene::Material metal = of(scene::Metal{tint, 0});
  EXPECT_NEAR(smooth_parts(metal, 1, Side::front).reflected[1], .3, 1e-15);
  EXPECT_NEAR(smooth_parts(metal, 0, Side::front).reflected[1], 1, 1e-15);
  EXPECT_EQ(smooth_parts(of(scene::Mirror{tint}), .2, Side::back).reflected[0], .8);
}

TEST(SmoothSurface, what_scatters_otherwise_is_none) {
  EXPECT_TRUE(is_smooth(of(scene::Mirror{})) && is_smooth(of(scene::Pane{})) && is_smooth(of(scene::Glass{1.3, 0})));
  EXPECT_TRUE(is_smooth(of(scene::Metal{Spectrum(.5), 0})));
  EXPECT_FALSE(is_smooth(of(scene::Metal{Spectrum(.5), .2})) || is_smooth(of(scene::Glass{1.5, .1})));
  EXPECT_FALSE(is_smooth(of(scene::Lambertian{})) || is_smooth(of(scene::Plastic{})));
  scene::Material net = of(scene::Mirror{});
  net.opacity = .5;
  EXPECT_FALSE(is_smooth(net));
}

}  // namespace
}  // namespace interflect::fem
