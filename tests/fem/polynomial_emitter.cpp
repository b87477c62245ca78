#include "fem/form_factor/polynomial_emitter.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "fem/form_factor/distant_emitter.h"
#include "fem/form_factor/point_to_polygon.h"
#include "fem/kernel.h"
#include "fem/quadrature.h"

namespace interflect::fem {
namespace {

using Ring = std::vector<Vec3>;

PlaneFrame frame_of(const Ring& ring) {
  const Vec3 e_1 = (ring[1] - ring[0]).normalized(), n = (ring[1] - ring[0]).cross(ring.back() - ring[0]).normalized();
  return {ring[0], e_1, n.cross(e_1)};
}

std::vector<double> closed(const Vec3& x, const Vec3& n, const Ring& ring, int order) {
  std::vector<double> F(static_cast<std::size_t>(plane_functions(order)));
  point_to_monomials(x, n, ring, frame_of(ring), order, F);
  return F;
}

/// By products of Gauss rules on parts of parts, of a triangle or quad.
std::vector<double> integrated(const Vec3& x, const Vec3& n, const Ring& ring, int order, int parts) {
  const PlaneFrame frame = frame_of(ring);
  const Vec3 normal = frame.e_1.cross(frame.e_2);
  std::vector<double> F(static_cast<std::size_t>(plane_functions(order)), 0);
  const Rule rule = gauss_legendre(12);
  const SpaceKernel kernel;
  for (int i = 0; i < parts; ++i)
    for (int j = 0; j < parts; ++j)
      for (const RuleNode& a : rule)
        for (const RuleNode& b : rule) {
          double u = (i + a.u) / parts, squeezed = 1;
          const double v = (j + b.u) / parts;
          if (ring.size() == 3) u *= squeezed = 1 - v;
          const Vec3 y = point_on(ring, u, v);
          const double k = a.weight * b.weight / (parts * parts) * squeezed * jacobian(ring, u, v) *
                           kernel(x, n, y, normal),
                       xi = frame.e_1.dot(y - frame.origin), eta = frame.e_2.dot(y - frame.origin);
          for (int d = 0, at = 0; d <= order; ++d)
            for (int e = 0; e <= d; ++e, ++at)
              F[static_cast<std::size_t>(at)] += k * std::pow(xi, d - e) * std::pow(eta, e);
        }
  return F;
}

const std::vector<Ring> rings = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                                 {{0, 0, 0}, {2, .3, 0}, {.4, 1.1, 0}},
                                 {{0, 0, 0}, {1.5, -.2, 0}, {1.1, 1, 0}, {.1, .8, 0}}};

// Points over the polygon, beside it, over an edge and over a corner, whose horizons it lies above.
TEST(PolynomialEmitter, is_what_quadrature_finds) {
  for (const Ring& ring : rings)
    for (const Vec3& x : {Vec3(.4, .3, .5), Vec3(2.5, .5, .4), Vec3(.5, 0, .7), Vec3(0, 0, .6), Vec3(-1, 2, .8)})
      for (const Vec3& tilt : {Vec3(0, 0, 0), Vec3(.3, .1, 0), Vec3(-.2, .4, 0)}) {
        const Vec3 n = (Vec3(.5, .5, 0) - x + tilt).normalized();
        bool above = true;
        for (const Vec3& p : ring) above = above && n.dot(p - x) > 0;
        if (!above) continue;
        const auto F = closed(x, n, ring, 3), G = integrated(x, n, ring, 3, 8);
        for (std::size_t k = 0; k < F.size(); ++k) EXPECT_NEAR(F[k], G[k], 1e-12) << k << " " << x.transpose();
      }
}

// Polygons of three to five corners, 2 to 30 of their sizes away: errors are within what was asked, of what the kernel
// is at most; and rules are taken from where they should be.
TEST(PolynomialEmitter, of_distant_polygons_is_found_by_rules_to_the_accuracy_asked) {
  core::RandomNumbers random(17, 0, 0);
  int taken = 0, asked = 0;
  for (const double accuracy : {1e-2, 1e-4, 1e-6})
    for (int k = 0; k < 2000; ++k) {
      const int corners = 3 + k % 3;
      Ring ring;
      const double turn = random.next();
      for (int c = 0; c < corners; ++c) {
        const double angle = 2 * pi * (c + .6 * random.next() + turn) / corners;
        ring.emplace_back(std::cos(angle), .7 * std::sin(angle), 0);
      }
      const double distance = 2 * std::pow(15.0, random.next()), cosine = .05 + .95 * random.next(),
                   azimuth = 2 * pi * random.next(), sine = std::sqrt(1 - cosine * cosine);
      const Vec3 x = distance * Vec3(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
      const Vec3 n = (Vec3(random.next() - .5, random.next() - .5, 0) * .4 * distance - x).normalized();
      bool above = true;
      for (const Vec3& p : ring) above = above && n.dot(p - x) > 0;
      if (!above) continue;
      const PlaneFrame frame{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()};
      std::array<double, 10> far{}, exact{};
      const int order = k % 4;
      ++asked;
      if (!distant_monomials(x, n, ring, frame, order, accuracy, far)) continue;
      ++taken;
      point_to_monomials(x, n, ring, frame, order, exact);
      double area = 0, nearest = distance;
      for (std::size_t c = 2; c < ring.size(); ++c)
        area += .5 * (ring[c - 1] - ring[0]).cross(ring[c] - ring[0]).norm();
      for (const Vec3& p : ring) nearest = std::min(nearest, (p - x).norm());
      const double most = x.z() * area / (pi * nearest * nearest * nearest),
                   rounding = 1e-13 * std::pow(distance, order);
      for (int m = 0; m < plane_functions(order); ++m)
        EXPECT_NEAR(far[static_cast<std::size_t>(m)], exact[static_cast<std::size_t>(m)], accuracy * most + rounding)
            << order << ' ' << distance;
    }
  EXPECT_GT(taken, asked / 3);
}

TEST(PolynomialEmitter, of_degree_0_is_lamberts_formula) {
  core::RandomNumbers random(5, 0, 0);
  for (const Ring& ring : rings)
    for (int k = 0; k < 100; ++k) {
      const double a = random.next(), b = random.next(), c = random.next();
      const Vec3 x(3 * a - 1, 3 * b - 1, .05 + 2 * c), n = (Vec3(.5, .5, 0) - x).normalized();
      bool above = true;
      for (const Vec3& p : ring) above = above && n.dot(p - x) > 0;
      if (!above) continue;
      EXPECT_NEAR(closed(x, n, ring, 0)[0], point_to_polygon(x, n, ring), 1e-13);
    }
}

// Where quadrature is at its wits' end, against parts that meet in the foot.  Coordinates are rounded by 1e-16, of h.
TEST(PolynomialEmitter, is_additive_close_to_its_plane) {
  const Ring square = rings[0];
  for (const double h : {1e-2, 1e-4, 1e-8}) {
    const Vec3 x(.3, .6, h), n(0, 0, -1);
    const auto whole = closed(x, n, square, 3);
    std::vector<double> sum(whole.size(), 0);
    const PlaneFrame frame = frame_of(square);
    for (std::size_t k = 0; k < 4; ++k) {
      const Ring part{Vec3(.3, .6, 0), square[k], square[(k + 1) % 4]};
      std::vector<double> F(sum.size());
      point_to_monomials(x, n, part, frame, 3, F);
      for (std::size_t l = 0; l < F.size(); ++l) sum[l] += F[l];
    }
    for (std::size_t l = 0; l < sum.size(); ++l) EXPECT_NEAR(sum[l], whole[l], 1e-13 + 1e-16 / h) << h << " " << l;
    EXPECT_NEAR(whole[0], 1, 2 * h) << "it sees nothing else";
    EXPECT_NEAR(whole[1], .3, 3 * h * std::abs(std::log(h)) + 1e-12) << "nor but the place below";
    EXPECT_NEAR(whole[2], .6, 3 * h * std::abs(std::log(h)) + 1e-12);
  }
}

TEST(PolynomialEmitter, does_not_depend_on_the_unit_but_by_its_powers) {
  const Vec3 x(.4, .3, .5), n = Vec3(.1, .2, -1).normalized();
  const auto F = closed(x, n, rings[2], 3);
  for (const double scale : {1e-6, 1e6}) {
    Ring ring = rings[2];
    for (Vec3& p : ring) p *= scale;
    const auto G = closed(scale * x, n, ring, 3);
    for (int d = 0, at = 0; d <= 3; ++d)
      for (int e = 0; e <= d; ++e, ++at)
        EXPECT_NEAR(G[static_cast<std::size_t>(at)] / std::pow(scale, d), F[static_cast<std::size_t>(at)], 1e-12);
  }
}

TEST(PolynomialEmitter, is_nothing_from_behind) {
  for (const double F : closed({.5, .5, -.3}, {0, 0, 1}, rings[0], 3)) EXPECT_EQ(F, 0);
  for (const double F : closed({2, .5, 0}, {-1, 0, 0}, rings[0], 3)) EXPECT_EQ(F, 0);
}

}  // namespace
}  // namespace interflect::fem
