#include "core/moments.h"
#include "montecarlo/bsdf/rough_dielectric.h"
#include "montecarlo/two_pass/two_pass_estimator.h"
#include "tests/montecarlo/rooms.h"

// Where the walks of two passes ask the solution, and what that counts, without a solution.
namespace interflect::montecarlo {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

// A ray straight down through one rough face to a floor at twice the distance: on a disk right below, and in a ring
// about it, arrives what the material by itself scatters there, by numbers of its own.
TEST(TwoPassWalks, leave_rough_glass_as_it_scatters) {
  constexpr double alpha = .4, eta = 1.5;
  scene::SceneBuilder builder({"grey"});
  scene::Material glass;
  glass.finish = scene::Glass{eta, alpha};
  glass.sides = scene::Sides::both;
  builder.add_polygon("face", test::parallelogram(-x - y, 2 * x, 2 * y), builder.add_material(glass));
  builder.add_polygon("floor", test::parallelogram(-50 * x - 50 * y - z, 100 * x, 100 * y),
                      builder.add_material(test::diffuse("floor", .5, 0)));
  const scene::Scene scene = builder.finish();
  const auto caster = raycast::make_ray_caster("embree", scene);
  const TwoPassEstimator walks(scene, *caster, 0);
  const RoughDielectric face(alpha, eta);
  std::array<core::ScalarMoments, 2> walked, drawn;
  const auto add = [](std::array<core::ScalarMoments, 2>& to, double distance, double weight) {
    to[0].add(distance < .1 ? weight : 0);
    to[1].add(distance >= .1 && distance < .4 ? weight : 0);
  };
  for (std::uint64_t k = 0; k < 100'000; ++k) {
    core::RandomNumbers numbers(1, 0, k), others(2, 0, k);
    const auto found = walks.radiance({z, -z}, numbers, 0).reflected;
    if (found)
      add(walked, std::hypot(found->at.position.x(), found->at.position.y()), pi * found->weight[0]);
    else
      add(walked, 1, 0);
    const double lobe = others.next(), u = others.next(), v = others.next();
    const auto on = face.sample(z, {lobe, u, v}, Walk::from_eye);
    if (on && on->way.z() < 0)
      add(drawn, std::hypot(on->way.x(), on->way.y()) / -on->way.z(), on->weight[0]);
    else
      add(drawn, 1, 0);
  }
  const double limit = test::critical_z(test::alpha, walked.size());
  for (std::size_t part = 0; part < walked.size(); ++part) {
    const double error = std::hypot(walked[part].standard_error(), drawn[part].standard_error());
    EXPECT_NEAR(walked[part].mean(), drawn[part].mean(), limit * error) << part;
    EXPECT_LT(error, .02 * drawn[part].mean()) << part;
  }
}

}  // namespace
}  // namespace interflect::montecarlo
