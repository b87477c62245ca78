#include "results/tables.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "core/error.h"
#include "results/csv.h"
#include "tests/support/temporary_folder.h"
#include "tiny_mesh.h"

using namespace interflect;
using namespace interflect::results;

namespace {

/// RFC 4180, as another program would read it.
std::vector<std::vector<std::string>> parsed(const std::string& text) {
  std::vector<std::vector<std::string>> lines(1, {""});
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"')
      lines.back().back() += text[++i];
    else if (c == '"')
      quoted = !quoted;
    else if (!quoted && c == ',')
      lines.back().emplace_back();
    else if (!quoted && c == '\n')
      lines.push_back({""});
    else
      lines.back().back() += c;
  }
  lines.pop_back();
  return lines;
}

Spectrum rgb(double r, double g, double b) {
  Spectrum s;
  s[0] = r, s[1] = g, s[2] = b;
  return s;
}

/// A scene of so many channels, which weigh alike.
scene::Scene of_channels(std::vector<std::string> names) {
  scene::Scene scene;
  scene.channels = std::move(names);
  for (int c = 0; c < scene.channel_count(); ++c) scene.weights[c] = 1.0 / scene.channel_count();
  return scene;
}
scene::Scene grey() { return of_channels({"y"}); }

}  // namespace

TEST(Tables, names_of_every_kind_survive_csv) {
  const std::string names[] = {"plain", "a,b", "say \"hi\"", "two\nlines", "\"", "", "ümlaut", " spaces "};
  std::vector<SurfaceRow> rows;
  for (const std::string& name : names) rows.push_back({name, 1, Spectrum(1), Spectrum(2), Spectrum(3), Spectrum(4)});
  const auto lines = parsed(surfaces_csv(rows, grey()));
  ASSERT_EQ(lines.size(), rows.size() + 1);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(lines[i + 1].size(), 10u);
    EXPECT_EQ(lines[i + 1][0], names[i]);
  }
}

TEST(Tables, numbers_keep_twelve_digits_and_infinity_is_inf) {
  const double inf = std::numeric_limits<double>::infinity();
  const auto lines =
      parsed(surfaces_csv(std::vector<SurfaceRow>{{"a", 1.0 / 3, rgb(1e-7 / 3, 2e9 / 3, -0.0),
                                                   rgb(inf, -inf, std::nan("")), rgb(1, 2, 3), rgb(4, 5, 9)}},
                          of_channels({"r", "g", "b"})));
  EXPECT_NEAR(std::stod(lines[1][1]) * 3, 1, 1e-11);
  EXPECT_NEAR(std::stod(lines[1][2]) * 3e7, 1, 1e-11);
  EXPECT_NEAR(std::stod(lines[1][3]) * 1.5e-9, 1, 1e-11);
  EXPECT_EQ(lines[1][5], "inf");
  EXPECT_EQ(lines[1][6], "-inf");
  EXPECT_EQ(lines[1][7].substr(0, 3), "nan");
  EXPECT_EQ(lines[1].back(), "6") << "the channels' errors, weighed";
}

TEST(Tables, the_headings_are_the_agreed_ones) {
  EXPECT_EQ(surfaces_csv({}, of_channels({"a", "b"})),
            "name,area,radiosity_0,radiosity_1,irradiance_0,irradiance_1,error_0,error_1,"
            "irradiance_error_0,irradiance_error_1,radiosity,irradiance,error,irradiance_error\n");
  EXPECT_EQ(sensors_csv({}, {}, grey()), "sensor,index,x,y,z,nx,ny,nz,value_0,error_0,value,error\n");
}

TEST(Tables, bounds_have_columns_of_their_own) {
  const std::vector<measure::SensorPoint> points{{"desk", 0, {{1, 2, 3}, Vec3::UnitZ(), {}}}};
  const std::vector<Estimate> values{{Spectrum(5.0), Spectrum(), Spectrum(1.0), Claim::estimated, 0}};
  const std::vector<Interval> bounds{{Spectrum(3.0), Spectrum(7.0)}};
  EXPECT_EQ(sensors_csv(points, values, grey(), bounds),
            "sensor,index,x,y,z,nx,ny,nz,value_0,error_0,lower_0,upper_0,value,error,lower,upper\n"
            "desk,0,1,2,3,0,0,1,5,1,3,7,5,1,3,7\n");
  EXPECT_THROW(sensors_csv(points, values, grey(), std::vector<Interval>(2)), core::PreconditionError);
}

