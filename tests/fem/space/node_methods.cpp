#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/interval.h"
#include "fem/continuous.h"
#include "fem/node_radiosity.h"
#include "fem/radiosity_operator.h"
#include "mesh/uniform.h"
#include "tests/fem/rooms.h"

// Continuous elements, and collocation at Gauss points, corners and centroids, in space.
namespace interflect::fem {
namespace {

using test::Room;

/// A triangle and a parallelogram, far apart, and cut so that corners hang, twice over.
mesh::ElementMesh hanging() {
  Room room;
  room.triangle({0, 0, 0}, {3, 0, 1}, {0, 2, 0});
  room.wall({5, 0, 0}, {2, 0, 0}, {1, 3, 0}, 1);
  const scene::Scene scene = room.finish();
  mesh::ElementMesh mesh = mesh::uniform(scene, 2);
  for (const Vec3& towards : {Vec3(0, 0, 0), Vec3(5, 0, 0), Vec3(0, 0, 0), Vec3(5, 0, 0)}) {
    std::vector<bool> which;
    for (const scene::SurfacePatch& patch : mesh.patches()) {
      bool here = false;
      for (const Vec3& corner : patch.ring()) here = here || (corner - towards).norm() < 1e-9;
      which.push_back(here);
    }
    mesh = mesh::quartered(mesh, which).mesh;
  }
  return mesh;
}

double linear(const Vec3& x) { return .3 + .2 * x.x() - .5 * x.y() + .1 * x.z(); }

// What is linear stays what it is, though corners hang: values at the corners that do not make it.
TEST(CornerNodes, hold_linear_functions) {
  const mesh::ElementMesh mesh = hanging();
  for (const int order : {1, 2}) {
    const Space space = space_on(mesh.patches(), order);
    const NodeSet nodes = corner_nodes(space, mesh);
    std::size_t corners = 0;
    for (const scene::SurfacePatch& patch : mesh.patches()) corners += patch.corners;
    EXPECT_LT(nodes.position.size(), corners);
    Eigen::VectorXd values(nodes.size());
    for (Index k = 0; k < nodes.size(); ++k) values[k] = linear(nodes.position[std::size_t(k)]);
    EXPECT_LT(space.distance(
                  nodes.P * values, [](Index, const Vec3& x) { return linear(x); }, 4),
              1e-4)
        << order;
    EXPECT_LT(space.distance(
                  nodes.P * Eigen::VectorXd::Ones(nodes.size()), [](Index, const Vec3&) { return 1; }, 4),
              1e-13);
  }
}

// Any values make a field without jumps: at each point that is on the edges of several elements all say the same.
TEST(CornerNodes, make_continuous_fields) {
  const mesh::ElementMesh mesh = hanging();
  const Space space = space_on(mesh.patches(), 2);
  const NodeSet nodes = corner_nodes(space, mesh);
  Eigen::VectorXd values(nodes.size());
  for (Index k = 0; k < nodes.size(); ++k) values[k] = std::sin(double(k * k));
  const Eigen::VectorXd c = nodes.P * values;
  int met = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    const auto ring = space.panel(i).ring();
    for (std::size_t k = 0; k < ring.size(); ++k)
      for (const double t : {0., .2, .5, .8}) {
        const Vec3 x = (1 - t) * ring[k] + t * ring[(k + 1) % ring.size()];
        for (Index j = 0; j < mesh.size(); ++j) {
          const auto& patch = mesh.patches()[std::size_t(j)];
          if (j == i || patch.surface != mesh.patches()[std::size_t(i)].surface) continue;
          const mesh::ElementPoint at = mesh::coordinates_in(patch, mesh::ElementId{std::uint32_t(j)}, x);
          if ((point_on(patch.ring(), at.u, at.v) - x).norm() > 1e-12) continue;
          const mesh::ElementPoint own =
              mesh::coordinates_in(mesh.patches()[std::size_t(i)], mesh::ElementId{std::uint32_t(i)}, x);
          EXPECT_NEAR(space.value(c, i, own.u, own.v), space.value(c, j, at.u, at.v), 1e-10) << i << ' ' << j;
          ++met;
        }
      }
  }
  EXPECT_GT(met, 50);
}

// A surface that shines on another, at a distance: all is smooth, and orders are those of flatland.
class Facing {
 public:
  explicit Facing(int n) : n_(n) {
    Room room;
    room.wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, .8, 1);
    room.wall({.2, 0, .6}, {0, 1.1, .2}, {.9, 0, 0}, 1, .7);
    scene_ = std::make_unique<scene::Scene>(room.finish());
  }

  RadiositySolution solve(Projection projection, int order) const {
    RadiositySettings settings;
    settings.order = order;
    settings.projection = projection;
    settings.form_factors = "analytic";
    settings.quadrature_tolerance = 1e-9;
    settings.element_size = 1.15 / n_;
    settings.solver = "jacobi";
    settings.stopping = {1e-13, 1000};
    core::LocalRun run(1, 2);
    return solve_radiosity(*scene_, settings, run.get());
  }

