#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/apps/factor_tables.h"
#include "tests/apps/geometry_texts.h"
#include "tests/apps/program.h"

namespace interflect::test {
namespace {

const std::vector<std::string> methods = {"analytic",          "hybrid",          "gauss-lambert", "duffy",
                                          "area-to-area",      "hemisphere-rays", "global-lines",  "hemicube",
                                          "hemicube-midpoint", "hemicube-max",    "single-plane"};

using Rings = std::vector<std::vector<Vec3>>;
using Table = std::map<std::pair<std::string, std::string>, TableEntry>;

const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};  // looks up
const std::vector<Vec3> lid{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};     // looks down
const std::vector<Vec3> wall{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};    // looks along x

std::string obj_of(const Rings& rings, const Vec3& shift = Vec3::Zero()) {
  std::string vertices, faces;
  int count = 0;
  for (std::size_t k = 0; k < rings.size(); ++k) {
    std::string corners;
    for (const Vec3& x : rings[k]) {
      const Vec3 y = x + shift;
      vertices += core::format("v %.17g %.17g %.17g\n", y.x(), y.y(), y.z());
      corners += core::format(" %d", ++count);
    }
    faces += core::format("g face%zu\nf%s\n", k, corners.c_str());
  }
  return vertices + faces;
}

Table factors(const TemporaryFolder& folder, const std::string& mesh, const std::string& method,
              const std::string& tolerance, const std::vector<std::string>& more = {}) {
  const std::string out = folder / (method + tolerance + ".csv");
  std::vector<std::string> command{"view-factors", mesh, "-o", out, "--form-factors", method, "--tolerance", tolerance};
  if (contains(method, "hemicube") || method == "single-plane") command.insert(command.end(), {"--resolution", "64"});
  command.insert(command.end(), more.begin(), more.end());
  const Outcome run = interflect(command, {.patience_s = 0.2 * usual_patience_s});
  EXPECT_TRUE(run.status == 0 || run.status == 1)
      << method << ": " << run.err;  // 1: less accurate than asked, and said
  return entries_of(read_file(out));
}

/// Numbers that may be view factors: finite, 0 <= F <= 1, with an error.
void expect_sound(const Table& table, const std::string& method) {
  for (const auto& [pair, entry] : table) {
    EXPECT_TRUE(entry.F >= 0 && entry.F <= 1) << method << ' ' << pair.first << ' ' << pair.second << ' ' << entry.F;
    EXPECT_TRUE(std::isfinite(entry.error) && entry.error >= 0) << method;
  }
}

/// All ten against the analytic one.  Quadrature is asked for entries to 4 % (entry_tolerance of rows to 1e-2); errors
/// are 1.96 standard errors of what is sampled: 4.5 of them, for about 1 000 comparisons in this file at alpha 0.01.
void expect_all_methods_agree(const Rings& rings, const Vec3& shift = Vec3::Zero()) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("mesh.obj", obj_of(rings, shift));
  const Table exact = factors(folder, mesh, "analytic", "1e-4");
  EXPECT_FALSE(exact.empty());
  for (const std::string& method : methods) {
    Table found = factors(folder, mesh, method, "1e-2");
    expect_sound(found, method);
    for (const auto& [pair, entry] : exact) {
      const TableEntry other = found[pair];
      EXPECT_NEAR(other.F, entry.F, std::max(4.5 / 1.96 * other.error, 0.04 * entry.F) + entry.error + 1e-15)
          << method << ": " << pair.first << " to " << pair.second;
    }
  }
}

TEST(BadGeometry, polygons_that_touch_exchange_what_they_see) {
  expect_all_methods_agree({square, wall, {{1, 1, 0}, {1, 2, 0}, {1, 2, 1}, {1, 1, 1}}});
  const TemporaryFolder folder;
  Table F = factors(folder, folder.write("mesh.obj", obj_of({square, wall})), "analytic", "1e-6");
  EXPECT_NEAR((F[{"0", "1"}].F), 0.20004377607540315, (F[{"0", "1"}].error));
}

TEST(BadGeometry, polygons_that_cross_exchange_what_is_in_front) {
  expect_all_methods_agree({square,
                            lid,
                            {{.5, 0, -.5}, {.5, 0, .5}, {.5, 1, .5}, {.5, 1, -.5}},
                            {{0, 0, .2}, {1, 0, .8}, {1, 1, .8}, {0, 1, .2}}});
}

