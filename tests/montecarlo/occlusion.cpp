#include "tests/montecarlo/known_rooms.h"
#include "tests/montecarlo/statistics.h"
#include "tests/support/shapes.h"

// Bodies in the way.  Truths: docs/truths.md 2.2, 2.9 and 2.11.
namespace interflect::montecarlo {
namespace {

using scene::SceneBuilder;
using test::at_point;
using test::expect_agreement;
using test::whole;

scene::MaterialId material(SceneBuilder& builder, double rho, double E) {
  return builder.add_material(test::diffuse("m", rho, E));
}

// 2.9, and the same points without a body.
TEST(PathTracer, finds_the_penumbra_of_a_square_blocker) {
  test::KnownScene known = test::penumbra_of_a_square();
  for (test::Question question : std::vector(known.questions)) {
    if (auto* point = std::get_if<measure::PointIrradiance>(&question.asked)) {
      point->on.reset();
      known.questions.push_back(question);
    }
  }
  known.questions.push_back(at_point({0, 0, 3}, -Vec3::UnitZ(), 0));  // behind the source: its back is dark
  for (const char* intersector : {"embree", "brute"}) {
    expect_agreement(known.scene, known.questions, {.samples = 20'000, .intersector = intersector}, 0.05);
  }
}

// Each vertex of light tracing is joined to one of twelve points.
TEST(WalksFromLights, find_the_penumbra_of_a_square_blocker) {
  const test::KnownScene known = test::penumbra_of_a_square();
  test::expect_found_by("bidirectional", 20'000, known, 0.05);
  test::expect_found_by("light", 400'000, known, 0.05);
}

// 2.11, V6 and V7: parallel unit squares with a thin square half-way.
TEST(PathTracer, finds_the_form_factor_of_squares_with_an_occluder_between) {
  const geometry::PlanarPolygon quarter{{Vec3(0, 0, 0.5), Vec3(0.5, 0, 0.5), Vec3(0.5, 0.5, 0.5), Vec3(0, 0.5, 0.5)},
                                        {}};
  for (const auto& [occluder, F] :
       {std::pair{quarter, 0.149868671774}, std::pair{test::level_square(0.25, 0.5, true), 0.099506294599}}) {
    SceneBuilder builder({"grey"});
    builder.add_polygon("lower", test::level_square(0.5, 0, true), material(builder, 0, 1));
    builder.add_polygon("upper", test::level_square(0.5, 1, false), material(builder, 0, 0));
    builder.add_polygon("occluder", occluder, material(builder, 0, 0));
    const scene::Scene scene = builder.finish();
    expect_agreement(scene, {whole(scene, "upper", F)}, {.samples = 200'000}, 0.01);
  }
}

// 2.11, V5: cubes of sides 3 and 1.  F(in, out) = 1, F(out, in) = 1/9 and F(out, out) = 8/9 exactly, since a convex
// body in a closed convex room sees all of it.  Exact as long as one of the two radiosities is uniform and the other's
// reflection is not asked for:
//   out emits 1, black:  H(in) = 1 everywhere; with B(in) = rho uniform, mean H(out) = 8/9 + rho / 9;
//   in emits 1, out black:  mean H(out) = 1/9, H(in) = 0.
TEST(PathTracer, finds_the_exchange_of_concentric_cubes) {
  for (const double rho : {0.0, 0.5, 0.9}) {
    SceneBuilder builder({"grey"});
    builder.add_box("out", {Vec3(-1.5, -1.5, -1.5), Vec3(1.5, 1.5, 1.5)}, material(builder, 0, 1),
                    SceneBuilder::Facing::inward);
    builder.add_box("in", {Vec3(-0.5, -0.5, -0.5), Vec3(0.5, 0.5, 0.5)}, material(builder, rho, 0));
    const scene::Scene scene = builder.finish();
    measure::Flux out;
    for (const scene::SurfaceId id : scene.surface_ids())
      if (scene.surface(id).name.starts_with("out"))
        for (const auto& patch : measure::patches_of(scene, id, scene::Side::front)) out.through.push_back(patch);
    expect_agreement(scene,
                     {{out, test::grey(54 * (8 + rho) / 9), "out"}, whole(scene, "in/x-", 1), whole(scene, "in/z+", 1)},
                     {.samples = 50'000}, 0.01);
  }
  SceneBuilder builder({"grey"});
  builder.add_box("out", {Vec3(-1.5, -1.5, -1.5), Vec3(1.5, 1.5, 1.5)}, material(builder, 0, 0),
                  SceneBuilder::Facing::inward);
  builder.add_box("in", {Vec3(-0.5, -0.5, -0.5), Vec3(0.5, 0.5, 0.5)}, material(builder, 0.5, 1));
  const scene::Scene scene = builder.finish();
  expect_agreement(scene, {whole(scene, "out/x+", 1.0 / 9), whole(scene, "in/x-", 0)}, {.samples = 100'000}, 0.01);
}

// 2.2: concentric spheres, the inner emits 1, radii 1 and 2 (k = 1/4), rho 1/2: B1 = 10/9, B2 = 2/9, so H1 = 2/9 and H2
// = 4/9.  The outer sphere sees itself past the inner.  The polyhedra that stand for them are similar, so k is exact,
// and all that leaves the inner meets the outer.  Their radiosities are uniform but for O(h²), and so are the form
// factors that weigh them: in the means the product of both is off, O(h⁴).  Level 3 has edges of h = 0.15: h⁴ = 5e-4
// allowed.
TEST(PathTracer, finds_the_irradiance_of_concentric_spheres) {
  SceneBuilder builder({"grey"});
  builder.add_facets("out", test::icosphere(3, 2, true), material(builder, 0.5, 0));
  builder.add_facets("in", test::icosphere(3, 1, false), material(builder, 0.5, 1));
  const scene::Scene scene = builder.finish();
  auto out = whole(scene, "out", 4.0 / 9), in = whole(scene, "in", 2.0 / 9);
  out.slack = 5e-4 * out.truth[0], in.slack = 5e-4 * in.truth[0];
  expect_agreement(scene, {out, in}, {.samples = 400'000}, 0.004);
}

}  // namespace
}  // namespace interflect::montecarlo
