#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fem/radiosity_operator.h"
#include "fem/space/space.h"
#include "mesh/uniform.h"
#include "tests/fem/bounds/random_room.h"
#include "tests/fem/space/displayed.h"
#include "tests/fem/space/polynomial_settings.h"
#include "tests/fem/space/returned.h"

// In space what smooth_in_flatland.cpp has in flatland: of a radiosity that is a polynomial of degree p + 1 on each
// surface, one more than elements of order p have, past a body.  On parallelograms cut into four ||B - P B|| is a
// constant times h^(p + 1) at once, on other quads nearly so; what is seen of B_h - P B comes on top.
namespace interflect::fem {
namespace {

using solvers::ColumnMatrix;
using test::SurfaceRadiosity;
using Solution = std::vector<SurfaceRadiosity>;  ///< by surface

/// A scene with its faces cut into four, again and again, and what arrives there of such radiosities.
class Refined {
 public:
  Refined(const scene::Scene& scene, std::vector<Solution> b, int cuts)
      : scene_(scene), b_(std::move(b)), seen_(scene) {
    meshes_.push_back(mesh::whole_faces(scene));
    for (int k = 0; k < cuts; ++k) meshes_.push_back(mesh::quartered(meshes_.back()));
    const auto patches = meshes_.back().patches();
    const int cells = 8 >> cuts;
    arriving_.push_back(test::Load(seen_, patches, b_).on_cells(2, 2 * cells));
    for (int k = cuts; k-- > 0;)
      arriving_.insert(arriving_.begin(), of_wholes(meshes_[std::size_t(k)], arriving_.front()));
  }

  struct Distances {
    double solved, displayed;  ///< of B_h, and of it made continuous, from B
  };
  /// Of the solution of an order about the radiosity of that number, on elements cut so often.
  Distances distances(std::size_t which, int order, std::size_t cuts, Run& run) const {
    const mesh::ElementMesh& mesh = meshes_[cuts];
    const auto patches = mesh.patches();
    const auto rays = raycast::make_ray_caster("embree", scene_);
    const RadiosityOperator from =
        assemble_operator(scene_, patches, *rays, test::polynomial_settings(order, 1, 1e-3), run);
    const Index f = plane_functions(order);
    ColumnMatrix e(mesh.size() * f, 1), rho(e.rows(), 1);
    for (Index i = 0; i < mesh.size(); ++i) {
      const double reflected = scene_.material(patches[std::size_t(i)].surface).reflectance[0];
      rho.middleRows(i * f, f).setConstant(reflected);
      e.middleRows(i * f, f) = best(which, patches[std::size_t(i)]).head(f) -
                               reflected * arriving_[cuts].block(i * test::most_functions, Index(which), f, 1);
    }
    const SymmetricOperator& K = order > 0 ? *from.blocks : *from.K;
    return distances(which, order, mesh, test::solved(K, rho, e, run));
  }

 private:
  double exact(std::size_t which, const scene::SurfacePatch& patch, const Vec3& x) const {
    return seen_.value(b_[which][patch.surface.value], patch.surface, x);
  }
  /// Coefficients of all functions.
  Eigen::VectorXd best(std::size_t which, const scene::SurfacePatch& patch) const {
    const PlaneBasis basis(test::highest, patch.ring(), patch.normal());
    Eigen::VectorXd c = Eigen::VectorXd::Zero(basis.size());
    for (const SurfaceNode& node : nodes_of(patch))
      c += node.weight / patch.area * exact(which, patch, node.position) * basis.at(node.position);
    return c;
  }
  static std::vector<SurfaceNode> nodes_of(const scene::SurfacePatch& patch) {
    std::vector<SurfaceNode> nodes;
    append_nodes(patch.ring(), rules_of(4).of(patch.corners), nodes);
    return nodes;
  }
  /// Means over elements by those over their quarters, whose functions theirs are sums of.
  static ColumnMatrix of_wholes(const mesh::ElementMesh& wholes, const ColumnMatrix& of_quarters) {
    constexpr Index f = test::most_functions;
    ColumnMatrix out = ColumnMatrix::Zero(wholes.size() * f, of_quarters.cols());
    for (Index i = 0; i < wholes.size(); ++i)
      for (Index k = 0; k < 4; ++k) {
        const scene::SurfacePatch& patch = wholes.patches()[std::size_t(i)];
        const double share = scene::quarters_of(patch)[std::size_t(k)].area / patch.area;
        out.middleRows(i * f, f) += share * restriction(test::highest, patch.ring(), std::size_t(k)) *
                                    of_quarters.middleRows((4 * i + k) * f, f);
      }
    return out;
  }
  Distances distances(std::size_t which, int order, const mesh::ElementMesh& mesh, const ColumnMatrix& c) const {
    const Index f = plane_functions(order);
    std::vector<PlaneBasis> bases;
    for (const scene::SurfacePatch& patch : mesh.patches()) bases.emplace_back(order, patch.ring(), patch.normal());
    const auto B_h = [&](std::uint32_t i, const Vec3& x) {
      return bases[i].at(x).dot(c.col(0).segment(Index(i) * f, f));
    };
    double sum = 0;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i)
      for (const SurfaceNode& node : nodes_of(mesh.patches()[i])) {
        const double off = B_h(i, node.position) - exact(which, mesh.patches()[i], node.position);
        sum += node.weight * off * off;
      }
    return {std::sqrt(sum), test::displayed_distance(mesh, B_h, [&](std::uint32_t i, const Vec3& x) {
              return exact(which, mesh.patches()[i], x);
            })};
  }

  const scene::Scene& scene_;
  std::vector<Solution> b_;
  test::SeenRadiosity seen_;
  std::vector<mesh::ElementMesh> meshes_;
  std::vector<ColumnMatrix> arriving_;  ///< of each mesh: of all functions, of each radiosity
};

// At elements as large as faces, half and a quarter as long.  What is displayed is not farther from B: means over the
// elements of a corner or an edge take from their errors, and the middles of elements have them still.
TEST(SmoothSolution, has_its_order_past_a_body_and_so_has_what_is_displayed) {
  test::Random random(3);
  const scene::Scene scene = test::random_room(random);
  std::vector<Solution> b;
  for (int order = 0; order <= test::highest; ++order)
    for (SurfaceRadiosity& of_surface : b.emplace_back(scene.surfaces.size()))
      for (int k = 0; k < plane_functions(order + 1); ++k)
        of_surface.c[std::size_t(k)] = (k == 0 ? 1 : 0) + test::between(-.5, .5, random);
  core::LocalRun run(1, 2);
  const Refined refined(scene, b, 2);
  for (const int order : {0, 1, 2}) {
    Refined::Distances before{};
    for (std::size_t cuts = 0; cuts <= 2; ++cuts) {
      const Refined::Distances now = refined.distances(std::size_t(order), order, cuts, run.get());
      EXPECT_LE(now.displayed, (1 + 1e-12) * now.solved) << order << ' ' << cuts;
      if (cuts > 0) {
        EXPECT_NEAR(std::log2(before.solved / now.solved), order + 1, .05) << order << ' ' << cuts;
        EXPECT_GT(std::log2(before.displayed / now.displayed), order + 1 - .05) << order << ' ' << cuts;
      }
      before = now;
    }
  }
}

}  // namespace
}  // namespace interflect::fem
