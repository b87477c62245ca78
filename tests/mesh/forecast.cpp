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

// Between a window's glass and its wall only few edges fit side by side, and it is their width that sets how many
// triangles refinement makes: a frame of 2 m x 1.5 m whose strips are 2 cm and 5 cm wide, one of 6 m, and a mullion in
// a wall.
TEST(Forecast, predicts_the_triangles_of_frames_within_a_factor_of_1_5) {
  const auto rectangle = [](double x0, double y0, double x1, double y1) {
    return ring_at(1, {{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}});
  };
  const std::vector<geometry::PlanarPolygon> polygons{
      {rectangle(0, 0, 2, 1.5), {rectangle(0.02, 0.05, 1.98, 1.45)}},
      {rectangle(0, 0, 2, 1.5), {rectangle(0.05, 0.02, 1.95, 1.48)}},
      {rectangle(0, 0, 1, 6), {rectangle(0.02, 0.02, 0.98, 5.98)}},
      {ring_at(1, {{0, 0, 0}, {6, 0, 0}, {6, 0.02, 0}, {3, 0.02, 0}, {0, 0.02, 0}}), {}},
      {rectangle(0, 0, 5, 3), {rectangle(1, 1, 2, 2), rectangle(2.03, 1, 3, 2), rectangle(3.03, 1, 4, 2)}}};
  for (const auto& polygon : polygons) {
    scene::SceneBuilder builder({"grey"});
    builder.add_polygon("frame", polygon, builder.add_material(material()));
    const scene::Scene scene = builder.finish();
    for (const double edge : {1.0, 0.5, 0.25, 0.1, 0.05, 0.02}) {
      const auto made = static_cast<double>(uniform(scene, edge).size());
      const double ratio = predicted_elements(scene, edge) / made;
      EXPECT_TRUE(ratio > 1 / 1.5 && ratio < 1.5) << edge << ": " << ratio << " of " << made;
    }
  }
}

TEST(Forecast, counts_beyond_every_integer) {
  scene::SceneBuilder builder({"grey"});
  builder.add_polygon("floor", {ring_at(1, {{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}}), {}},
                      builder.add_material(material(scene::Sides::both)));
  const scene::Scene scene = builder.finish();
  EXPECT_NEAR(predicted_elements(scene, 1e-20), 12e40, 1e30);
  EXPECT_GT(predicted_elements(mixed_scene(), 1e-300), 1e300);
}

TEST(Forecast, finds_the_edge_for_an_area_alone) {
  EXPECT_DOUBLE_EQ(edge_for_area(0.205 * 400, 100), 2.0);
  EXPECT_DOUBLE_EQ(edge_for_area(1, 1000), 0.07);  // 0.0698
  EXPECT_THROW(edge_for_area(0, 10), core::PreconditionError);
  EXPECT_THROW(edge_for_area(1, 0), core::PreconditionError);
}

TEST(Forecast, knows_the_area_of_all_sides_that_exchange_light) {
  scene::SceneBuilder builder({"grey"});
  builder.add_polygon("one", {ring_at(1, {{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}}), {}},
                      builder.add_material(material()));
  builder.add_polygon("two", {ring_at(1, {{0, 0, 1}, {1, 0, 1}, {1, 2, 1}, {0, 2, 1}}), {}},
                      builder.add_material(material(scene::Sides::both)));
  EXPECT_DOUBLE_EQ(meshed_area(builder.finish()), 6 + 2 * 2);
}

TEST(Forecast, finds_the_edge_for_a_number_for_a_number_of_elements) {
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
