#include "measure/sensor_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "measure/surface_measurements.h"
#include "scene/builder.h"

namespace interflect::measure {
namespace {

using scene::SensorGrid;

const double by_en12464 = std::numeric_limits<double>::quiet_NaN();

SensorGrid grid(double width, double depth, const std::variant<double, Eigen::Array2i>& step, double border = 0) {
  return {Vec3(1, 2, 0.8), Vec3(width, 0, 0), Vec3(0, depth, 0), step, border};
}

TEST(SensorGrid, points_are_the_centres_of_equal_cells) {
  const std::vector<Vec3> points = grid_points(grid(6, 4, Eigen::Array2i(3, 2)));
  ASSERT_EQ(points.size(), 6u);
  EXPECT_TRUE(points[0].isApprox(Vec3(2, 3, 0.8)));
  EXPECT_TRUE(points[1].isApprox(Vec3(4, 3, 0.8)));  // along u first
  EXPECT_TRUE(points[5].isApprox(Vec3(6, 5, 0.8)));
}

TEST(SensorGrid, a_border_is_left_out_on_all_sides) {
  const std::vector<Vec3> points = grid_points(grid(6, 4, Eigen::Array2i(1, 1), 0.5));
  ASSERT_EQ(points.size(), 1u);
  EXPECT_TRUE(points[0].isApprox(Vec3(4, 4, 0.8)));
  EXPECT_THROW(grid_points(grid(6, 1, 0.2, 0.5)), core::InputError);
}

// EN 12464-1 by its formula p = 0.2 * 5^(log10 d): d = 1, 10, 100 m give p = 0.2, 1, 5 m.
TEST(SensorGrid, spacing_follows_en_12464) {
  for (const auto& [side, cells] : {std::pair{1.0, 5u}, {10.0, 10u}, {100.0, 20u}})
    EXPECT_EQ(grid_points(grid(side, side, by_en12464)).size(), cells * cells) << side;
  // A corridor: the shorter side decides where the ratio is 2 or more; p(2 m) = 0.2 * 5^0.301 = 0.325 m.
  EXPECT_EQ(grid_points(grid(20, 2, by_en12464)).size(), 62u * 6u);
}

scene::Scene box_with_sensor(const Vec3& point, const Vec3& normal) {
  scene::SceneBuilder builder({"y"});
  scene::Material grey;
  grey.name = "grey";
  grey.reflectance = Spectrum(0.5);
  const auto material = builder.add_material(grey);
  builder.add_box("desk", geometry::Box(Vec3(0, 0, 0), Vec3(2, 1, 0.75)), material);
  builder.scene().sensors.push_back({"point", normal, std::vector<Vec3>{point}});
  return builder.finish();
}

TEST(SensorPoints, a_point_on_a_surface_belongs_to_it) {
  const scene::Scene scene = box_with_sensor(Vec3(1, 0.5, 0.75), Vec3::UnitZ());
  const auto points = sensor_points(scene);
  ASSERT_EQ(points.size(), 1u);
  ASSERT_TRUE(points[0].at.on.has_value());
  EXPECT_EQ(scene.surface(*points[0].at.on).name, "desk/z+");
}

// A file's coordinates are rounded, and on a tilted floor that moves a point off it: below, where every ray would start
// behind the floor, as well as above.
TEST(SensorPoints, a_point_a_little_off_a_tilted_surface_is_moved_onto_it) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Vec3(1, 2, -0.5).normalized()).toRotationMatrix();
  for (const Vec3& shift : {Vec3(0, 0, 0), Vec3(5e5, 5e6, 100)}) {
    const auto at = [&](double x, double y) -> Vec3 { return turn * Vec3(x, y, 0) + shift; };
    const geometry::PlanarPolygon floor{{at(0, 0), at(6, 0), at(6, 4), at(0, 4)}, {}};
    const Vec3 normal = geometry::plane_of(floor.outer).normal, on_floor = at(2.1, 1.3);
    const double ulp = 3e-16 * (shift.norm() + 7), diagonal = std::hypot(6, 4);
    for (const double height : {-1e-10 * diagonal, 0.0, 1e-10 * diagonal}) {
      scene::SceneBuilder builder({"y"});
      builder.add_polygon("floor", floor, builder.add_material({}));
      builder.scene().sensors.push_back({"point", normal, std::vector<Vec3>{on_floor + height * normal}});
      const auto points = sensor_points(builder.finish());
      ASSERT_TRUE(points[0].at.on.has_value());
      EXPECT_LE(std::abs(normal.dot(points[0].at.position - floor.outer[0])), 4 * ulp) << height;
      EXPECT_LE((points[0].at.position - on_floor).norm(), 1e-15 * diagonal + 4 * ulp) << height;
    }
  }
}

TEST(SensorPoints, a_point_above_or_turned_away_belongs_to_none) {
  EXPECT_FALSE(sensor_points(box_with_sensor(Vec3(1, 0.5, 0.7500001), Vec3::UnitZ()))[0].at.on.has_value());
  EXPECT_FALSE(sensor_points(box_with_sensor(Vec3(1, 0.5, 0.75), Vec3::UnitX()))[0].at.on.has_value());
  EXPECT_FALSE(sensor_points(box_with_sensor(Vec3(3, 0.5, 0.75), Vec3::UnitZ()))[0].at.on.has_value());
}

TEST(SurfaceMeasurements, patches_cover_each_side_and_face_out_of_it) {
  const scene::Scene scene = box_with_sensor(Vec3(0, 0, 2), Vec3::UnitZ());
  for (scene::SurfaceId id : scene.surface_ids())
    for (scene::Side side : {scene::Side::front, scene::Side::back}) {
      double area = 0;
      for (const scene::SurfacePatch& patch : patches_of(scene, id, side)) {
        area += patch.area;
        const double sign = side == scene::Side::front ? 1 : -1;
        EXPECT_NEAR(sign * patch.normal().dot(scene.facets_of(id)[0].normal), 1, 1e-14);
      }
      EXPECT_NEAR(area, scene.area(id), 1e-14);
    }
}

}  // namespace
}  // namespace interflect::measure
