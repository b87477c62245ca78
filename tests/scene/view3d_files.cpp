#include <gtest/gtest.h>

#include "geometry_texts.h"

namespace interflect::scene {
namespace {

using test::geometry_of;
using test::groups_of;
using test::names_of;
using test::said_of_geometry;
using Names = std::vector<std::string>;

/// A square of side 4 in z = 0 that looks up, and what else is given.
std::string floor_and(const std::string& vertices, const std::string& surfaces) {
  return "T a test\nC encl=1 eps=1.e-4\n! a comment\nF 3\n"
         "V 1 0. 0. 0.\nV 2 4. 0. 0.  ! the second\nV 3 4. 4. 0.\nV 4 0. 4. 0.\n" +
         vertices + "S 1  1 2 3 4  0 0 0.90 floor\n" + surfaces + "End of data\nanything at all\n";
}

/// A unit square from (x, y) in the floor's plane.
std::string square(int first, const std::string& x, const std::string& y) {
  const auto plus = [](const std::string& s) { return std::to_string(std::stod(s) + 1); };
  const auto v = [&](int k, const std::string& a, const std::string& b) {
    return "V " + std::to_string(first + k) + " " + a + " " + b + " 0\n";
  };
  return v(0, x, y) + v(1, plus(x), y) + v(2, plus(x), plus(y)) + v(3, x, plus(y));
}

TEST(View3dFile, surfaces_keep_their_names_emittances_and_combinations) {
  const ExchangeScene read = geometry_of(
      "room.vs3",
      floor_and("V 5 0 0 3\nV 6 4 0 3\n", "S,2, 2,1,5,6, 0 0 .5 wall\ns 3 2 1 5 0 0 2 1 wall-b\nS 4 1 2 6 0 0 0 0\n"));
  EXPECT_EQ(names_of(read), (Names{"floor", "wall", "wall-b", "surface-4"}));
  EXPECT_EQ(groups_of(read), (Names{"floor", "wall", "wall", "surface-4"}));
  EXPECT_EQ(read.surfaces[0].emittance, 0.9);
  EXPECT_DOUBLE_EQ(read.scene.material(SurfaceId{0}).reflectance[0], 0.1);
  EXPECT_EQ(read.scene.material(SurfaceId{2}).reflectance[0], 0);
  EXPECT_DOUBLE_EQ(read.scene.material(SurfaceId{3}).reflectance[0], 0.999);
  EXPECT_EQ(read.scene.repairs[0].line().substr(read.scene.repairs[0].line().find("room.vs3")),
            "room.vs3: 1 emittance(s) of 0 taken for 0.001");
  EXPECT_EQ(read.scene.facets[0].normal, Vec3::UnitZ());
  EXPECT_DOUBLE_EQ(read.scene.area(SurfaceId{0}), 16);
  EXPECT_DOUBLE_EQ(read.scene.area(SurfaceId{2}), 6);
}

TEST(View3dFile, obstructions_only_occlude) {
  const ExchangeScene read =
      geometry_of("room.vs3", floor_and("V 5 0 0 3\nV 6 4 0 3\n", "O 2 2 1 5 6\nO 3 1 2 6 0 0 0 0.5 plate\n"));
  EXPECT_EQ(names_of(read), (Names{"floor", "surface-2", "plate"}));
  EXPECT_EQ(read.surfaces[0].role, ExchangeRole::radiates);
  EXPECT_EQ(read.surfaces[1].role, ExchangeRole::only_occludes);
  EXPECT_FALSE(read.surfaces[1].emittance);
}

TEST(View3dFile, subsurfaces_are_cut_out_of_their_base_wherever_they_lie) {
  for (const auto& [x, y] : {std::pair("1", "1"), {"0", "0"}, {"3", "1"}, {"0.3", "3"}}) {
    const ExchangeScene read = geometry_of("room.vs3", floor_and(square(5, x, y), "S 2 5 6 7 8 1 0 0.5 hatch\n"));
    EXPECT_EQ(names_of(read), (Names{"floor", "hatch"}));
    EXPECT_NEAR(read.scene.area(SurfaceId{0}), 15, 1e-12) << x << ' ' << y;
    EXPECT_NEAR(read.scene.area(SurfaceId{1}), 1, 1e-12);
    for (const Facet& facet : read.scene.facets) EXPECT_EQ(facet.normal, Vec3::UnitZ());
  }
}

TEST(View3dFile, subsurfaces_that_touch_and_lie_in_each_other_are_cut) {
  const ExchangeScene read = geometry_of(
      "room.vs3",
      floor_and(square(5, "1", "1") + square(9, "2", "1") + "V 13 1.25 1.25 0\nV 14 1.5 1.25 0\nV 15 1.5 1.5 0\n",
                "S 2 5 6 7 8 1 0 0.5 left\nS 3 9 10 11 12 1 0 0.5 right\nS 4 13 14 15 0 2 0 0.5 inner\n"));
  EXPECT_NEAR(read.scene.area(SurfaceId{0}), 14, 1e-12);
  EXPECT_NEAR(read.scene.area(SurfaceId{1}), 1 - 0.03125, 1e-12);
  EXPECT_NEAR(read.scene.area(SurfaceId{3}), 0.03125, 1e-12);
}

TEST(View3dFile, a_mask_sees_its_base_and_a_null_surface_is_a_hole) {
  const ExchangeScene read =
      geometry_of("room.vs3", floor_and(square(5, "1", "1") + square(9, "2", "2"),
                                        "M 2 8 7 6 5 1 0 0.7 crate\nN 3 12 11 10 9 1 0 0.5 shaft\n"));
  EXPECT_EQ(names_of(read), (Names{"floor"}));
  EXPECT_NEAR(read.scene.area(SurfaceId{0}), 14, 1e-12);
  ASSERT_EQ(read.masks.size(), 1u);
  EXPECT_EQ(read.masks[0].name, "crate");
  EXPECT_EQ(read.masks[0].base, SurfaceId{0});
  EXPECT_NEAR(read.masks[0].area, 1, 1e-12);
  EXPECT_EQ(read.masks[0].emittance, 0.7);
}

TEST(View3dFile, format_3a_places_polygons_by_azimuth_and_tilt) {
  // The L-shaped room of Pinney and Bean, as View3D's manual gives it: a closed room of 5 m² floor, 3 m high.
  const ExchangeScene read = geometry_of(
      "l.vs3",
      "T L shaped room\nC  encl=1\nF  3a\n"
      "S  1  R   0   0  0.90  srf-1\n  3. 0. 0.    0  90    3. 3.\n"
      "S  2  R   0   0  0.90  srf-2\n  3. 1. 0.  270  90    1. 3.\n"
      "S  3  r   0   0  0.90  srf-3\n  1. 1. 0.  180  90    2. 3.\n"
      "S  4  R   0   0  0.90  srf-4\n  1. 3. 0.  270  90    2. 3.\n"
      "S  5  R   0   0  0.90  srf-5\n  0. 3. 0.  180  90    1. 3.\n"
      "S  6  R   0   0  0.90  srf-6\n  0. 0. 0.   90  90    3. 3.\n"
      "S  7  Q   0   0  0.90  srf-7\n  3. 0. 3.    0  180\n  2. 0.   3. 0.   3. 1.   2. 1.\n"
      "S  8  Q   0   0  0.90  srf-8\n  0. 0. 0.  180   0\n  0. 0.   1. 0.   1. 1.   0. 1.\n"
      "S  9  Q   0   7  0.90  srf-7b\n  3. 0. 3.    0  180\n  2. 1.   3. 1.   3. 3.   2. 3.\n"
      "S 10  Q   0   7  0.90  srf-7c\n  3. 0. 3.    0  180\n  0. 0.   2. 0.   2. 1.   0. 1.\n"
      "S 11  Q   0   8  0.90  srf-8b\n  0. 0. 0.  180.  0.\n  0. 1.   1. 1.   1. 3.   0. 3.\n"
      "S 12  q   0   8  0.90  srf-8c\n  0. 0. 0.  180.  0.\n  1. 0.   3. 0.   3. 1.   1. 1.\nEnd of data\n");
  ASSERT_EQ(read.scene.surfaces.size(), 12u);
  EXPECT_EQ(read.surfaces[8].group, "srf-7");
  EXPECT_EQ(read.scene.box().max(), Vec3(3, 3, 3)) << "multiples of 90 degrees are exact";
  EXPECT_EQ(read.scene.box().min(), Vec3(0, 0, 0));
  Vec3 sum = Vec3::Zero();
  double volume = 0;
  for (const Facet& f : read.scene.facets) {
    sum += f.area * f.normal;
    volume -= f.area * f.normal.dot(f.corner[0]) / 3;  // they look inwards
  }
  EXPECT_NEAR(sum.norm(), 0, 1e-12) << "it is closed";
  EXPECT_NEAR(volume, 15, 1e-12);
}

TEST(View3dFile, faults_name_their_line) {
  const auto said = [](const std::string& vertices, const std::string& surfaces) {
    return said_of_geometry("r.vs3", floor_and(vertices, surfaces));
  };
  EXPECT_EQ(said("", ""), "read");
  EXPECT_EQ(said("V 6 0 0 0\n", ""), "r.vs3:9: vertex 5 is expected here, not 6");
  EXPECT_EQ(said("V 5 0 x 0\n", ""), "r.vs3:9: 'x' is not a coordinate");
  EXPECT_EQ(said("V 5 0 0\n", ""), "r.vs3:9: the line ends before a coordinate");
  EXPECT_EQ(said("V 5 0 nan 0\n", ""), "r.vs3:9: 'nan' is not a coordinate");
  EXPECT_EQ(said("V -5 0 0 0\n", ""), "r.vs3:9: '-5' is not a vertex number");
  EXPECT_EQ(said("W 5 0 0 0\n", ""),
            "r.vs3:9: the key 'W' is not known: one of T, C, F, V, S, M, N, O, X, E is expected");
  EXPECT_EQ(said("", "S 3 1 2 3 4 0 0 1 x\n"), "r.vs3:10: surface 2 is expected here, not 3");
  EXPECT_EQ(said("", "S 2 1 2 9 4 0 0 1 x\n"), "r.vs3:10: surface 2 refers to vertex 9, and there are 4");
  EXPECT_EQ(said("", "S 2 1 0 2 4 0 0 1 x\n"), "r.vs3:10: surface 2 refers to vertex 0, and there are 4");
  EXPECT_EQ(said("", "S 2 1 2 3 4 0 0 1.5 x\n"), "r.vs3:10: an emittance lies between 0 and 1");
  EXPECT_EQ(said("", "S 2 1 2 3 4 3 0 1 x\n"), "r.vs3:10: surface 2 cannot have surface 3 as its base");
  EXPECT_EQ(said("", "S 2 1 2 3 4 2 0 1 x\n"), "r.vs3:10: surface 2 cannot have surface 2 as its base");
  EXPECT_EQ(said("", "S 2 1 2 3 4 0 3 1 x\n"), "r.vs3:10: surface 2 cannot be combined with surface 3");
  EXPECT_EQ(said("", "M 2 4 3 2 1 0 0 1 x\n"), "r.vs3:10: surface 2 needs a base surface, which it covers");
  EXPECT_EQ(said("", "S 2 1 2 2 0 0 0 1 x\n").substr(0, 42), "r.vs3:10: surface 2 ('x') cannot be used: ");
  EXPECT_EQ(said("V 5 1 1 1\n", "S 2 1 2 5 0 1 0 1 x\n"),
            "r.vs3:11: surface 2 ('x') does not lie in the plane of its base, surface 1");
  EXPECT_EQ(said("", "S 2 3 2 1 0 1 0 1 x\n"),
            "r.vs3:10: surface 2 ('x') must face the way that its base faces, surface 1");
  EXPECT_EQ(said("", "M 2 1 2 3 0 1 0 1 x\n"), "r.vs3:10: surface 2 ('x') must face its base, surface 1");
  EXPECT_EQ(said(square(5, "3.5", "0"), "S 2 5 6 7 8 1 0 1 x\n"),
            "r.vs3:14: surface 2 ('x') does not lie within its base, surface 1, or overlaps another one there");
  EXPECT_EQ(said("", "M 2 4 3 2 1 1 0 1 x\n"),
            "r.vs3:10: surface 2 ('x') covers all that is left of its base, surface 1");
  EXPECT_EQ(said("V 5 0 0 1e100\n", "S 2 1 2 5 0 0 0 1 x\n"),
            "r.vs3:11: surface 2 ('x') cannot be used: a corner lies at (0, 0, 1e+100) m: at most 1e+15 m from 0 along "
            "each axis expected");
  EXPECT_EQ(
      said("V 5 0 9 0\n", "S 2 1 3 2 5 0 0 1 x\n"),
      "r.vs3:11: surface 2 ('x') cannot be used: the outline crosses or touches itself: the edges after corners 0 "
      "and 2 meet");
  EXPECT_EQ(said_of_geometry("r.vs3", ""), "r.vs3: the file has no surfaces");
  EXPECT_EQ(said_of_geometry("r.vs3", "V 1 0 0 0\n"),
            "r.vs3:1: a line 'F 3' or 'F 3a' is expected before vertices and surfaces");
  EXPECT_EQ(said_of_geometry("r.vs3", "F 2\n"), "r.vs3:1: the format '2' is not known: 3 or 3a is expected");
  EXPECT_EQ(said_of_geometry("r.vs3", "F 3a\nS 1 R 0 0 1 a\n 0 0 0 0 90 3\n"),
            "r.vs3:3: the file ends within a surface");
  EXPECT_EQ(said_of_geometry("r.vs3", "F 3a\nS 1 R 0 0 1 a\n 0 0 0 0 90 3 3 3\n"),
            "r.vs3:3: the surface has more numbers than its shape");
  EXPECT_EQ(said_of_geometry("r.vs3", "F 3a\nS 1 P 0 0 1 a\n"),
            "r.vs3:2: the shape 'P' is not known: R (rectangle), Q (quadrilateral) or T (triangle) is expected");
  EXPECT_EQ(said_of_geometry("r.vs3", std::string("F 3\n\0", 5)), "r.vs3:2: a NUL byte: text in UTF-8 is expected");
}

TEST(View3dFile, texts_that_are_cut_before_their_end_are_refused_in_one_line) {
  const std::string text = floor_and(square(5, "1", "1"), "S 2 5 6 7 8 1 0 0.5 hatch\nO 3 5 6 7 0\n");
  const std::size_t end = text.find("End of data");
  for (std::size_t length = 0; length <= end; ++length)
    EXPECT_TRUE(said_of_geometry("r.vs3", text.substr(0, length)).starts_with("r.vs3:")) << length;
  for (std::size_t length = end + 1; length <= text.size(); ++length)
    EXPECT_EQ(said_of_geometry("r.vs3", text.substr(0, length)), "read") << length;
  EXPECT_EQ(said_of_geometry("r.vs3", text.substr(0, end)),
            "r.vs3:15: the file ends without a line 'End of data': it may have been cut short");
  EXPECT_EQ(said_of_geometry("r.vs3", text.substr(0, end) + "*"), "read");
}

}  // namespace
}  // namespace interflect::scene
