#include "core/fresnel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace interflect::core {
namespace {

double degrees(double angle) { return std::cos(angle * pi / 180); }

// Glass of index 1.5, by the formulas in high precision.
TEST(Fresnel, of_glass_is_known) {
  const struct {
    double angle, s, p, pane;
  } known[] = {{0, .04, .04, .9230769231},
               {30, .0577961054, .02524914655, .9207344439},
               {45, .09201336305, .008466458979, .9073443298},
               {60, .1765714881, .001801937522, .8481284097},
               {75, .399356027, .106765099, .6181485163},
               {85, .7323454787, .4932538118, .2469305804}};
  for (const auto& [angle, s, p, pane] : known) {
    const Polarised r = fresnel(degrees(angle), 1.5);
    EXPECT_NEAR(r.s, s, 1e-9 * s + 5e-11) << angle;
    EXPECT_NEAR(r.p, p, 2e-9 * p + 5e-11) << angle;
    EXPECT_NEAR((Pane{1.5, 1}(degrees(angle)).transmitted), pane, 1e-10) << angle;
  }
}

TEST(Fresnel, of_conductors_is_known) {
  const double known[][5] = {{.2, 3, .9233716475, .9184110847, .9635985618},
                             {1.1, 6.8, .9131293189, .8976077078, .8709168411}};
  for (const auto& [eta, k, at_0, at_60, at_85] : known) {
    EXPECT_NEAR(fresnel(1, eta, k).mean(), at_0, 1e-10);
    EXPECT_NEAR(fresnel(degrees(60), eta, k).mean(), at_60, 1e-10);
    EXPECT_NEAR(fresnel(degrees(85), eta, k).mean(), at_85, 1e-10);
  }
  for (const double c : {0.0, .1, .5, 1.0}) EXPECT_NEAR(fresnel(c, 1.5, 0).mean(), fresnel(c, 1.5).mean(), 1e-14);
}

// A ray and its reverse lose the same part, and a boundary between equal media is none.
TEST(Fresnel, is_the_same_from_either_side) {
  for (const double eta : {1.01, 1.33, 1.5, 3.0})
    for (double c = .02; c < 1; c += .07) {
      const double behind = *refracted_cosine(c, eta);
      EXPECT_NEAR(fresnel(c, eta).s, fresnel(behind, 1 / eta).s, 1e-12);
      EXPECT_NEAR(fresnel(c, eta).p, fresnel(behind, 1 / eta).p, 1e-12);
    }
  EXPECT_NEAR(fresnel(.3, 1).mean(), 0, 1e-30);
  EXPECT_EQ(fresnel(0, 1.5).mean(), 1);
  EXPECT_EQ(fresnel(.5, 1 / 1.5).mean(), 1);                            // beyond the critical angle
  EXPECT_NEAR(fresnel(1 / std::sqrt(1 + 1.5 * 1.5), 1.5).p, 0, 1e-30);  // Brewster's angle
}

// Light that is inside everywhere alike leaves as much as enters: (1 - F_i) n² = 1 - F_e.
TEST(Fresnel, of_diffuse_light_is_known_and_keeps_the_balance) {
  EXPECT_NEAR(diffuse_fresnel(1.5), .0917779593424, 1e-11);
  EXPECT_NEAR(diffuse_fresnel(1 / 1.5), .596345759708, 1e-11);
  EXPECT_NEAR(diffuse_fresnel(1.33), .0659308492994, 1e-11);
  EXPECT_NEAR(diffuse_fresnel(1 / 1.33), .471949148793, 1e-11);
  for (const double eta : {1.05, 1.2, 2.0, 4.0})
    EXPECT_NEAR((1 - diffuse_fresnel(1 / eta)) * eta * eta, 1 - diffuse_fresnel(eta), 1e-9) << eta;
}

TEST(Pane, transmits_diffuse_light_as_known) {
  double diffuse = 0;
  constexpr int n = 20000;
  const Pane clear{1.5, 1};
  for (int k = 0; k < n; ++k) {
    const double c = (k + .5) / n;
    diffuse += clear(c).transmitted * 2 * c / n;
    EXPECT_NEAR(clear(c).transmitted + clear(c).reflected, 1, 1e-14);
  }
  EXPECT_NEAR(diffuse, .850938300896, 1e-7);
}

// What is given is what it transmits; less the more obliquely it is crossed, and never more than arrives.
TEST(Pane, is_made_by_what_it_transmits) {
  for (const double T : {0.0, .01, .5, .78, .9, .96 / 1.04}) {
    const Pane pane = Pane::of(1.5, T);
    EXPECT_NEAR(pane(1).transmitted, T, 1e-14);
    for (double c = .05; c < 1; c += .1) {
      EXPECT_LE(pane(c).transmitted + pane(c).reflected, 1 + 1e-14);
      EXPECT_LE(pane(c).transmitted, pane(1).transmitted + 1e-14);
    }
  }
}

TEST(Refraction, keeps_to_its_plane_and_to_snell) {
  const Vec3 normal = Vec3(.3, -.4, .86602540378443864676).normalized();
  for (const double eta : {.7, 1.0, 1.5}) {
    const Vec3 way = (normal + Vec3(.3, .2, -.1)).normalized();
    const Vec3 on = *refracted(way, normal, eta);
    EXPECT_NEAR(on.norm(), 1, 1e-14);
    EXPECT_LT(on.dot(normal), 0);
    EXPECT_NEAR((on.cross(normal) * eta + way.cross(normal)).norm(), 0, 1e-14);  // tangential parts, opposite
    EXPECT_NEAR((*refracted(on, normal, 1 / eta) - way).norm(), 0, 1e-13);       // and back
    EXPECT_NEAR((reflected(way, normal) + way).cross(normal).norm(), 0, 1e-14);
    EXPECT_NEAR(reflected(way, normal).dot(normal), way.dot(normal), 1e-15);
  }
  EXPECT_FALSE(refracted(Vec3(.9, 0, std::sqrt(1 - .81)), Vec3(0, 0, 1), 1 / 1.5));
}

}  // namespace
}  // namespace interflect::core
