#include <gtest/gtest.h>

#include <cmath>

#include "fem/radiosity.h"
#include "fem/row_errors.h"
#include "scene/reader.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

// Desks on legs, a shelf, a door ajar: 3 020 elements, many blockers a pair.  About three minutes on two cores.
TEST(OfficeRows, sum_to_one_within_what_each_states) {
  const scene::Scene scene = scene::read_scene(INTERFLECT_SOURCE_DIR "/data/scenes/office.json");
  RadiositySettings settings;
  settings.element_size = 1;
  const mesh::ElementMesh mesh = elements_of(scene, settings);
  const auto caster = raycast::make_ray_caster("embree", scene);
  test::LastEntrySink sink(static_cast<std::size_t>(mesh.size()));
  core::LocalRun run(1, 2);
  const auto make = [&](double relative) {
    return make_form_factor_method("analytic", {scene, mesh.patches(), *caster, 1, relative, 16});
  };
  const ToleranceReport report = assemble_to_tolerance(make, 1e-4, mesh.patches(), sink, run);
  EXPECT_TRUE(report.met);
  for (Index i = 0; i < mesh.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    EXPECT_LE(report.row_errors[at], 1e-4);
    const double sum = sink.K.row(i).sum() / mesh.patches()[at].area;
    EXPECT_NEAR(sum, 1, report.row_errors[at]) << i;
    EXPECT_NEAR(sum, 1, 2e-5) << i;  // 9e-6 measured
  }
}

}  // namespace
}  // namespace interflect::fem
