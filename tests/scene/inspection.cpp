#include "scene/inspection.h"

#include <gtest/gtest.h>

#include <chrono>

#include "core/error.h"
#include "scene/builder.h"

namespace interflect::scene {
namespace {

using geometry::Box;
using geometry::PlanarPolygon;
using geometry::Ring;
using Kind = Inspection::Finding::Kind;
using Facing = SceneBuilder::Facing;

struct Site {
  SceneBuilder builder{{"y"}};
  MaterialId wall = builder.add_material({"wall", Spectrum(0.5), Spectrum(), Sides::front});
  MaterialId sheet = builder.add_material({"sheet", Spectrum(0.5), Spectrum(), Sides::both});
};

std::vector<Inspection::Finding> of_kind(const Inspection& inspection, Kind kind) {
  std::vector<Inspection::Finding> out;
  for (const auto& f : inspection.findings)
    if (f.kind == kind) out.push_back(f);
  return out;
}

Ring square(double x, double y, double z, double side) {
  return {{x, y, z}, {x + side, y, z}, {x + side, y + side, z}, {x, y + side, z}};
}

TEST(Inspect, a_closed_room_with_a_body_in_it_is_sound_at_any_scale) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    Site site;
    site.builder.add_box("room", Box(Vec3(0, 0, 0), scale * Vec3(5, 4, 3)), site.wall, Facing::inward);
    site.builder.add_box("body", Box(scale * Vec3(1, 1, 1), scale * Vec3(2, 2, 2)), site.wall);
    const Inspection inspection = inspect(site.builder.finish());
    EXPECT_TRUE(inspection.findings.empty());
    EXPECT_TRUE(inspection.closed());
    EXPECT_EQ(inspection.open_edge_length, 0);
  }
}

TEST(Inspect, corners_on_the_edge_of_a_neighbour_are_no_gaps) {
  Site site;  // a box whose top is three squares of different size
  const Box box(Vec3(0, 0, 0), Vec3(3, 2, 1));
  for (const Ring& ring : std::vector<Ring>{{{0, 0, 0}, {0, 2, 0}, {3, 2, 0}, {3, 0, 0}},
                                            {{0, 0, 0}, {3, 0, 0}, {3, 0, 1}, {0, 0, 1}},
                                            {{0, 2, 0}, {0, 2, 1}, {3, 2, 1}, {3, 2, 0}},
                                            {{0, 0, 0}, {0, 0, 1}, {0, 2, 1}, {0, 2, 0}},
                                            {{3, 0, 0}, {3, 2, 0}, {3, 2, 1}, {3, 0, 1}},
                                            square(0, 0, 1, 2),
                                            square(2, 0, 1, 1),
                                            square(2, 1, 1, 1)})
    site.builder.add_polygon("p", {ring, {}}, site.wall);
  EXPECT_TRUE(inspect(site.builder.finish()).findings.empty());
}

TEST(Inspect, a_missing_wall_is_found_by_its_rim) {
  Site site;
  site.builder.add_box("room", Box(Vec3(0, 0, 0), Vec3(5, 4, 3)), site.wall, Facing::inward);
  Scene scene = site.builder.finish();
  scene.facets.resize(scene.facets.size() - 2);  // the ceiling
  scene.surfaces.pop_back();
  const Inspection inspection = inspect(scene);
  EXPECT_FALSE(inspection.closed());
  EXPECT_NEAR(inspection.open_edge_length, 18, 1e-12);
  ASSERT_EQ(inspection.findings.size(), 4u);
  EXPECT_EQ(describe(inspection.findings[0].kind), "gap (open edge)");
  EXPECT_DOUBLE_EQ(inspection.findings[0].size, 5);  // the largest first
  EXPECT_EQ(inspection.findings[0].where.z(), 3);
}

