#include "montecarlo/warp.h"

#include <gtest/gtest.h>

#include "montecarlo/alias_table.h"
#include "tests/support/family.h"
#include "tests/support/shapes.h"

namespace interflect::montecarlo {
namespace {

constexpr double almost_one = 1 - 0x1p-53;

/// Of a test whose one comparison it is.
double chi2_limit(int degrees) { return test::chi_squared_limit(degrees, test::alpha); }

double chi2(const std::vector<int>& counts, double expected) {
  double sum = 0;
  for (int count : counts) sum += (count - expected) * (count - expected) / expected;
  return sum;
}

TEST(Warps, frames_are_orthonormal_and_right_handed_about_every_normal) {
  core::RandomNumbers numbers(1, 0, 0);
  std::vector<Vec3> normals{Vec3::UnitZ(), -Vec3::UnitZ(), Vec3::UnitX(), Vec3(1e-9, 0, -1).normalized(),
                            Vec3(0, 1e-300, -1)};
  for (int i = 0; i < 1000; ++i) normals.push_back(test::cosine_about(Vec3::UnitX(), numbers));
  for (const Vec3& n : normals) {
    const Frame frame = frame_around(n);
    EXPECT_NEAR(frame.s.norm(), 1, 1e-14);
    EXPECT_NEAR(frame.t.norm(), 1, 1e-14);
    EXPECT_LT((frame.s.cross(frame.t) - n).norm(), 1e-14);
  }
}

// With pdf cos / pi, cos² and the azimuth are uniform and independent.
TEST(Warps, directions_are_cosine_distributed) {
  constexpr int n = 1'000'000, side = 16;
  std::vector<int> cells(side * side);
  for (int i = 0; i < n; ++i) {
    core::RandomNumbers numbers(2, 0, static_cast<std::uint64_t>(i));
    const double u = numbers.next(), v = numbers.next();
    const Vec3 d = cosine_hemisphere(u, v);
    const double azimuth = std::atan2(d.y(), d.x()) / (2 * pi) + 0.5;
    const int a = std::min(side - 1, static_cast<int>(d.z() * d.z() * side)),
              b = std::min(side - 1, static_cast<int>(azimuth * side));
    ++cells[static_cast<std::size_t>(a) * side + static_cast<std::size_t>(b)];
  }
  EXPECT_LT(chi2(cells, double(n) / (side * side)), chi2_limit(side * side - 1));
}

TEST(Warps, directions_have_length_one_and_never_lie_in_the_plane) {
  for (double u : {0.0, 0.25, almost_one})
    for (double v : {0.0, 0.5, almost_one}) {
      const Vec3 d = cosine_hemisphere(u, v);
      EXPECT_NEAR(d.norm(), 1, 1e-15);
      EXPECT_GT(d.z(), 0);
      EXPECT_DOUBLE_EQ(cosine_hemisphere_pdf_solid_angle(d.z()), d.z() / pi);
    }
}

// The area fraction that a line parallel to a side cuts off a triangle is the square of its distance from the corner,
// so both s² (s: distance from corner a) and the place along the cut are uniform.
TEST(Warps, points_of_a_triangle_are_uniform_by_area) {
  constexpr int n = 400'000, side = 10;
  const Vec3 a(1, 2, 3), b(4, 2, 1), c(-1, 5, 2);
  std::vector<int> cells(side * side);
  for (int i = 0; i < n; ++i) {
    core::RandomNumbers numbers(3, 0, static_cast<std::uint64_t>(i));
    const double u = numbers.next(), v = numbers.next();
    const Vec3 p = triangle_point(a, b, c, u, v);
    const Vec3 normal = (b - a).cross(c - a);
    const double in_b = (p - a).cross(c - a).dot(normal) / normal.squaredNorm(),
                 in_c = (b - a).cross(p - a).dot(normal) / normal.squaredNorm();
    const double s = in_b + in_c;
    ASSERT_TRUE(in_b >= -1e-14 && in_c >= -1e-14 && s <= 1 + 1e-14);
    const int row = std::min(side - 1, static_cast<int>(s * s * side)),
              column = std::clamp(static_cast<int>(in_c / s * side), 0, side - 1);
    ++cells[static_cast<std::size_t>(row) * side + static_cast<std::size_t>(column)];
  }
  EXPECT_LT(chi2(cells, double(n) / (side * side)), chi2_limit(side * side - 1));
}

// A trapezium between y = 0 (length 3) and y = 1 (length 1): mean height 5/12, and each half of it gets its share of
// points.
TEST(Warps, points_of_a_quad_are_uniform_by_area) {
  const std::array<Vec3, 4> ring{Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
  const auto patch = scene::make_patch({}, scene::Side::front, ring);
  constexpr int n = 400'000, side = 8;
  std::vector<int> cells(side * side);
  for (int i = 0; i < n; ++i) {
    core::RandomNumbers numbers(4, 0, static_cast<std::uint64_t>(i));
    const double u = numbers.next(), v = numbers.next();
    const Vec3 p = patch_point(patch, u, v);
    const double width = 3 - 2 * p.y(), below = (3 * p.y() - p.y() * p.y()) / 2;  // area fraction below y
    ASSERT_TRUE(p.y() >= 0 && p.y() <= 1 && p.x() >= 0 && p.x() <= width + 1e-14);
    const int row = std::min(side - 1, static_cast<int>(below * side)),
              column = std::min(side - 1, static_cast<int>(p.x() / width * side));
    ++cells[static_cast<std::size_t>(row) * side + static_cast<std::size_t>(column)];
  }
  EXPECT_LT(chi2(cells, double(n) / (side * side)), chi2_limit(side * side - 1));
  for (double u : {0.0, almost_one})
    for (double v : {0.0, almost_one}) EXPECT_TRUE(patch_point(patch, u, v).allFinite());
}

/// pdf_area |dp/du x dp/dv| by central differences, which is 1 of a pdf that is right.
template <class Warp>
double density_times_stretch(const Warp& warp, double u, double v, double pdf_area) {
  constexpr double h = 1e-5;
  const Vec3 by_u = warp(u + h, v) - warp(u - h, v), by_v = warp(u, v + h) - warp(u, v - h);
  return pdf_area * by_u.cross(by_v).norm() / (4 * h * h);
}

// Corners whose coordinates are as large as their distances from each other.
TEST(Warps, of_patches_go_there_and_back_with_the_density_that_is_said) {
  const std::array<Vec3, 4> trapezium{Vec3(1, 2, 3), Vec3(4, 2, 3), Vec3(2, 3, 3.5), Vec3(1, 3, 3.5)};
  const std::array<Vec3, 3> triangle{Vec3(1, 2, 3), Vec3(4, 2, 1), Vec3(-1, 5, 2)};
  for (const double scale : {1e-6, 1., 1e6})
    for (const std::span<const Vec3> corners : {std::span<const Vec3>(trapezium), std::span<const Vec3>(triangle)}) {
      std::vector<Vec3> ring;
      for (const Vec3& corner : corners) ring.emplace_back(scale * corner);
      const auto patch = scene::make_patch({}, scene::Side::front, ring);
      const double part = first_triangle_share(patch);
      for (std::uint64_t k = 0; k < 20'000; ++k) {
        core::RandomNumbers numbers(6, 0, k);
        const double u = numbers.next(), v = numbers.next();
        const Vec2 back = patch_point_inverse(patch, patch_point(patch, u, v));
        ASSERT_NEAR(back.x(), u, 1e-12) << corners.size() << " corners, scale " << scale;
        ASSERT_NEAR(back.y(), v, 1e-12) << corners.size() << " corners, scale " << scale;
        if (k % 64 != 0 || std::min(u, std::abs(u - part)) < 1e-2) continue;  // sqrt(u) bends too much at a
        const auto warp = [&](double a, double b) { return patch_point(patch, a, b); };
        EXPECT_NEAR(density_times_stretch(warp, u, v, patch_point_pdf_area(patch)), 1, 1e-5);
      }
    }
}

TEST(AliasTable, picks_in_proportion_to_the_weights) {
  const std::vector<double> weights{1, 1e-3, 5, 0.5, 3, 0.5, 1e6 * 1e-6, 2};
  const AliasTable table(weights);
  double sum = 0;
  for (double w : weights) sum += w;
  EXPECT_NEAR(table.total(), sum, 1e-15 * sum);
  constexpr int n = 1'000'000;
  std::vector<int> counts(weights.size());
  for (int i = 0; i < n; ++i) ++counts[table.pick(core::RandomNumbers(5, 0, static_cast<std::uint64_t>(i)).next())];
  test::Family family(2 * weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double p = weights[i] / sum;  // binomial
    EXPECT_NEAR(counts[i], n * p, family.z() * std::sqrt(n * p * (1 - p))) << i;
  }
  EXPECT_LT(table.pick(almost_one), weights.size());
}

}  // namespace
}  // namespace interflect::montecarlo
