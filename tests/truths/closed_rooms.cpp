#include "tests/support/shapes.h"
#include "tests/support/temporary_folder.h"
#include "tests/truths/both_methods.h"
#include "tests/truths/scene_text.h"

// What closed scenes must give, whatever the method.  docs/truths.md 2.0, 2.1, 2.2, 2.6, 2.11, or derived beside the
// test.
namespace interflect::test {
namespace {

const std::vector<double> reflectances{0.2, 0.5, 0.8, 0.95};

/// An L-shaped room of 2 m height with a block in the air whose faces have 1/160 of the floor's area.
void l_shaped_room(SceneText& text, const std::string& walls, const std::string& block) {
  text.prism_room("room", walls, std::vector<Vec3>{{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {2, 2, 0}, {2, 3, 0}, {0, 3, 0}},
                  2);
  text.block("block", block, {1, 1, 0.5}, {1.25, 1.25, 0.75});
}

std::vector<Placement> placements() {
  return {{},
          {.scale = 1e-6},
          {.scale = 1e6},
          {.shift = Vec3(1e9, -1e9, 1e9)},
          {.rotation = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix(), .shift = Vec3(3, 4, 5)}};
}

// docs/truths.md 2.0: E = 1 - rho everywhere gives B = H = 1 everywhere: 1e-10 for finite elements once closure is
// restored.
TEST(Furnace, is_one_for_both_methods_at_every_reflectance_scale_and_place) {
  for (const Placement& placement : placements()) {
    SceneText text({"a", "b", "c", "d"}, placement);
    std::vector<double> exitances;
    for (double rho : reflectances) exitances.push_back(1 - rho);
    text.material("glowing", reflectances, exitances);
    l_shaped_room(text, "glowing", "glowing");
    const scene::Scene scene = text.read();
    const Effort effort{
        .element_size = 0.6 * placement.scale, .tolerance = 1e-3, .visibility_rays = 16, .samples = 8192};
    const Solved closed(scene, effort, true);
    EXPECT_LT(closed.solution.closure_correction, 0.02);
    for (const Spectrum& B : closed.solution.radiosity)
      for (int c = 0; c < 4; ++c) ASSERT_NEAR(B[c], 1, 1e-10);
    const std::vector<double> one(4, 1.0);
    const std::vector<Truth> truths{{"room", one}, {"block", one}, {"block/z-", one}, {"room/wall", one}};
    expect_true("path tracing", scene, truths, traced_means(scene, truths, effort), 0.02);
  }
}

// Without that repair rows sum to 1 + d_i, and B - 1 = (I - rho F)^-1 rho d: at most rho D / (1 - rho (1 + D)) with D =
// max |d|. The mean of d is what all bounces lose together.
TEST(Furnace, without_closure_is_one_as_far_as_rows_sum_to_one) {
  SceneText text({"a", "b", "c", "d"});
  std::vector<double> exitances;
  for (double rho : reflectances) exitances.push_back(1 - rho);
  text.material("glowing", reflectances, exitances);
  l_shaped_room(text, "glowing", "glowing");
  const Solved solved(text.read(), {.element_size = 0.6, .tolerance = 1e-4});
  double d = 0;
  for (double sum : solved.solution.row_sum) d = std::max(d, std::abs(sum - 1));
  EXPECT_LT(d, 0.05);
  EXPECT_NEAR(solved.solution.rows.mean, 1, 1e-3);
  for (const Spectrum& B : solved.solution.radiosity)
    for (int c = 0; c < 4; ++c) {
      const double rho = reflectances[static_cast<std::size_t>(c)];
      ASSERT_LT(rho * (1 + d), 1);
      ASSERT_LE(std::abs(B[c] - 1), rho * d / (1 - rho * (1 + d)) + 1e-10);
    }
}

// What a radiates onto b is what b radiates onto a: A_b H_b (only a emits 1) = A_a H_a (only b emits 1), with all
// reflections, by two channels of one scene.  a is the block, b a panel: areas 0.375 and 3.
TEST(Reciprocity, holds_with_all_reflections_and_unequal_areas) {
  SceneText text({"from block", "from wall"});
  text.material("block", {0.3, 0.3}, {1, 0});
  text.material("wall", {0.6, 0.6}, {0, 0});
  text.material("shining", {0.6, 0.6}, {0, 1});
  text.material("screen", {0.5, 0.5}, {0, 0});
  l_shaped_room(text, "wall", "block");
  text.polygon("shining", "shining", {{3.9, 0, 0.25}, {3.9, 0, 1.75}, {3.9, 2, 1.75}, {3.9, 2, 0.25}});
  text.polygon("its back", "wall", {{3.95, 0, 0.25}, {3.95, 2, 0.25}, {3.95, 2, 1.75}, {3.95, 0, 1.75}});
  text.block("screen", "screen", {2, 0.5, 0.25}, {2.25, 1.5, 1.5});  // between the two
  const scene::Scene scene = text.read();
  std::vector<measure::Measurement> asked;
  double area = 0;
  for (const char* name : {"block", "shining"}) asked.emplace_back(arriving_on(scene, name, area));

  const Solved solved(scene, {.element_size = 0.6});
  const std::vector<Estimate> fem = solved.answer(scene, asked);
  EXPECT_GT(fem[0].value[1], 0.01);
  EXPECT_NEAR(fem[0].value[1] / fem[1].value[0], 1, 1e-10);  // K is symmetric, and R a number for each element

  core::LocalRun run;
  const std::vector<Estimate> mc = montecarlo::PathTracer({.samples = 400'000}).answer(scene, asked, run.get());
  const double noise = std::hypot(mc[0].standard_error[1], mc[1].standard_error[0]);
  EXPECT_NEAR(mc[0].value[1], mc[1].value[0], 3.3 * noise);  // two-sided alpha 1e-3
  EXPECT_LT(noise, 0.02 * mc[0].value[1]);
}

// All that is emitted is absorbed: (1 - rho) sum A H = sum A E, wherever the lamp, of 1/120 of the area of everything.
TEST(Energy, is_absorbed_where_one_reflectance_is_everywhere) {
  for (const Placement& placement : placements()) {
    SceneText text({"grey"}, placement);
    text.material("wall", {0.6}, {0});
    text.material("lamp", {0.6}, {50});
    l_shaped_room(text, "wall", "lamp");
    const scene::Scene scene = text.read();
    double block = 0, all = 0;
    arriving_on(scene, "block", block);
    arriving_on(scene, "", all);
    EXPECT_NEAR(block / all, 0.375 / (20 + 28 + 0.375), 1e-6);  // coordinates of 1e9 keep seven digits of a metre
    expect_both_true(
        scene, {{"", {50 * block / all / 0.4}}},
        {.element_size = 0.5 * placement.scale, .tolerance = 1e-4, .visibility_rays = 16, .samples = 100'000});
  }
}

// docs/truths.md 2.11, V5: a convex body inside a convex one sees nothing else, so H_room = E A_body / A_room, and none
// of it returns.  The body's faces have 1/225 of the room's, and it hangs askew and off the middle.
TEST(ConvexInConvex, sends_all_it_emits_to_what_surrounds_it) {
  const Eigen::Matrix3d askew = Eigen::AngleAxisd(0.6, Vec3(1, -2, 1).normalized()).toRotationMatrix();
  SceneText text({"flight", "furnace"});
  text.material("room", {0, 0.7}, {0, 0.3});
  text.material("body", {0, 0.3}, {9, 0.7});
  text.prism_room("room", "room", std::vector<Vec3>{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}}, 3);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-0.1, 0.1}) {
      const Vec3 u = askew.col((axis + 1) % 3) * 0.1, v = askew.col((axis + 2) % 3) * side,
                 middle = Vec3(0.7, 1.9, 1.2) + askew.col(axis) * side;
      text.polygon("body", "body", {middle - u - v, middle + u - v, middle + u + v, middle - u + v});
    }
  expect_both_true(text.read(), {{"room", {9.0 / 225, 1}}, {"body", {0, 1}}},
                   {.element_size = 0.4, .tolerance = 1e-4, .samples = 100'000});
}

// docs/truths.md 2.2, with the occlusion exact: B_2 = r_2 k / (1 - r_2 (1 - k) - r_1 r_2 k), B_1 = 1 + r_1 B_2 with k =
// A_1 / A_2 = 1/4, exact since the two polyhedra are similar.  320 triangles each, with edges of h = 0.3 of the radius:
// radiosities are uniform but for O(h²), and so are the form factors that weigh them; the means are off by the product
// of the two, O(h⁴) = 0.008.
TEST(ConcentricSpheres, exchange_as_two_uniform_surfaces) {
  const TemporaryFolder folder;
  std::string obj;
  int vertices = 0;
  for (const auto& [name, radius] : {std::pair{"inner", 1.0}, {"outer", 2.0}}) {
    obj += core::format("o %s\nusemtl %s\n", name, name);
    for (const auto& corners : icosphere(2, radius, radius > 1.5)) {
      for (const Vec3& x : corners) obj += core::format("v %.17g %.17g %.17g\n", x.x(), x.y(), x.z());
      obj += core::format("f %d %d %d\n", vertices + 1, vertices + 2, vertices + 3);
      vertices += 3;
    }
  }
  folder.write("spheres.obj", obj);
  SceneText text({".3,.7", ".5,.5"});
  text.material("inner", {0.3, 0.5}, {1, 1});
  text.material("outer", {0.7, 0.5}, {0, 0});
  text.entry(R"({ "file": "spheres.obj", "materials": { "inner": "inner", "outer": "outer" } })");
  const scene::Scene scene = text.read(folder.path());
  ASSERT_EQ(scene.surfaces.size(), 2u);
  const double outer[] = {0.4142011834319526, 2.0 / 9}, inner[] = {1.124260355029586, 10.0 / 9};
  const std::vector<double> on_inner{(inner[0] - 1) / 0.3, (inner[1] - 1) / 0.5},
      on_outer{outer[0] / 0.7, outer[1] / 0.5};
  expect_both_true(scene, {{"inner", on_inner, 0.008 * on_inner[0]}, {"outer", on_outer, 0.008 * on_outer[1]}},
                   {.element_size = 0.7, .tolerance = 1e-3, .visibility_rays = 16, .samples = 100'000});
}

}  // namespace
}  // namespace interflect::test
