#include "fem/form_factor/duffy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "fem/assembly.h"
#include "fem/galerkin.h"
#include "tests/fem/random_pairs.h"
#include "tests/fem/rooms.h"

// The same integrals by two ways that share no formula.
namespace interflect::fem {
namespace {

using test::Nearness;
using test::Room;

/// Unequal walls, a body and a lamp, scaled; all of its elements touch some.
struct Furnished {
  explicit Furnished(double scale = 1) {
    Room room;
    room.box({0, 0, 0}, scale * Vec3(2, 3, 1.2), 1, true, .6);
    room.wall(scale * Vec3(.5, .5, 1.1), {0, .5 * scale, 0}, {.5 * scale, 0, 0}, 1, 0, 5);
    room.box(scale * Vec3(.7, .6, 0), scale * Vec3(.5, .8, .4), 1, false, .3);
    room.triangle(scale * Vec3(1.5, 2, .2), scale * Vec3(1.9, 2.2, .3), scale * Vec3(1.6, 2.6, .25));
    patches = room.patches;
    scene.emplace(room.finish());
    rays = raycast::make_ray_caster("embree", *scene);
  }
  Eigen::MatrixXd assembled(const std::string& method, int order, double tolerance, int visibility_rays,
                            Eigen::MatrixXd* error = nullptr, std::span<const int> degrees = {}) const {
    FormFactorContext context{*scene, patches, *rays, 1, tolerance, visibility_rays};
    context.order = order;
    context.degrees = degrees;
    test::MatrixSink sink(patches.size() * std::size_t(plane_functions(order)));
    core::LocalRun run(1, 2);
    assemble(*make_form_factor_method(method, context), patches, sink, run.get());
    if (error) *error = sink.error;
    return sink.K;
  }
  std::vector<scene::SurfacePatch> patches;
  std::optional<scene::Scene> scene;
  std::unique_ptr<raycast::RayCaster> rays;
};

// Entry by entry, of every order, with whatever two elements share, near and far: the difference is within what both
// state.
TEST(Duffy, and_closed_forms_agree_within_what_they_state) {
  test::RandomPairs random(12);
  Room none;
  none.wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1);
  const scene::Scene scene = none.finish();
  const auto rays = raycast::make_ray_caster("embree", scene);
  int entries = 0, beyond = 0;
  for (const Nearness nearness : {Nearness::common_corner, Nearness::common_edge, Nearness::near, Nearness::far})
    for (int k = 0; k < 8; ++k) {
      const test::RingPair pair = random.pair(nearness);
      std::vector<scene::SurfacePatch> patches;
      for (const geometry::Ring& ring : {pair.a, pair.b})
        patches.push_back(scene::make_patch(scene::SurfaceId{0}, scene::Side::front, ring));
      for (const int order : {0, 1, 2, 3}) {
        const double tolerance = 1e-4;
        FormFactorContext context{scene, patches, *rays, 1, tolerance};
        context.order = order;
        const PairIntegrator constants(patches, tolerance);
        const PairIntegral K = constants(0, 1);
        const PairMoments by_duffy = Duffy(context).block(0, 1, K),
                          closed = MomentIntegrator(constants.shapes(), order, tolerance)(0, 1, K);
        ASSERT_EQ(by_duffy.value.rows(), closed.value.rows());
        EXPECT_NEAR(by_duffy.value(0, 0), K.value, by_duffy.error + K.error + 1e-14);
        for (Index a = 0; a < closed.value.rows(); ++a)
          for (Index b = 0; b < closed.value.cols(); ++b, ++entries)
            beyond += std::abs(by_duffy.value(a, b) - closed.value(a, b)) > by_duffy.error + closed.error + 1e-14;
      }
    }
  EXPECT_LE(beyond, entries / 100) << "stated errors are estimates";
}

// Of a whole scene, occluders included: by as many rays as it takes, against exact occlusion.
TEST(Duffy, of_a_furnished_room_is_what_analytic_is_but_for_noise) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const Furnished room(scale);
    for (const int order : scale == 1 ? std::vector{0, 1} : std::vector{0}) {
      Eigen::MatrixXd error;
      const Eigen::MatrixXd exact = room.assembled("analytic", order, 1e-5, 16),
                            K = room.assembled("duffy", order, 1e-3, 1024, &error);
      const double area = 1 * scale * scale;
      // Normal deviates of some thousand entries, alpha 1e-4 together.
      EXPECT_LE(((K - exact).cwiseAbs() - 5.5 * error).maxCoeff(), 1e-5 * area) << scale << ' ' << order;
      EXPECT_LT((K - exact).norm(), .02 * exact.norm());
    }
  }
}

TEST(Duffy, has_the_functions_that_degrees_want) {
  const Furnished room;
  std::vector<int> degrees(room.patches.size(), 1);
  degrees[1] = 2;
  const Eigen::MatrixXd K = room.assembled("duffy", 2, 1e-3, 16, nullptr, degrees),
                        all = room.assembled("duffy", 2, 1e-3, 16);
  const Index f = plane_functions(2), linear = plane_functions(1);
  EXPECT_EQ(K.block(0, f, f, f), all.block(0, f, f, f));
  EXPECT_EQ(K.block(0, 2 * f, linear, linear), all.block(0, 2 * f, linear, linear));
  EXPECT_TRUE(K.block(linear, 2 * f, f - linear, f).isZero(0));
}

// Kernel, rule, space and assembler, each by itself: all blocks of a convex room add up, function by function, to
// int N_a, which is A for the first and 0 for the others.
TEST(Galerkin, of_the_plain_kernel_in_a_closed_room_adds_up) {
  Room box;
  box.box({0, 0, 0}, {5, 4, 3}, 2);
  constexpr int order = 1;
  const Space space = space_on(box.patches, order);
  const Index f = plane_functions(order);
  std::vector<double> largest;
  for (const int points : {4, 8}) {
    test::MatrixSink sink(std::size_t(space.layout().unknowns()));
    core::LocalRun run(1, 2);
    galerkin(space, SpaceKernel(), PolygonPairRule(points), sink, run.get());
    largest.push_back(0);
    for (Index i = 0; i < std::ssize(box.patches); ++i)
      for (Index a = 0; a < f; ++a) {
        double sum = 0;
        for (Index j = 0; j < std::ssize(box.patches); ++j) sum += sink.K(i * f + a, j * f);
        largest.back() = std::max(largest.back(), std::abs(sum / box.patches[std::size_t(i)].area - (a == 0)));
      }
  }
  EXPECT_LT(largest[0], 1e-2);
  EXPECT_LT(largest[1], .05 * largest[0]);
}

}  // namespace
}  // namespace interflect::fem