TEST(BadGeometry, polygons_in_each_others_planes_exchange_nothing) {
  const Rings rings{
      square, {{2, 0, 0}, {3, 0, 0}, {3, 1, 0}, {2, 1, 0}}, lid, {{2, 0, .5}, {2, 1, .5}, {2, 1, 1.5}, {2, 0, 1.5}}};
  expect_all_methods_agree(rings);
  const TemporaryFolder folder;
  const std::string mesh = folder.write("mesh.obj", obj_of(rings));
  for (const std::string& method : methods) {
    Table found = factors(folder, mesh, method, "1e-2");
    EXPECT_EQ((found[{"0", "1"}].F), 0) << method;
  }
}

// 10^-9 wide, as triangles and as quads, between the squares and as what might hide one from the other.
TEST(BadGeometry, slivers_have_factors_like_any_other) {
  constexpr double e = 1e-9;
  const Rings rings{square,
                    lid,
                    {{0, 0, .5}, {0, e, .5}, {1, 0, .5}},
                    {{0, .2, .3}, {0, .2 + e, .3}, {1, .2 + e, .3}, {1, .2, .3}},
                    {{0, .5, .5}, {0, .5, .5 + e}, {1, .5, .5 + e}, {1, .5, .5}}};
  const TemporaryFolder folder;
  const std::string mesh = folder.write("mesh.obj", obj_of(rings));
  for (const std::string& method : methods)
    for (const char* size : {"0.4", "2"}) {
      Table found = factors(folder, mesh, method, "1e-2", {"--element-size", size});
      expect_sound(found, method);
    }
  for (const std::string& method : methods) {
    Table found = factors(folder, mesh, method, "1e-2");
    expect_sound(found, method);
    EXPECT_NEAR((found[{"0", "1"}].F), 0.19982489569838738, (4.5 / 1.96 * found[{"0", "1"}].error) + 1e-8) << method;
  }
}