 private:
  int n_;
  std::unique_ptr<scene::Scene> scene_;
};

/// Root mean square over Gauss nodes of all elements, and of the mean.
struct Errors {
  double L2, functional;
};
double at(const RadiositySolution& s, std::size_t element, const Vec3& x) {
  return s.field ? s.field->at(element, x)[0] : s.radiosity[element][0];
}
double mean(const RadiositySolution& s) {
  double sum = 0, area = 0;
  for (std::size_t i = 0; i < s.radiosity.size(); ++i) {
    sum += s.mesh.patches()[i].area * s.radiosity[i][0];
    area += s.mesh.patches()[i].area;
  }
  return sum / area;
}
Errors difference(const RadiositySolution& s, const RadiositySolution& truth) {
  double squares = 0, area = 0;
  for (std::size_t i = 0; i < s.mesh.patches().size(); ++i) {
    const scene::SurfacePatch& patch = s.mesh.patches()[i];
    std::vector<SurfaceNode> nodes;
    append_nodes(patch.ring(), rules_of(4).of(patch.corners), nodes);
    for (const SurfaceNode& node : nodes) {
      const auto there = truth.mesh.locate({patch.surface, patch.side, 0, Vec2::Zero(), node.position, patch.normal()});
      const double d = at(s, i, node.position) - at(truth, there->element.value, node.position);
      squares += node.weight * d * d;
      area += node.weight;
    }
  }
  return {std::sqrt(squares / area), std::abs(mean(s) - mean(truth))};
}

TEST(NodeMethods, have_the_orders_of_their_functions) {
  const RadiositySolution truth = Facing(10).solve(Projection::galerkin, 3);
  struct Case {
    Projection projection;
    int order;
    double L2, functional;
  };
  for (const Case& c : {Case{Projection::centroids, 0, 1, 2}, Case{Projection::gauss_points, 1, 2, 4},
                        Case{Projection::gauss_points, 2, 3, 6}, Case{Projection::continuous, 1, 2, 4},
                        Case{Projection::vertices, 1, 2, 2}}) {
    const Errors coarse = difference(Facing(4).solve(c.projection, c.order), truth),
                 fine = difference(Facing(8).solve(c.projection, c.order), truth);
    const std::string name = name_of(c.projection) + " " + std::to_string(c.order);
    EXPECT_NEAR(std::log2(coarse.L2 / fine.L2), c.L2, .1) << name;
    if (c.functional < 6) {
      EXPECT_NEAR(std::log2(coarse.functional / fine.functional), c.functional, .15) << name;
    } else {
      EXPECT_LT(fine.functional, 1e-9) << name;  // what form factors are known to
    }
  }
}

/// A room with a body in it, of walls that differ.
scene::Scene furnished(double rho, double exitance) {
  Room room;
  room.box({0, 0, 0}, {2, 3, 1.2}, 1, true, rho, exitance);
  room.box({.7, .5, .3}, {.5, .8, .4}, 1, false, rho, exitance);
  return room.finish();
}

// What emits 1 - rho everywhere in a closed room has radiosity 1, by every projection; those at nodes know what hides
// point by point, to rounding.
TEST(NodeMethods, of_a_furnace_are_1_everywhere) {
  const scene::Scene scene = furnished(.6, .4);
  for (const Projection projection :
       {Projection::centroids, Projection::gauss_points, Projection::continuous, Projection::vertices}) {
    RadiositySettings settings;
    settings.order = projection == Projection::centroids ? 0 : 1;
    settings.projection = projection;
    settings.form_factors = "analytic";
    settings.element_size = 1.5;
    settings.quadrature_tolerance = 1e-4;
    core::LocalRun run(1, 2);
    const RadiositySolution s = solve_radiosity(scene, settings, run.get());
    const double accuracy = projection == Projection::continuous ? 1e-3 : 1e-8;
    for (std::size_t i = 0; i < s.radiosity.size(); ++i)
      for (const Vec3& corner : s.mesh.patches()[i].ring())
        EXPECT_NEAR(at(s, i, corner), 1, accuracy) << name_of(projection);
  }
}

