#include "scene/geometry_file.h"

#include <gtest/gtest.h>

#include <cstring>

#include "geometry_texts.h"
#include "texts.h"

namespace interflect::scene {
namespace {

using test::geometry_of;
using test::groups_of;
using test::names_of;
using test::said_of_geometry;
using Names = std::vector<std::string>;

/// Two walls of a group and a lid.
const std::string box =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\n"
    "g wall\nusemtl brick\nf 1 2 3 4\nf 1 2 6 5\ng lid\nf 1 2 3\n";

TEST(GeometryFile, a_mesh_is_a_surface_a_face_with_the_names_of_its_groups) {
  const ExchangeScene read = geometry_of("m.obj", box);
  EXPECT_EQ(names_of(read), (Names{"wall/brick/1", "wall/brick/2", "lid/brick"}));
  EXPECT_EQ(groups_of(read), (Names{"wall/brick", "wall/brick", "lid/brick"}));
  ASSERT_TRUE(read.scene.surfaces[0].outline);
  EXPECT_EQ(read.scene.surfaces[0].outline->outer.size(), 4u);
  EXPECT_EQ(read.scene.materials.size(), 1u);
  EXPECT_EQ(read.scene.materials[0].name, "brick");
  EXPECT_EQ(read.scene.materials[0].reflectance[0], 0.5);
  EXPECT_EQ(read.scene.materials[0].sides, Sides::front);
  EXPECT_TRUE(read.scene.emitted_flux().is_zero());
  EXPECT_EQ(read.surfaces[0].role, ExchangeRole::radiates);
  EXPECT_FALSE(read.surfaces[0].emittance);
}

TEST(GeometryFile, groups_may_stay_whole) {
  GeometryOptions options;
  options.whole_groups = true;
  const ExchangeScene read = geometry_of("m.obj", box, options);
  EXPECT_EQ(names_of(read), (Names{"wall/brick", "lid/brick"}));
  EXPECT_DOUBLE_EQ(read.scene.area(SurfaceId{0}), 2);
}

TEST(GeometryFile, lengths_are_in_the_unit_that_is_named) {
  GeometryOptions options;
  options.unit = "mm";
  EXPECT_DOUBLE_EQ(geometry_of("m.obj", box, options).scene.area(SurfaceId{0}), 1e-6);
  options.unit = "meter";
  EXPECT_EQ(said_of_geometry("m.obj", box, options),
            "the unit 'meter' is not known: one of m, cm, mm, ft, in is expected");
}

TEST(GeometryFile, both_sides_of_thin_plates_see) {
  GeometryOptions options;
  options.two_sided = true;
  const ExchangeScene read = geometry_of("m.obj", box, options);
  EXPECT_EQ(read.scene.materials[0].sides, Sides::both);
  EXPECT_EQ(read.scene.side_name(SurfaceId{2}, Side::back), "lid/brick/back");
}

TEST(GeometryFile, surfaces_may_only_occlude_or_not_be_there) {
  GeometryOptions options;
  options.only_occlude = {"lid/brick"};
  options.left_out = {"wall/brick/1"};
  const ExchangeScene read = geometry_of("m.obj", box, options);
  EXPECT_EQ(names_of(read), (Names{"wall/brick/2", "lid/brick"}));
  EXPECT_EQ(read.surfaces[0].role, ExchangeRole::radiates);
  EXPECT_EQ(read.surfaces[1].role, ExchangeRole::only_occludes);
  ASSERT_EQ(read.scene.facets.size(), 3u);
  EXPECT_EQ(read.scene.facets[2].surface, SurfaceId{1});
  EXPECT_EQ(read.scene.surfaces[1].first_facet, 2u);
  // Of a group that occludes a part may be left out, but not all.
  options.only_occlude = {"wall/brick"};
  EXPECT_EQ(names_of(geometry_of("m.obj", box, options)), (Names{"wall/brick/2", "lid/brick"}));
  options.left_out.emplace_back("wall/brick/2");
  EXPECT_EQ(said_of_geometry("m.obj", box, options),
            "m.obj: 'wall/brick' is to occlude only, and to be left out: one of the two expected");
  options.only_occlude = options.left_out = {"lid/brick"};
  EXPECT_EQ(said_of_geometry("m.obj", box, options),
            "m.obj: 'lid/brick' is to occlude only, and to be left out: one of the two expected");
  options.only_occlude.clear();
  options.left_out = {"wall/brick", "lid/brick"};
  EXPECT_EQ(said_of_geometry("m.obj", box, options), "m.obj: every surface is left out");
  options.left_out = {"lid/brik"};
  EXPECT_EQ(said_of_geometry("m.obj", box, options),
            "m.obj: the surface or group 'lid/brik' is not known: did you mean 'lid/brick'?");
}

TEST(GeometryFile, meshes_of_other_formats_are_read_too) {
  const ExchangeScene ply = geometry_of(
      "m.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n");
  EXPECT_EQ(ply.scene.surfaces.size(), 1u);
  EXPECT_DOUBLE_EQ(ply.scene.area(SurfaceId{0}), 1);
  EXPECT_EQ(ply.scene.warnings.size(), 1u) << "of single precision";
  std::string stl(80, ' ');
  stl += std::string("\2\0\0\0", 4);
  for (int k = 0; k < 2; ++k) {
    const float numbers[12] = {
        0, 0, 1, 0, 0, static_cast<float>(k), 1, 0, static_cast<float>(k), 0, 1, static_cast<float>(k)};
    stl.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
    stl.append(2, '\0');
  }
  EXPECT_EQ(geometry_of("m.stl", stl).scene.surfaces.size(), 2u);
}

TEST(GeometryFile, a_scene_file_stays_as_it_is) {
  const std::string text = test::Text().str();
  const ExchangeScene read = geometry_of("s.json", text);
  EXPECT_EQ(names_of(read), (Names{"polygon-0"}));
  EXPECT_EQ(read.scene.materials[0].name, "white");
  GeometryOptions options;
  options.unit = "mm";
  EXPECT_EQ(said_of_geometry("s.json", text, options), "s.json: a scene file says its own unit");
  options = {};
  options.two_sided = true;
  EXPECT_EQ(said_of_geometry("s.json", text, options),
            "s.json: a scene file says itself which surfaces have two sides");
}

TEST(GeometryFile, many_faces_of_one_name_are_named_at_once) {
  std::string text;
  const int n = 200;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= 100; ++j) text += "v " + std::to_string(i) + " " + std::to_string(j) + " 0\n";
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 100; ++j) {
      const int a = 101 * i + j + 1;
      text += "f " + std::to_string(a) + " " + std::to_string(a + 101) + " " + std::to_string(a + 102) + " " +
              std::to_string(a + 1) + "\n";
    }
  const ExchangeScene read = geometry_of("floor.obj", text);
  ASSERT_EQ(read.scene.surfaces.size(), 20000u);
  EXPECT_EQ(read.scene.surfaces.back().name, "floor/20000");
}

