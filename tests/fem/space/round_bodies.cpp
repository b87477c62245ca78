#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/fem/space/assembled_scene.h"

namespace interflect::fem {
namespace {

/// Circumradius of what stands for the unit circle.
double inscribed(int) { return 1; }
double equal_area(int sides) { return std::sqrt(2 * pi / (sides * std::sin(2 * pi / sides))); }

/// Disks and a cylinder about the z axis, of regular polygons, cut into rings of elements.
class RoundBodies {
 public:
  RoundBodies(int sides, double radius) : sides_(sides), radius_(radius) {}

  /// Facing up or down.
  /// @param cuts  of the radius, from 0 to 1
  scene::SurfaceId disk(double z, bool up, const std::vector<double>& cuts) {
    geometry::Ring outline;
    for (int k = 0; k < sides_; ++k) outline.push_back(at(up ? k : -k, 1, z));
    const auto id = builder_.add_polygon("disk", {outline, {}}, material_);
    for (int k = 0; k < sides_; ++k)
      for (std::size_t c = 1; c < cuts.size(); ++c) {
        const int a = up ? k : -k, b = up ? k + 1 : -k - 1;
        if (c == 1) {
          add(id, {Vec3(0, 0, z), at(a, cuts[1], z), at(b, cuts[1], z)});
        } else {
          add(id, {at(a, cuts[c - 1], z), at(a, cuts[c], z), at(b, cuts[c], z), at(b, cuts[c - 1], z)});
        }
      }
    return id;
  }
  /// Facing the axis: a surface a side, the first of which is returned.
  /// @param cuts  heights
  scene::SurfaceId wall(const std::vector<double>& cuts) {
    std::vector<scene::SurfaceId> ids;
    for (int k = 0; k < sides_; ++k) {
      ids.push_back(builder_.add_polygon("wall", {strip(k, cuts.front(), cuts.back()), {}}, material_));
      for (std::size_t c = 1; c < cuts.size(); ++c) add(ids.back(), strip(k, cuts[c - 1], cuts[c]));
    }
    return ids.front();
  }
  Vec3 middle_of_first_side(double z) const { return (at(0, 1, z) + at(1, 1, z)) / 2; }
  double area() const { return sides_ * radius_ * radius_ * std::sin(2 * pi / sides_) / 2; }  ///< of a disk

  scene::Scene finish() { return builder_.finish(); }
  const std::vector<scene::SurfacePatch>& patches() const { return patches_; }

 private:
  Vec3 at(int side, double r, double z) const {
    const double angle = 2 * pi * side / sides_;
    return {r * radius_ * std::cos(angle), r * radius_ * std::sin(angle), z};
  }
  geometry::Ring strip(int k, double low, double high) const {
    return {at(k + 1, 1, low), at(k, 1, low), at(k, 1, high), at(k + 1, 1, high)};
  }
  void add(scene::SurfaceId id, const geometry::Ring& ring) {
    patches_.push_back(scene::make_patch(id, scene::Side::front, ring));
  }

