// Solvers that sample against the rays that they cast: rays a second as a fraction of a bare Embree loop over the same
// rays in the same order, one thread, rounds interleaved, medians; then what a second thread brings.
//
//   bench_ray_solvers [scene.json] [element size]      default: the office, 0.3
#include <cstdio>
#include <cstdlib>
#include <string>

#include "bench/bare_embree.h"
#include "core/sample_sequence.h"
#include "fem/columns.h"
#include "fem/element_materials.h"
#include "fem/operator/dense_symmetric.h"
#include "fem/ray_transitions.h"
#include "mesh/uniform.h"
#include "scene/reader.h"
#include "solvers/power_transfer.h"

namespace {

using namespace interflect;

constexpr std::uint64_t rays = 400000, of_a_solve = 4000000;  ///< the latter leave some 3 % of noise in the office
constexpr int rounds = 7;

struct Problem {
  explicit Problem(const scene::Scene& scene, double size) : mesh(mesh::uniform(scene, size)) {
    const auto of = fem::materials_of(scene, mesh.patches());
    e = fem::to_columns(of.exitance, scene.channel_count());
    rho = fem::to_columns(of.reflectance, scene.channel_count());
    std::vector<double> areas;
    for (const scene::SurfacePatch& patch : mesh.patches()) areas.push_back(patch.area);
    K.emplace(areas);
    R.emplace(rho);
  }
  mesh::ElementMesh mesh;
  solvers::ColumnMatrix e, rho;
  std::optional<fem::DenseSymmetric> K;  ///< empty: its areas alone are looked at
  std::optional<solvers::Reflection> R;
};

void compare_with_bare_embree(const scene::Scene& scene, const Problem& problem) {
  const auto caster = raycast::make_ray_caster("embree", scene);
  const bench::Recorder recorder(*caster);
  const auto sequence = core::make_sequence("independent", 1);
  const solvers::ColumnMatrix power = solvers::power_of(problem.K->gram(), problem.e + problem.rho);
  solvers::ColumnMatrix reflected = solvers::ColumnMatrix::Zero(power.rows(), power.cols());
  const auto bounce = [&](const raycast::RayCaster& with) {
    const fem::RayTransitions transitions(problem.mesh.patches(), with);
    const solvers::System system{*problem.K, *problem.R, problem.e, &transitions};
    const solvers::PowerTransfer transfer(system, power);
    return bench::seconds([&] { transfer.add(*sequence, 0, rays, 1, reflected); });
  };
  bounce(recorder);
  const bench::BareEmbree bare(scene, recorder, caster->offset());
  std::size_t hits = 0;
  std::vector<double> ours, theirs;
  for (int round = 0; round < rounds; ++round) {
    ours.push_back(bounce(*caster));
    theirs.push_back(bench::seconds([&] { hits += bare.in_order(); }));
  }
  std::printf("one bounce by %.1f M rays: %.2f M rays/s = %.0f %% of bare Embree's %.2f M rays/s  (%zu hits)\n",
              1e-6 * rays, 1e-6 * rays / bench::median(ours), 100 * bench::median(theirs) / bench::median(ours),
              1e-6 * rays / bench::median(theirs), hits);
}

/// A whole solver, one thread: its rays are those that it asks for in a run before.
void compare_solver_with_bare_embree(const scene::Scene& scene, const Problem& problem, const char* name) {
  const auto caster = raycast::make_ray_caster("embree", scene);
  const bench::Recorder recorder(*caster);
  const auto solve = [&](const raycast::RayCaster& with, unsigned threads) {
    const fem::RayTransitions transitions(problem.mesh.patches(), with);
    const solvers::System system{*problem.K, *problem.R, problem.e, &transitions};
    core::LocalRun run(1, threads);
    solvers::SolverState state{system.e};
    solvers::StoppingRule rule;
    rule.samples = of_a_solve;
    const auto solver = solvers::make_solver(name);
    return bench::seconds([&] { solver->advance(system, state, rule, run.get()); });
  };
  solve(recorder, 1);
  const bench::BareEmbree bare(scene, recorder, caster->offset());
  std::size_t hits = 0;
  std::vector<double> one, two, theirs;
  for (int round = 0; round < rounds; ++round) {
    one.push_back(solve(*caster, 1));
    theirs.push_back(bench::seconds([&] { hits += bare.in_order(); }));
    two.push_back(solve(*caster, 2));
  }
  const double million = 1e-6 * static_cast<double>(bare.rays());
  std::printf(
      "%-28s %.2f M rays: %.2f M rays/s = %.0f %% of bare Embree's %.2f M rays/s; two threads %.2f times one  (%zu "
      "hits)\n",
      name, million, million / bench::median(one), 100 * bench::median(theirs) / bench::median(one),
      million / bench::median(theirs), bench::median(one) / bench::median(two), hits);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string file = argc > 1 ? argv[1] : INTERFLECT_SOURCE_DIR "/data/scenes/office.json";
  const scene::Scene scene = scene::read_scene(file);
  const Problem problem(scene, argc > 2 ? std::atof(argv[2]) : 0.3);
  std::printf("%s, %td elements\n", file.c_str(), problem.mesh.size());
  compare_with_bare_embree(scene, problem);
  for (const char* name :
       {"stochastic-jacobi", "regular-stochastic-jacobi", "shooting-collision", "gathering-collision"})
    compare_solver_with_bare_embree(scene, problem, name);
}