TEST(GeometryFile, faces_that_are_dropped_are_named_as_their_surfaces_would_be) {
  const ExchangeScene read = geometry_of("m.obj", box + "f 1 2 3\nf 1 1 2\n");
  EXPECT_EQ(names_of(read), (Names{"wall/brick/1", "wall/brick/2", "lid/brick"}));
  ASSERT_EQ(read.scene.repairs.size(), 2u);
  EXPECT_EQ(read.scene.repairs[0].message, "1 degenerate face dropped: lid/brick/5");
  EXPECT_EQ(read.scene.repairs[1].message, "1 duplicate face dropped: lid/brick/4");
}

TEST(GeometryFile, what_is_none_is_refused_in_one_line) {
  EXPECT_EQ(said_of_geometry("m.vs4", "x"), "m.vs4: the geometry format '.vs4' is not known: did you mean '.vs3'?");
  EXPECT_EQ(said_of_geometry("m", "x"),
            "m: the geometry format '' is not known: one of .obj, .ply, .stl, .gltf, .glb, .vtu, .vtp, .vs3, .json is "
            "expected");
  EXPECT_EQ(said_of_geometry("m.obj", "v 0 0 0\nf 1 2 3\n"),
            "m.obj:2: a face refers to vertex 2, and 1 are defined so far");
  EXPECT_EQ(said_of_geometry("m.obj", ""), "m.obj: the file has no faces");
}

}  // namespace
}  // namespace interflect::scene
