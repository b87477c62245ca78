#include <gtest/gtest.h>

#include "core/error.h"
#include "tests/mesh/scenes.h"

using namespace interflect;
using namespace interflect::mesh;

TEST(Forecast, predicts_the_elements_of_rooms_within_20_percent) {
  for (const double scale : {1.0, 1e-6, 1e6}) {
    const scene::Scene scene = mixed_scene(scale);
    for (const double edge : {3.0, 1.0, 0.5, 0.25, 0.12, 0.06}) {
      const auto made = static_cast<double>(uniform(scene, edge * scale).size());
      EXPECT_NEAR(predicted_elements(scene, edge * scale) / made, 1, 0.2) << edge << " x " << scale;
    }
  }
}

TEST(Forecast, predicts_the_triangles_of_polygons_within_20_percent) {
  scene::SceneBuilder builder({"grey"});
  const auto m = builder.add_material(material());
  builder.add_polygon("L", l_with_hole(1), m);
  builder.add_polygon("hexagon", {ring_at(1, {{1, 0, 0}, {2, 0, 0}, {3, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 1, 0}}), {}},
                      m);
  const scene::Scene scene = builder.finish();
  for (const double edge : {1.0, 0.5, 0.2, 0.1, 0.05}) {
    const auto made = static_cast<double>(uniform(scene, edge).size());
    EXPECT_NEAR(predicted_elements(scene, edge) / made, 1, 0.2) << edge << ": " << made;
  }
}

TEST(Forecast, finds_the_edge_for_a_number_of_elements) {
  for (const double scale : {1.0, 1e-6, 1e6}) {
    const scene::Scene scene = mixed_scene(scale);
    for (const double elements : {500.0, 2500.0, 20000.0}) {
      const double edge = edge_for(scene, elements);
      EXPECT_NEAR(static_cast<double>(uniform(scene, edge).size()) / elements, 1, 0.2) << elements << " x " << scale;
      const double unit = std::pow(10.0, std::floor(std::log10(edge)) - 1);
      EXPECT_NEAR(edge / unit, std::round(edge / unit), 1e-6) << "two digits";
    }
  }
}

TEST(Forecast, of_fewer_elements_than_surfaces_is_an_edge_as_long_as_the_scene) {
  const scene::Scene scene = mixed_scene();
  EXPECT_GE(edge_for(scene, 1), 5.0);
  EXPECT_THROW(edge_for(scene, 0), core::PreconditionError);
}