/// The walls of an L-shaped room: floor and ceiling are concave.
Rings concave_room() {
  const std::vector<Vec2> plan{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  Rings rings(2);
  for (const Vec2& p : plan) {
    rings[0].emplace_back(p.x(), p.y(), 0);
    rings[1].insert(rings[1].begin(), Vec3(p.x(), p.y(), 2));
  }
  for (std::size_t k = 0; k < plan.size(); ++k) {
    const Vec2 &a = plan[k], &b = plan[(k + 1) % plan.size()];
    rings.push_back({{b.x(), b.y(), 0}, {a.x(), a.y(), 0}, {a.x(), a.y(), 2}, {b.x(), b.y(), 2}});
  }
  return rings;
}

double largest_row_error(const Table& table) {
  std::map<std::string, double> sum;
  for (const auto& [pair, entry] : table) sum[pair.first] += entry.F;
  double largest = 0;
  for (const auto& [row, F] : sum) largest = std::max(largest, std::abs(F - 1));
  return largest;
}

TEST(BadGeometry, concave_polygons_are_cut_and_their_room_stays_closed) {
  const TemporaryFolder folder;
  for (const Vec3& shift : {Vec3(0, 0, 0), Vec3(1e9, -1e9, 1e9)}) {
    const std::string mesh = folder.write("room.obj", obj_of(concave_room(), shift));
    std::filesystem::remove(folder / "analytic1e-3.h5");
    EXPECT_LT(largest_row_error(factors(folder, mesh, "analytic", "1e-3")), 1e-3);
  }
  expect_all_methods_agree(concave_room());
}

// A metre is 8 million steps of the coordinates there.
TEST(BadGeometry, coordinates_around_a_billion_cost_digits_and_no_more) {
  expect_all_methods_agree({square, lid, wall}, {1e9, -1e9, 1e9});
  const TemporaryFolder folder;
  Table F =
      factors(folder, folder.write("mesh.obj", obj_of({square, lid, wall}, {1e9, -1e9, 1e9})), "analytic", "1e-5");
  EXPECT_NEAR((F[{"0", "1"}].F), 0.19982489569838738, 1e-5);
  EXPECT_NEAR((F[{"0", "2"}].F), 0.20004377607540315, 1e-5);
}

void expect_refused(const std::string& name, const std::string& text, const std::vector<std::string>& said) {
  const TemporaryFolder folder;
  const Outcome run = interflect({"view-factors", folder.write(name, text), "-o", folder / "F.h5", "--quiet"});
  EXPECT_EQ(run.status, 2) << run.out;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  for (const std::string& part : said)
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err << "\nexpected in it: " << part;
  EXPECT_EQ(folder.files(), 1u);
}

// What is seen there is not defined: no command that solves begins.
TEST(BadGeometry, a_place_that_is_there_twice_is_refused_by_name) {
  const std::string corners = "[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]";
  const auto scene_of = [&](const std::string& second) {
    return R"({"format": "interflect/scene/1", "units": "m", "quantity": "radiometric",
      "materials": {"lit": {"type": "diffuse", "reflectance": 0.5, "exitance": 1}},
      "geometry": [{"name": "one", "material": "lit", "polygon": )" +
           corners + R"(}, {"name": "two", "material": "lit", "polygon": )" + second + "}]}";
  };
  const TemporaryFolder folder;
  const auto run = [&](std::vector<std::string> command, const std::string& second) {
    command.insert(command.begin() + 1, folder.write("room.json", scene_of(second)));
    command.insert(command.end(), {"--element-size", "0.5", "-o", folder / "out.h5"});
    return interflect(command);
  };
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{{"solve"},
                                                                                       {"solve", "--bounds"},
                                                                                       {"solve", "--forecast"},
                                                                                       {"validate"},
                                                                                       {"shoot"},
                                                                                       {"exchange"},
                                                                                       {"compare-solvers"},
                                                                                       {"compare-form-factors"},
                                                                                       {"view-factors"}}) {
    const Outcome refused = run(command, "[[0.5, 0, 0], [1, 0, 0], [1, 1, 0], [0.5, 1, 0]]");
    EXPECT_EQ(refused.status, 2) << command.front();
    EXPECT_NE(refused.err.find("room.json: 'one' and 'two' lie in one plane and overlap in 0.5 m2"), std::string::npos)
        << refused.err;
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
    EXPECT_EQ(folder.files(), 1u);
  }
  EXPECT_EQ(run({"solve", "--bounds", "--no-pictures"}, "[[1, 0, 0], [2, 0, 0], [2, 1, 0], [1, 1, 0]]").status, 0);
}

// Of a mesh that is one surface the parts cannot be left out; what is seen is that surface, and only bounds are refused.
TEST(BadGeometry, parts_of_a_surface_that_are_there_twice_are_warned_of) {
  const TemporaryFolder folder;
  folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0 0\nv 0.5 1 0\nf 1 2 3 4\nf 5 2 3 6\n");
  const std::string scene = folder.write("room.json", R"({"format": "interflect/scene/1", "units": "m",
    "materials": {"lit": {"type": "diffuse", "reflectance": 0.5, "exitance": 1}},
    "geometry": [{"file": "mesh.obj", "unmapped": "lit"}]})");
  const auto solve = [&](const std::vector<std::string>& more) {
    std::vector<std::string> command{"solve", scene, "--element-size", "0.5", "--no-pictures", "-o", folder / "out"};
    command.insert(command.end(), more.begin(), more.end());
    return interflect(command);
  };
  const Outcome solved = solve({});
  EXPECT_EQ(solved.status, 0) << solved.err;
  EXPECT_NE(solved.err.find("overlap in 0.5 m2"), std::string::npos) << solved.err;
  EXPECT_NE(solved.err.find(": that part counts twice"), std::string::npos) << solved.err;
  EXPECT_NE(read_file(folder / "out/summary.json").find("that part counts twice"), std::string::npos);
  EXPECT_EQ(solve({"--bounds"}).status, 2);
}

