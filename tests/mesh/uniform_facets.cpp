#include <gtest/gtest.h>

#include "core/error.h"
#include "mesh/bisection.h"
#include "tests/mesh/scenes.h"

using namespace interflect;
using namespace interflect::mesh;

namespace {

scene::Scene of_facets(const Triangles& triangles) {
  scene::SceneBuilder builder({"grey"});
  builder.add_facets("mesh", triangles, builder.add_material(material()));
  return builder.finish();
}

double total_area(const ElementMesh& mesh) {
  double area = 0;
  for (const auto& patch : mesh.patches()) area += patch.area;
  return area;
}

/// Euler's number of a part: vertices - edges + faces.
Index euler(const ElementMesh& mesh) {
  const EdgeCensus census(mesh, mesh.parts()[0]);
  Index undirected = 0;
  for (const auto& [edge, count] : census.edges)
    if (edge.first < edge.second || !census.edges.contains({edge.second, edge.first})) ++undirected;
  return static_cast<Index>(census.position.size()) - undirected + mesh.size();
}

}  // namespace

TEST(Bisection, keeps_an_icosphere_closed) {
  const scene::Scene scene = of_facets(test::icosphere(2, 1, false));
  for (const double edge : {1.0, 0.2, 0.07}) {
    const ElementMesh mesh = uniform(scene, edge);
    EXPECT_TRUE(EdgeCensus(mesh, mesh.parts()[0]).open().empty());
    EXPECT_EQ(euler(mesh), 2);
    EXPECT_LE(longest_edge(mesh), edge);
    EXPECT_NEAR(total_area(mesh), scene.area({0}), 1e-12 * total_area(mesh));
  }
}

TEST(Bisection, leaves_triangles_alone_that_are_small_enough) {
  const Triangles sphere = test::icosphere(1, 1, false);
  const ElementMesh mesh = uniform(of_facets(sphere), 2);
  ASSERT_EQ(mesh.size(), static_cast<Index>(sphere.size()));
  for (std::uint32_t i = 0; i < mesh.size(); ++i)
    for (const Vec3& corner : sphere[i]) {
      const auto ring = mesh.patch({i}).ring();
      EXPECT_NE(std::find(ring.begin(), ring.end(), corner), ring.end());
    }
}

// [Rosenberg, Stenger 1975]: longest-edge bisection never makes an angle below half of the smallest one given.
TEST(Bisection, keeps_angles_above_half_of_the_smallest_given) {
  const Triangles one{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.3, 0.4, 0)}};
  const double given = smallest_angle_deg(scene::make_patch({0}, scene::Side::front, one[0]));
  const ElementMesh mesh = uniform(of_facets(one), 0.02);
  EXPECT_GT(mesh.size(), 500);
  for (const auto& patch : mesh.patches()) EXPECT_GE(smallest_angle_deg(patch), given / 2 - 1e-9);
}

TEST(Bisection, keeps_needles) {
  const Triangles needle{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 1e-7, 0)}};
  const ElementMesh mesh = uniform(of_facets(needle), 0.1);
  EXPECT_LE(longest_edge(mesh), 0.1 * (1 + 1e-9));
  EXPECT_NEAR(total_area(mesh), 0.5e-7, 1e-12 * 0.5e-7);
}