TEST(Inspect, a_gap_of_a_millimetre_is_found_and_one_of_a_nanometre_is_none) {
  for (const double gap : {1e-3, 1e-9}) {
    Site site;
    site.builder.add_polygon("a", {square(0, 0, 0, 1), {}}, site.wall);
    site.builder.add_polygon("b", {{{1 + gap, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1 + gap, 1, 0}}, {}}, site.wall);
    const double open = inspect(site.builder.finish()).open_edge_length;
    EXPECT_NEAR(open, gap > 1e-6 ? 8 : 6, 1e-2);
  }
}

TEST(Inspect, a_body_without_a_bottom_and_a_partition_are_closed_by_the_floor_they_stand_on_at_any_scale) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    Site site;
    site.builder.add_box("room", Box(Vec3(0, 0, 0), scale * Vec3(5, 4, 3)), site.wall, Facing::inward);
    site.builder.add_polygon(
        "partition", {{scale * Vec3(2, 0, 0), scale * Vec3(2, 4, 0), scale * Vec3(2, 4, 3), scale * Vec3(2, 0, 3)}, {}},
        site.sheet);
    const Box body(scale * Vec3(3, 1, 0), scale * Vec3(4, 2, 1));
    site.builder.add_box("body", body, site.wall);
    Scene scene = site.builder.finish();
    std::erase_if(scene.facets, [&](const Facet& f) { return scene.surface(f.surface).name == "body/z-"; });
    EXPECT_TRUE(inspect(scene).findings.empty());
  }
}

TEST(Inspect, a_foot_that_hangs_over_the_edge_of_the_floor_is_open_there) {
  Site site;
  site.builder.add_polygon("floor", {square(0, 0, 0, 2), {}}, site.wall);
  site.builder.add_polygon("wall", {{{1, 1, 0}, {2.5, 1, 0}, {2.5, 1, 1}, {1, 1, 1}}, {}}, site.wall);
  const Inspection inspection = inspect(site.builder.finish());
  EXPECT_NEAR(inspection.open_edge_length, 8 + 1 + 1.5 + 1 + 0.5, 1e-12);
}

TEST(Inspect, the_rim_of_a_two_sided_sheet_is_told_from_a_gap) {
  Site site;
  site.builder.add_polygon("sheet", {square(0, 0, 0, 1), {}}, site.sheet);
  const Inspection inspection = inspect(site.builder.finish());
  EXPECT_EQ(of_kind(inspection, Kind::rim).size(), 4u);
  EXPECT_FALSE(inspection.has(Kind::gap));
  EXPECT_FALSE(inspection.closed());
}

TEST(Inspect, a_flipped_wall_disagrees_with_its_neighbours) {
  Site site;
  site.builder.add_box("room", Box(Vec3(0, 0, 0), Vec3(5, 4, 3)), site.wall, Facing::inward);
  Scene scene = site.builder.finish();
  for (Facet& f : scene.facets)
    if (f.surface == SurfaceId{0}) {  // room/x-, 4 m x 3 m
      std::swap(f.corner[1], f.corner[2]);
      f.normal = -f.normal;
    }
  const auto found = of_kind(inspect(scene), Kind::inconsistent_normals);
  ASSERT_EQ(found.size(), 4u);
  double length = 0;
  for (const auto& f : found) {
    EXPECT_EQ(f.surface, "room/x-");
    length += f.size;
  }
  EXPECT_DOUBLE_EQ(length, 14);
}

TEST(Inspect, two_sided_sheets_have_no_wrong_side) {
  Site site;
  Ring other = square(1, 0, 0, 1);
  std::reverse(other.begin(), other.end());
  site.builder.add_polygon("a", {square(0, 0, 0, 1), {}}, site.sheet);
  site.builder.add_polygon("b", {other, {}}, site.sheet);
  EXPECT_TRUE(of_kind(inspect(site.builder.finish()), Kind::inconsistent_normals).empty());
}

