#include "scene/reader.h"
#include "tests/support/temporary_folder.h"
#include "tests/truths/both_methods.h"

// Shipped scenes by rays in double precision.  (Cubes and plates by both casters: cubes_and_plates.cpp.)
namespace interflect::test {
namespace {

TEST(ByBruteForce, furnace_is_one_by_both_methods) {
  expect_both_true(scene::read_scene(shipped_scene("furnace")), {{"furnace", {1}}},
                   {.element_size = .3, .tolerance = 1e-4, .samples = 20'000, .intersector = "brute"});
}

// B = E / (1 - rho) = 2 = H whatever facets stand for the sphere.
TEST(ByBruteForce, sphere_is_uniform_by_both_methods) {
  expect_both_true(
      scene::read_scene(shipped_scene("sphere")), {{"", {2}}},
      {.element_size = .7, .tolerance = 1e-3, .visibility_rays = 4, .samples = 20'000, .intersector = "brute"});
}

}  // namespace
}  // namespace interflect::test