TEST(BadGeometry, overlaps_in_one_plane_are_refused_by_name) {
  const std::vector<Vec3> shifted{{.5, .25, 0}, {1.5, .25, 0}, {1.5, .75, 0}, {.5, .75, 0}};
  expect_refused("mesh.obj", obj_of({square, shifted, lid}),
                 {"'face0' and 'face1' lie in one plane and overlap in 0.25 m2"});
  const std::vector<Vec3> same_place{{0, 0, 0}, {.5, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  expect_refused("mesh.obj", obj_of({square, lid, same_place}),
                 {"'face0' and 'face2' lie in one plane and overlap in 1 m2"});
  View3dText twice;
  twice.polygon('S', square, "one");
  twice.polygon('S', square, "two");
  twice.polygon('S', lid, "lid");
  expect_refused("mesh.vs3", twice.text(), {"'one' and 'two' lie in one plane and overlap in 1 m2"});
  const TemporaryFolder folder;
  const std::string mesh = folder.write("mesh.vs3", twice.text());
  EXPECT_EQ(interflect({"view-factors", mesh, "-o", folder / "F.csv", "--leave-out", "two"}).status, 0);
  // Two faces back to back are a thin plate.
  std::vector<Vec3> back = square;
  std::reverse(back.begin(), back.end());
  EXPECT_EQ(interflect({"view-factors", folder.write("plate.obj", obj_of({square, back, lid})), "-o", folder / "G.csv"})
                .status,
            0);
}

TEST(BadGeometry, faces_without_area_are_dropped_with_a_count_or_refused_by_name) {
  const std::vector<Vec3> line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, point(3, Vec3(0, 0, 0));
  const TemporaryFolder folder;
  const Outcome run = interflect(
      {"view-factors", folder.write("mesh.obj", obj_of({line, point, square, square, lid})), "-o", folder / "F.csv"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("2 degenerate faces dropped: face0/1, face1/2"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("1 duplicate face dropped: face3/4"), std::string::npos) << run.err;
  EXPECT_EQ(entries_of(read_file(folder / "F.csv")).size(), 2u);
  View3dText text;
  text.polygon('S', line, "thread");
  text.polygon('S', lid, "lid");
  expect_refused("mesh.vs3", text.text(), {"('thread') cannot be used: "});
}

// Around 10^9 a sliver of 10^-9 m is no polygon.
TEST(BadGeometry, what_coordinates_do_not_resolve_is_refused_or_dropped) {
  const std::vector<Vec3> sliver{{0, 0, .5}, {0, 1e-9, .5}, {1, 0, .5}};
  const TemporaryFolder folder;
  const Outcome run =
      interflect({"view-factors", folder.write("mesh.obj", obj_of({square, lid, sliver}, {1e9, 1e9, 1e9})), "-o",
                  folder / "F.csv"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("1 degenerate face dropped"), std::string::npos) << run.err;
}

// What a printer of digits leaves of a square: its two halves tilt by as much as it is off its plane, and one would
// hide the other, or half of the view.
TEST(BadGeometry, polygons_that_are_flat_but_for_rounding_do_not_hide_themselves) {
  const TemporaryFolder folder;
  for (const double off : {1e-11, 1e-9, 1e-7, 2e-6, -1e-7})
    for (const char* method : {"analytic", "hybrid", "gauss-lambert"}) {
      const std::vector<Vec3> high{{0, 0, 1}, {0, 1, 1}, {1, 1, 1 + off}, {1, 0, 1}};
      const Outcome run = interflect({"view-factors", folder.write("mesh.obj", obj_of({square, high})), "-o",
                                      folder / "F.csv", "--form-factors", method});
      EXPECT_EQ(run.status, 0) << run.err;
      EXPECT_NE(run.err.find("1 polygon flattened, by "), std::string::npos) << run.err;
      const TableEntry F = entries_of(read_file(folder / "F.csv")).at({"0", "1"});
      EXPECT_NEAR(F.F, 0.19982489569838738, F.error + .5 * std::abs(off)) << method << " " << off;
      EXPECT_LT(F.error, 1e-5) << method << " " << off;
    }
}

/// Six faces, from (0, 0, 0) + at, as seen from outside or from inside.
std::vector<std::vector<Vec3>> box_faces(const Vec3& at, const Vec3& size, bool inwards) {
  std::vector<std::vector<Vec3>> faces;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true}) {
      std::vector<Vec3> ring(4, at);
      for (int k = 0; k < 4; ++k) {
        Vec3& x = ring[std::size_t(k)];
        if (upper) x[axis] += size[axis];
        if (k == 1 || k == 2) x[(axis + 1) % 3] += size[(axis + 1) % 3];
        if (k >= 2) x[(axis + 2) % 3] += size[(axis + 2) % 3];
      }
      if (upper == inwards) std::reverse(ring.begin(), ring.end());
      faces.push_back(ring);
    }
  return faces;
}

// What a box stands on sees the box's inside where it is covered.  A plate of two faces covers nothing, and what stands
// clear of the floor, either.
TEST(BadGeometry, faces_that_lie_on_each_other_and_see_nothing_are_named) {
  const TemporaryFolder folder;
  const auto said = [&](const std::vector<std::vector<Vec3>>& bodies) {
    std::vector<std::vector<Vec3>> faces = box_faces({0, 0, 0}, {3, 3, 3}, true);
    faces.insert(faces.end(), bodies.begin(), bodies.end());
    return interflect({"view-factors", folder.write("mesh.obj", obj_of(faces)), "-o", folder / "F.csv"}).err;
  };
  EXPECT_NE(said(box_faces({1, 1, 0}, {1, 1, 1}, false)).find(" lie on each other over 1 m2 at ("), std::string::npos);
  EXPECT_EQ(said(box_faces({1, 1, .5}, {1, 1, 1}, false)), "");
  EXPECT_EQ(said({{{1, 1, 1}, {2, 1, 1}, {2, 2, 1}, {1, 2, 1}}, {{1, 1, 1}, {1, 2, 1}, {2, 2, 1}, {2, 1, 1}}})
                .find("lie on each other"),
            std::string::npos);
}

}  // namespace
}  // namespace interflect::test