TEST(Inspect, a_lamp_that_lies_on_the_ceiling_overlaps_it_and_one_cut_out_does_not) {
  for (const bool cut : {false, true}) {
    Site site;
    PlanarPolygon ceiling{square(0, 0, 3, 4), {}};
    if (cut) ceiling.holes.push_back(square(1, 1, 3, 1));
    site.builder.add_polygon("ceiling", ceiling, site.wall);
    site.builder.add_polygon("lamp", {square(1, 1, 3, 1), {}}, site.wall);
    const auto found = of_kind(inspect(site.builder.finish()), Kind::coplanar_overlap);
    ASSERT_EQ(found.size(), cut ? 0u : 1u);
    if (cut) continue;
    EXPECT_EQ(found[0].surface, "ceiling");
    EXPECT_EQ(found[0].other, "lamp");
    EXPECT_NEAR(found[0].size, 1, 1e-12);
  }
}

// Fronts the same way; a front and the back of a two-sided one; two backs; and back to back, where each is one.
TEST(Inspect, overlaps_tell_what_active_sides_have_in_common) {
  Ring other = square(0, 0, 0, 1);
  std::reverse(other.begin(), other.end());
  const auto twice = [&](bool same_way, bool first_two_sided, bool second_two_sided) {
    Site site;
    site.builder.add_polygon("a", {square(0, 0, 0, 1), {}}, first_two_sided ? site.sheet : site.wall);
    site.builder.add_polygon("b", {same_way ? square(0, 0, 0, 1) : other, {}},
                             second_two_sided ? site.sheet : site.wall);
    const auto found = overlaps(site.builder.finish());
    return found.size() == 1 ? found[0].twice : -1;
  };
  for (const bool first : {false, true})
    for (const bool second : {false, true}) {
      EXPECT_NEAR(twice(true, first, second), 1, 1e-12);
      EXPECT_NEAR(twice(false, first, second), first || second ? 1 : 0, 1e-12);
    }
}

TEST(Inspect, each_place_once_is_what_surfaces_must_have_and_their_parts_may_lack) {
  const geometry::TriangleCorners whole{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)},
      part{Vec3(0, 0, 0), Vec3(.5, 0, 0), Vec3(0, .5, 0)};
  const auto found_in = [&](bool one_surface, Twice may_be) {
    Site site;
    if (one_surface) {
      site.builder.add_facets("a", std::vector{whole, part}, site.wall);
    } else {
      site.builder.add_facets("a", std::vector{whole}, site.wall);
      site.builder.add_facets("b", std::vector{part}, site.wall);
    }
    return require_each_place_once(site.builder.finish(), may_be).size();
  };
  for (const bool one : {false, true}) EXPECT_THROW(found_in(one, Twice::nothing), core::InputError);
  EXPECT_THROW(found_in(false, Twice::parts_of_a_surface), core::InputError);
  EXPECT_EQ(found_in(true, Twice::parts_of_a_surface), 1u);
  Site apart;
  apart.builder.add_polygon("a", {square(0, 0, 0, 1), {}}, apart.wall);
  EXPECT_TRUE(require_each_place_once(apart.builder.finish()).empty());
}

TEST(Inspect, a_wall_that_is_there_twice_is_a_duplicate_whichever_way_it_faces) {
  Site site;
  Ring twin{{1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  site.builder.add_polygon("a", {square(0, 0, 0, 1), {}}, site.wall);
  site.builder.add_polygon("b", {twin, {}}, site.wall);
  const auto found = of_kind(inspect(site.builder.finish()), Kind::duplicate_faces);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].size, 1, 1e-12);
}

TEST(Inspect, an_empty_scene_has_nothing_to_say) { EXPECT_TRUE(inspect(Scene{}).findings.empty()); }

TEST(Inspect, twelve_thousand_facets_take_no_time) {
  Site site;
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j)
      for (int k = 0; k < 10; ++k)
        site.builder.add_box("b", Box(Vec3(i, j, k), Vec3(i + 0.5, j + 0.5, k + 0.5)), site.wall);
  const Scene scene = site.builder.finish();
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(inspect(scene).findings.empty());
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_LT(seconds, 30);  // 0.2 s on a quiet machine: the bound is against quadratic time, under sanitizers too
  RecordProperty("seconds", std::to_string(seconds));
}

}  // namespace
}  // namespace interflect::scene
