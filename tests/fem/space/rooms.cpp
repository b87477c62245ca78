#include <gtest/gtest.h>

#include "fem/assembly.h"
#include "fem/operator/dense_symmetric.h"
#include "fem/space/polynomials.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

using test::Room;

/// K of polynomials on a scene's elements.
std::unique_ptr<DenseSymmetric> assembled(const scene::Scene& scene, std::span<const scene::SurfacePatch> patches,
                                          int order, double tolerance, Run& run) {
  const auto caster = raycast::make_ray_caster("brute", scene);
  FormFactorContext context{scene, patches, *caster, 1, tolerance};
  context.order = order;
  const auto method = make_form_factor_method("analytic", context);
  std::vector<double> gram;
  for (const scene::SurfacePatch& patch : patches)
    gram.insert(gram.end(), static_cast<std::size_t>(plane_functions(order)), patch.area);
  auto K = std::make_unique<DenseSymmetric>(std::move(gram));
  assemble(*method, patches, *K, run);
  return K;
}

// Constants come back as constants, past what hides parts: sum_(j,0) K_(i,a),(j,0) = A_i for a = 0, and 0 for others.
TEST(RoomMoments, of_a_closed_room_with_bodies_send_constants_back) {
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const int order : {1, 2}) {
      if (scale != 1 && order == 2) continue;
      Room room;
      room.box(Vec3(0, 0, 0), Vec3(5, 4, 3) * scale, 2);
      room.box(Vec3(1, 1, .2) * scale, Vec3(1, 1.5, 1.2) * scale, 1, false);
      room.box(Vec3(3, 2, .5) * scale, Vec3(1, .8, 1.1) * scale, 1, false);
      const scene::Scene scene = room.finish();
      core::LocalRun run(1, 2);
      const double tolerance = order == 1 ? 1e-4 : 1e-3;
      const auto K = assembled(scene, room.patches, order, tolerance, run);
      const Index functions = plane_functions(order);
      for (Index i = 0; i < std::ssize(room.patches); ++i)
        for (Index a = 0; a < functions; ++a) {
          double sum = 0;
          for (Index j = 0; j < std::ssize(room.patches); ++j) sum += K->entry(i * functions + a, j * functions);
          EXPECT_NEAR(sum / room.patches[std::size_t(i)].area, a == 0 ? 1 : 0, tolerance)
              << order << ' ' << i << ' ' << a;
        }
    }
}

}  // namespace
}  // namespace interflect::fem