  int sides_;
  double radius_;
  scene::SceneBuilder builder_{{"y"}, scene::Quantity::radiometric};
  scene::MaterialId material_ = builder_.add_material(test::diffuse(0));
  std::vector<scene::SurfacePatch> patches_;
};

/// From a regular polygon to the one above it: by symmetry, from one of its sectors.
double polygons_form_factor(int sides, double radius, double distance) {
  RoundBodies disks(sides, radius);
  disks.disk(0, true, {0, 1});
  disks.disk(distance, false, {0, 1});
  const scene::Scene scene = disks.finish();
  const auto caster = raycast::make_ray_caster("brute", scene);
  const auto& patches = disks.patches();
  const auto method = make_form_factor_method("analytic", {scene, patches, *caster, 1, 1e-13});
  test::MatrixSink sink(patches.size());
  core::LocalRun run(1, 1);
  method->exchange({patches, 0, 1}, {patches, sides, sides}, sink, run.get());
  return sink.K.row(0).sum() / patches[0].area;
}

/// (x - sqrt(x² - 4)) / 2, x = 2 + h²: (3 - sqrt 5) / 2 at the distance 1.
double disks_form_factor(double h) {
  const double x = 2 + h * h;
  return (x - std::sqrt(x * x - 4)) / 2;
}

// What a polygon's outline is off by is of order 2 in the length of a side; its mean is 0, which leaves order 4, where
// the area is the disk's.
TEST(CoaxialDisks, have_their_form_factor_by_polygons_with_order_two_and_of_equal_area_with_order_four) {
  EXPECT_NEAR(disks_form_factor(1), 0.38196601125010515, 1e-16);
  for (const double distance : {.5, 1.0, 2.0}) {
    const double exact = disks_form_factor(distance);
    for (int sides = 24; sides <= 96; sides *= 2) {
      const auto order = [&](double (*radius)(int)) {
        return std::log2(std::abs((polygons_form_factor(sides / 2, radius(sides / 2), distance) - exact) /
                                  (polygons_form_factor(sides, radius(sides), distance) - exact)));
      };
      EXPECT_NEAR(order(inscribed), 2, .05) << distance << ' ' << sides;
      EXPECT_NEAR(order(equal_area), 4, .1) << distance << ' ' << sides;
    }
  }
}

// docs/truths.md 2.11, V3.
TEST(CoaxialDisks, of_equal_area_have_the_known_form_factors_of_polygons) {
  for (const auto& [sides, known] : {std::pair(16, .381941973654), {32, .381964527855}, {64, .381965918831}})
    EXPECT_NEAR(polygons_form_factor(sides, equal_area(sides), 1), known, 1e-12) << sides;
}

/// Unit disks at distance 1, the lower emits 1; at r = 0, 1/2, 1, and the mean.  docs/truths.md 2.4.
struct KnownDisks {
  double rho_low, rho_high;
  std::array<double, 4> low, high;
};
constexpr std::array<KnownDisks, 2> known_disks{
    KnownDisks{.5,
               .5,
               {1.053060289507, 1.045346741551, 1.027370476455, 1.039054697589},
               {.260508358273, .227945598956, .143574095428, .198684128339}},
    KnownDisks{.3,
               .7,
               {1.044282477379, 1.037845801805, 1.022843878381, 1.032594872824},
               {.362278238602, .317050286277, .199758489505, .276374433841}}};

/// |found - known| of the values of either pair of disks, low ones first.
std::array<std::array<double, 8>, 2> disk_errors(int sides, double radius) {
  RoundBodies disks(sides, radius);
  const auto low = disks.disk(0, true, {0, 1}), high = disks.disk(1, false, {0, 1});
  test::AssembledScene scene(disks.finish(), disks.patches(), 3, 1e-10);
  std::array<std::array<double, 8>, 2> errors{};
  for (std::size_t w = 0; w < 2; ++w) {
    const KnownDisks& known = known_disks[w];
    const auto B = scene.solve([&](scene::SurfaceId id) { return id == low ? known.rho_low : known.rho_high; },
                               [&](scene::SurfaceId id) { return id == low ? 1.0 : 0.0; });
    for (std::size_t k = 0; k < 3; ++k) {
      const double r = .5 * double(k);
      errors[w][k] = std::abs(1 + known.rho_low * scene.irradiance(B, {r, 0, 0}, low) - known.low[k]);
      errors[w][4 + k] = std::abs(known.rho_high * scene.irradiance(B, {r, 0, 1}, high) - known.high[k]);
    }
    errors[w][3] = std::abs(scene.mean(B, low) - known.low[3]);
    errors[w][7] = std::abs(scene.mean(B, high) - known.high[3]);
  }
  return errors;
}

// Polynomials of degree 3, one sector a side: what is left is the outline.
TEST(CoaxialDisks, have_their_known_radiosities_with_the_orders_of_their_outlines) {
  const auto coarse = disk_errors(12, inscribed(12)), fine = disk_errors(24, inscribed(24));
  const auto coarse_equal = disk_errors(12, equal_area(12)), fine_equal = disk_errors(24, equal_area(24));
  for (std::size_t w = 0; w < 2; ++w) {
    for (std::size_t k = 0; k < 8; ++k) EXPECT_LT(fine_equal[w][k], 5e-6) << w << ' ' << k;
    for (const std::size_t mean : {3u, 7u}) {
      EXPECT_NEAR(std::log2(coarse[w][mean] / fine[w][mean]), 2, .1) << w << ' ' << mean;
      EXPECT_NEAR(std::log2(coarse_equal[w][mean] / fine_equal[w][mean]), 4, .1) << w << ' ' << mean;
    }
  }
}

/// Isothermal cylinder of radius 1 with a base, open above, E = emissivity = 1 - rho: effective emissivity of the
/// aperture, and radiosities at the middle of the base, half-way up the wall, and at its lip.  docs/truths.md 2.7.
struct KnownCavity {
  double depth, emissivity, effective, base, wall, lip;
};
constexpr std::array<KnownCavity, 9> known_cavities{
    KnownCavity{1, .5, .7423863490, .6877743142, .7635355317, .6856478669},
    KnownCavity{1, .7, .8689291878, .8313545712, .8844528649, .8303772242},
    KnownCavity{1, .9, .9618701681, .9482307012, .9678462040, .9481001577},
    KnownCavity{2, .5, .8082990303, .8394272558, .8485331024, .7014009444},
    KnownCavity{2, .7, .9037875100, .9230615817, .9298875253, .8353328229},
    KnownCavity{2, .9, .9721042481, .9784703898, .9811760243, .9485808276},
    KnownCavity{8, .5, .8365378939, .9880111549, .9811769270, .7070846098},
    KnownCavity{8, .7, .9153917049, .9944547050, .9932748877, .8366559018},
    KnownCavity{8, .9, .9749607107, .9983917580, .9985140981, .9486829942}};

/// n cuts of [0, depth] that come closer towards both ends, as squares.
std::vector<double> cuts_towards_ends(int n, double depth) {
  std::vector<double> cuts;
  for (int k = 0; k <= n; ++k) {
    const double s = 2.0 * std::min(k, n - k) / n;
    cuts.push_back(depth * (2 * k <= n ? s * s / 2 : 1 - s * s / 2));
  }
  return cuts;
}

void expect_cavities(double depth) {
  RoundBodies body(96, inscribed(96));
  const auto base = body.disk(0, true, {0, .4, .7, .9, 1}), wall = body.wall(cuts_towards_ends(32, depth));
  test::AssembledScene scene(body.finish(), body.patches(), 0, 1e-4);
  for (const KnownCavity& known : known_cavities) {
    if (known.depth != depth) continue;
    const double E = known.emissivity, rho = 1 - E;
    const auto B = scene.solve([&](scene::SurfaceId) { return rho; }, [&](scene::SurfaceId) { return E; });
    double leaves = 0;  // sum A (B - H) with H = (B - E) / rho
    for (std::size_t i = 0; i < body.patches().size(); ++i)
      leaves += body.patches()[i].area * E * (1 - B(static_cast<Index>(i), 0)) / rho;
    const auto radiosity = [&](const Vec3& x, scene::SurfaceId on) { return E + rho * scene.irradiance(B, x, on); };
    EXPECT_NEAR(leaves / body.area(), known.effective, 1e-3) << depth << ' ' << E;
    EXPECT_NEAR(radiosity(Vec3::Zero(), base), known.base, 1e-3) << depth << ' ' << E;
    EXPECT_NEAR(radiosity(body.middle_of_first_side(depth / 2), wall), known.wall, 1e-3) << depth << ' ' << E;
    EXPECT_NEAR(radiosity(body.middle_of_first_side(depth), wall), known.lip, 1e-3) << depth << ' ' << E;
  }
}

TEST(Cavities, of_ninety_six_sides_have_their_known_emissivities_to_a_thousandth) {
  for (const double depth : {1.0, 2.0, 8.0}) expect_cavities(depth);
}

}  // namespace
}  // namespace interflect::fem