// Two methods that share no step beyond elements agree on a room with a body: mean irradiances, within what is stated.
TEST(NodeMethods, agree_within_what_they_state) {
  Room room;
  room.box({0, 0, 0}, {2, 3, 1.2}, 1, true, .5);
  room.wall({.5, .5, 1.1}, {0, .5, 0}, {.5, 0, 0}, 1, 0, 5);
  room.box({.7, .5, .3}, {.5, .8, .4}, 1, false, .5);
  const scene::Scene scene = room.finish();
  const auto mean = [&](Projection projection) {
    RadiositySettings settings;
    settings.order = projection == Projection::centroids ? 0 : 1;
    settings.projection = projection;
    settings.form_factors = "analytic";
    settings.element_size = .8;
    core::LocalRun run(1, 2);
    const RadiositySolution s = solve_radiosity(scene, settings, run.get());
    Spectrum H, error;
    double area = 0;
    for (std::size_t i = 0; i < s.radiosity.size(); ++i) {
      H += s.mesh.patches()[i].area * s.irradiance[i];
      error += s.mesh.patches()[i].area * s.irradiance_error[i];
      area += s.mesh.patches()[i].area;
    }
    return Interval{(H - error) / area, (H + error) / area};
  };
  const Interval truth = mean(Projection::galerkin);
  for (const Projection projection :
       {Projection::centroids, Projection::gauss_points, Projection::continuous, Projection::vertices}) {
    const Interval other = mean(projection);
    EXPECT_LT(truth.lower[0], other.upper[0]) << name_of(projection);
    EXPECT_LT(other.lower[0], truth.upper[0]) << name_of(projection);
    EXPECT_LT(other.upper[0] - other.lower[0], .4 * other.upper[0]) << name_of(projection);
  }
}

// Whoever is told what fits is told of the operator between nodes too.
TEST(NodeMethods, count_their_memory) {
  const scene::Scene scene = furnished(.6, .4);
  core::LocalRun run(1, 2);
  const auto bytes = [&](Projection projection) {
    RadiositySettings settings;
    settings.form_factors = "analytic";
    settings.order = 1;
    settings.element_size = .2;
    settings.projection = projection;
    return forecast(scene, settings, run.get()).bytes;
  };
  const double galerkin = bytes(Projection::galerkin), elements = 4 * double(mesh::uniform(scene, .4).size());
  EXPECT_NEAR(bytes(Projection::gauss_points) - galerkin, 8 * std::pow(4 * elements, 2), .3 * galerkin);
  EXPECT_GT(bytes(Projection::continuous), 3 * galerkin);  // of order 2
  RadiositySettings settings;
  settings.form_factors = "analytic";
  settings.order = 1;
  settings.element_size = .2;
  settings.projection = Projection::gauss_points;
  settings.max_memory = 1.2 * galerkin;
  EXPECT_THROW(forecast(scene, settings, run.get()), core::InputError);
}

TEST(NodeMethods, refuse_what_they_cannot_have) {
  const scene::Scene scene = furnished(.6, .4);
  const auto with = [&](Projection projection, int order) {
    RadiositySettings settings;
    settings.projection = projection;
    settings.order = order;
    settings.form_factors = "analytic";
    return settings;
  };
  EXPECT_THROW(require_compatible(with(Projection::centroids, 1)), core::InputError);
  EXPECT_THROW(require_compatible(with(Projection::continuous, 2)), core::InputError);
  EXPECT_THROW(require_compatible(with(Projection::vertices, 0)), core::InputError);
  RadiositySettings repaired = with(Projection::centroids, 0);
  repaired.closure = "scaling";
  EXPECT_THROW(require_compatible(repaired), core::InputError);
  EXPECT_THROW(projection_named("edges"), core::InputError);
  for (const std::string& name : projection_names()) EXPECT_EQ(name_of(projection_named(name)), name);
}

// Before any form factor is computed.
TEST(NodeMethods, refuse_solvers_that_want_a_symmetric_matrix) {
  for (const char* solver : {"conjugate-gradients", "southwell", "progressive"}) {
    RadiositySettings settings;
    settings.projection = Projection::centroids;
    settings.form_factors = "analytic";
    settings.solver = solver;
    EXPECT_THROW(require_compatible(settings), core::InputError) << solver;
    settings.solver = "gmres";
    EXPECT_NO_THROW(require_compatible(settings));
  }
}

// A chequerboard of values at the corners of squares has a projection onto linear functions of 0: it cannot be told
// from none.
TEST(NodeMethods, refuse_corners_that_depend_on_each_other) {
  Room room;
  room.wall({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, .5, 1);
  room.wall({0, 0, 1}, {0, 1, 0}, {1, 0, 0}, 1, .5);
  const scene::Scene scene = room.finish();
  const auto rays = raycast::make_ray_caster("embree", scene);
  const mesh::ElementMesh mesh = mesh::uniform(scene, .3);
  core::LocalRun run(1, 2);
  for (const int order : {1, 2}) {
    RadiositySettings settings;
    settings.order = order;
    settings.form_factors = "analytic";
    const RadiosityOperator from = assemble_operator(scene, mesh.patches(), *rays, settings, run.get());
    const NodeSet nodes = corner_nodes(space_on(mesh.patches(), order), mesh);
    if (order == 1) {
      EXPECT_THROW(continuous_galerkin(*from.blocks, nodes, run.get()), core::PreconditionError);
    } else {
      EXPECT_NO_THROW(continuous_galerkin(*from.blocks, nodes, run.get()));
    }
  }
}

}  // namespace
}  // namespace interflect::fem