TEST(Tables, a_line_a_side_has_area_means) {
  scene::Scene scene;
  scene.channels = {"r", "g", "b"};
  scene.surfaces = {{"floor", {}, 0, 0, {}}, {"leaf", {}, 0, 0, {}}};
  const mesh::ElementMesh mesh = tiny::mesh();
  const std::vector<Spectrum> b{rgb(1, 2, 3), rgb(3, 4, 5), rgb(7, 7, 7)}, h{rgb(1, 1, 1), rgb(2, 2, 2), rgb(3, 3, 3)};
  const auto rows = surface_means(scene, mesh, {b, h, h, b});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].name, "floor");
  EXPECT_EQ(rows[1].name, "leaf/back");
  EXPECT_DOUBLE_EQ(rows[0].area, 2);
  EXPECT_DOUBLE_EQ(rows[1].area, 0.5);
  EXPECT_DOUBLE_EQ(rows[0].radiosity[2], 4);
  EXPECT_DOUBLE_EQ(rows[0].irradiance[0], 1.5);
  EXPECT_DOUBLE_EQ(rows[1].radiosity_error[1], 3);
  EXPECT_DOUBLE_EQ(rows[0].irradiance_error[1], 3);
  EXPECT_THROW(surface_means(scene, mesh, {b, h, h, {}}), core::PreconditionError);
}

TEST(Tables, an_estimate_of_irradiance_gives_the_same_columns) {
  scene::Scene scene;
  scene.materials = {{"lamp", rgb(0.5, 0.25, 0), rgb(10, 20, 30), scene::Sides::front}};
  scene.surfaces = {{"panel", scene::MaterialId{0}, 0, 0, {}}};
  Estimate H = unbiased_estimate(rgb(100, 100, 100), rgb(1, 1, 1), 9);
  const SurfaceRow row = surface_row(scene, scene::SurfaceId{0}, scene::Side::front, H);
  EXPECT_DOUBLE_EQ(row.radiosity[0], 60);
  EXPECT_DOUBLE_EQ(row.radiosity[2], 30);
  EXPECT_NEAR(row.radiosity_error[0], 0.98, 1e-3);
  EXPECT_EQ(row.radiosity_error[2], 0) << "nothing is reflected: the radiosity is known";
  EXPECT_NEAR(row.irradiance_error[2], 1.96, 1e-3) << "but what arrives is not";
  H.error_bound = Spectrum(std::numeric_limits<double>::infinity());
  const SurfaceRow unknown = surface_row(scene, scene::SurfaceId{0}, scene::Side::front, H);
  EXPECT_TRUE(std::isinf(unknown.radiosity_error[0]));
  EXPECT_TRUE(std::isinf(unknown.irradiance_error[2]));
  EXPECT_EQ(unknown.radiosity_error[2], 0);
}

// E + rho H is all that leaves a diffuse surface, and none else: a mirror throws on more than the nothing that its rho
// would make of it.
TEST(Tables, what_leaves_a_mirror_or_glass_is_not_said_to_be_known) {
  for (const scene::Finish& finish :
       {scene::Finish(scene::Mirror{Spectrum(.9)}), scene::Finish(scene::Glass{}), scene::Finish(scene::Plastic{})}) {
    scene::Scene scene = grey();
    scene::Material material{"shiny", Spectrum(), Spectrum(), scene::Sides::both};
    material.finish = finish;
    scene.materials = {material};
    scene.surfaces = {{"panel", scene::MaterialId{0}, 0, 0, {}}};
    const Estimate H = unbiased_estimate(Spectrum(100), Spectrum(1), 9);
    const std::vector<SurfaceRow> rows{surface_row(scene, scene::SurfaceId{0}, scene::Side::back, H)};
    const auto lines = parsed(surfaces_csv(rows, scene));
    EXPECT_EQ(lines[1], (std::vector<std::string>{"panel/back", "0", "nan", "100", "inf", "1.95996398454", "nan", "100",
                                                  "inf", "1.95996398454"}));
  }
}

TEST(Tables, sensors_are_written_with_place_direction_and_error) {
  const test::TemporaryFolder scratch;
  const std::vector<measure::SensorPoint> points{{"desk", 0, {Vec3(1, 2, 0.75), Vec3(0, 0, 1), {}}},
                                                 {"desk", 1, {Vec3(1.5, 2, 0.75), Vec3(0, 0, 1), {}}}};
  const std::vector<Estimate> values{{Spectrum(400), Spectrum(1), Spectrum(2), Claim::estimated, 5}, Estimate{}};
  write_sensors_csv(scratch / "sensors.csv", points, values, grey());
  const auto lines = parsed(test::read_file(scratch / "sensors.csv"));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[1], (std::vector<std::string>{"desk", "0", "1", "2", "0.75", "0", "0", "1", "400", "3.95996398454",
                                                "400", "3.95996398454"}));
  EXPECT_EQ(lines[2].back(), "inf");
}