// At 5e6 m coordinates are 9.3e-10 m apart.  Of the first facet, one of them thick, not even a quarter has an area that
// coordinates can hold: it is refused in a line that says what and where.  One of 60 is cut into quarters but not into
// pieces of 0.1 m: it stays whole, and its neighbour is cut nonetheless.
TEST(Bisection, of_needles_thinner_than_their_coordinates_resolve_is_refused_or_left_undone) {
  const Vec3 far(5e6, 5e6, 0);
  const auto at = [&](double x, double y) -> Vec3 { return far + Vec3(x, y, 0); };
  const double step = 0x1p-30;
  try {
    uniform(of_facets({{at(0, 0), at(10, 0), at(5, step)}}), 0.5);
    FAIL() << "an InputError expected";
  } catch (const core::InputError& error) {
    EXPECT_EQ(core::single_line(error.what()), error.what());
    EXPECT_NE(std::string(error.what()).find("'mesh'"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("(5000000, 5000000, 0)"), std::string::npos) << error.what();
  }
  const scene::Scene scene = of_facets({{at(0, 0), at(10, 0), at(5, 60 * step)}, {at(10, 0), at(0, 0), at(5, -4)}});
  const ElementMesh mesh = uniform(scene, 0.1);
  EXPECT_EQ(std::count_if(mesh.patches().begin(), mesh.patches().end(),
                          [](const auto& patch) { return longest_edge(ElementMesh({patch})) > 0.1 * (1 + 1e-9); }),
            1);
  EXPECT_NEAR(total_area(mesh), scene.area({0}), 1e-9);
  EXPECT_EQ(quartered(mesh).size(), 4 * mesh.size());
  EXPECT_NEAR(predicted_elements(scene, 0.1) / static_cast<double>(mesh.size()), 1, 0.2);
}

// Needles of all shapes and attitudes, from far below what coordinates resolve to far above, around the threshold above
// all.
TEST(Bisection, leaves_no_element_without_area_and_turns_none_over) {
  core::RandomNumbers random(6, 0, 0);
  int refused = 0, whole = 0;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Matrix3d turn = test::random_rotation(random);
    const double height = 0x1p-30 * std::pow(2.0, 14 * random.next()), apex = 0.1 + 0.8 * random.next();
    const auto at = [&](double x, double y) -> Vec3 { return Vec3(5e6, -5e6, 3e6) + turn * Vec3(x, y, 0); };
    const scene::Scene scene = of_facets({{at(0, 0), at(4, 0), at(4 * apex, height)}});
    try {
      const ElementMesh mesh = uniform(scene, 0.3), fine = quartered(mesh);
      whole += mesh.size() == 1;
      for (const auto& patch : fine.patches()) EXPECT_GT(patch.normal().dot(scene.facets[0].normal), 0) << height;
      EXPECT_EQ(predicted_elements(scene, 0.3) == 1, mesh.size() == 1);
    } catch (const core::InputError&) {
      ++refused;
      EXPECT_THROW(uniform(scene, 10), core::InputError) << "cutting must not be what makes it so: " << height;
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_GT(whole, 20);
  EXPECT_LT(refused + whole, 800);
}

// Three sheets along one edge, two sheets back to back, two facets that run along their edge in the same direction, a
// double facet, two tetrahedra that touch in a vertex and two that share an edge: none is a manifold.
TEST(Bisection, takes_surfaces_that_are_no_manifold_and_stays_conforming) {
  const Vec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const auto tetrahedron = [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) -> Triangles {
    return {{a, c, b}, {a, b, d}, {b, c, d}, {c, a, d}};
  };
  Triangles at_vertex = tetrahedron(o, x, y, z), at_edge = at_vertex;
  for (const auto& t : tetrahedron(o, -x, -y, -z)) at_vertex.push_back(t);
  for (const auto& t : tetrahedron(o, z, -x, -y)) at_edge.push_back(t);
  const std::vector<Triangles> cases{{{o, x, y}, {x, o, z}, {o, x, -y}},
                                     {{o, x, y}, {o, y, x}},
                                     {{o, x, y}, {o, x, z}},
                                     {{o, x, y}, {o, x, y}},
                                     at_vertex,
                                     at_edge};
  for (std::size_t c = 0; c < cases.size(); ++c) {
    const scene::Scene scene = of_facets(cases[c]);
    const ElementMesh mesh = uniform(scene, 0.2);
    EXPECT_NEAR(total_area(mesh), scene.area({0}), 1e-12) << "case " << c;
    EXPECT_LE(longest_edge(mesh), 0.2);
    // Conforming: no vertex lies inside an edge.
    const EdgeCensus census(mesh, mesh.parts()[0]);
    for (const auto& [edge, count] : census.edges) {
      const Vec3 a = census.position[edge.first], along = census.position[edge.second] - a;
      for (const Vec3& v : census.position) {
        const double t = along.dot(v - a) / along.squaredNorm();
        if (t > 1e-9 && t < 1 - 1e-9) {
          ASSERT_GT((a + t * along - v).norm(), 1e-9) << "case " << c;
        }
      }
    }
  }
}

TEST(Bisection, keeps_the_way_that_facets_look_where_neighbours_disagree) {
  const Triangles triangles{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)},
                            {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)}};
  const ElementMesh mesh = uniform(of_facets(triangles), 0.3);
  double up = 0, down = 0;
  for (const auto& patch : mesh.patches()) (patch.normal().z() > 0 ? up : down) += patch.area;
  EXPECT_NEAR(up, 0.5, 1e-13);
  EXPECT_NEAR(down, 0.5, 1e-13);
}

// Without ties the count is exact up to triangles 64 times as long as the edge, and near beyond.
TEST(Bisection, can_be_counted_without_being_made) {
  core::RandomNumbers random(5, 0, 0);
  const auto point = [&] { return Vec3(random.next(), random.next(), random.next()); };
  for (int i = 0; i < 30; ++i) {
    const scene::Scene scene = of_facets({{point(), point(), point()}});
    for (const double edge : {0.3, 0.1})
      EXPECT_EQ(bisected_count(scene.facets[0], edge), static_cast<double>(uniform(scene, edge).size()));
    if (i >= 5) continue;
    const double many = static_cast<double>(uniform(scene, 0.004).size());
    EXPECT_NEAR(bisected_count(scene.facets[0], 0.004), many, 0.2 * many);
  }
}
