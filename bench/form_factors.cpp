// Form factors by the analytic method, one thread: nanoseconds a pair at a tolerance of rows, in rooms with and without
// occluders.
//
//   bench_form_factors [TOLERANCE]        limits at 1e-4: 200 ns a pair unoccluded, 1 500 past two boxes, 5 000
//                                         past two spheres; two threads 1.8 times as fast as one
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <memory>

#include "core/random.h"
#include "core/run.h"
#include "core/seconds_since.h"
#include "fem/assembly.h"
#include "fem/row_errors.h"
#include "mesh/uniform.h"
#include "scene/builder.h"
#include "tests/support/shapes.h"

namespace {

using namespace interflect;
using geometry::Box;
using Facing = scene::SceneBuilder::Facing;

struct Case {
  const char* name;
  scene::Scene scene;
  double element_size, limit;  ///< [m], [ns a pair]
};

class Site {
 public:
  Site() { builder_.add_box("room", Box(Vec3(0, 0, 0), Vec3(5, 4, 3)), wall_, Facing::inward); }
  Site& body(const Vec3& low, const Vec3& high) {
    builder_.add_box("body", Box(low, high), wall_);
    return *this;
  }
  Site& sphere(const Vec3& centre, double radius) {
    auto triangles = test::icosphere(2, radius, false);
    for (auto& corners : triangles)
      for (Vec3& x : corners) x += centre;
    builder_.add_facets("sphere", triangles, wall_);
    return *this;
  }
  scene::Scene finish() { return builder_.finish(); }

 private:
  scene::SceneBuilder builder_{{"y"}};
  scene::MaterialId wall_ = builder_.add_material({"wall", Spectrum(0.5), Spectrum(1.0), scene::Sides::front});
};

class Ignore final : public fem::ExchangeSink {
 public:
  void add(Index, Index, const fem::ExchangeEntry&) override {}
};

/// Blocks of pairs anywhere in the matrix, up to `pairs` of them.
fem::PairCounts some_pairs(const fem::FormFactorMethod& method, std::span<const scene::SurfacePatch> patches,
                           double pairs, const Run& run) {
  constexpr Index block = 200;
  const Index room = static_cast<Index>(patches.size()) - block;
  Ignore sink;
  fem::PairCounts counts;
  core::RandomNumbers random(3, 0, 0);
  for (double done = 0; done < pairs; done += block * block) {
    auto row = static_cast<Index>(random.next() * static_cast<double>(room)),
         column = static_cast<Index>(random.next() * static_cast<double>(room));
    if (row > column) std::swap(row, column);
    counts += method.exchange({patches, row, block}, {patches, column, block}, sink, run);
  }
  return counts;
}

/// The largest error of a few whole rows.
double row_error(const fem::FormFactorMethod& method, std::span<const scene::SurfacePatch> patches, const Run& run) {
  std::vector<double> areas;
  for (const scene::SurfacePatch& patch : patches) areas.push_back(patch.area);
  Ignore sink;
  fem::RowErrors errors(sink, areas);
  core::RandomNumbers random(4, 0, 0);
  const auto n = static_cast<Index>(patches.size());
  double largest = 0;
  for (int k = 0; k < 20; ++k) {
    const auto a = static_cast<Index>(random.next() * static_cast<double>(n));
    errors.count_afresh(std::vector{a});
    method.exchange({patches, a, 1}, {patches, a + 1, n - a - 1}, errors, run);
    method.exchange({patches, 0, a}, {patches, a, 1}, errors, run);
    largest = std::max(largest, errors.of(a));
  }
  return largest;
}

/// False where it took longer than it may.
bool measure(const Case& c, double tolerance, const Run& run) {
  const mesh::ElementMesh mesh = mesh::uniform(c.scene, c.element_size);
  const auto rays = raycast::make_ray_caster("embree", c.scene);
  const double relative = fem::entry_tolerance(tolerance);
  const auto method = fem::make_form_factor_method("analytic", {c.scene, mesh.patches(), *rays, 1, relative});
  const auto start = std::chrono::steady_clock::now();
  const fem::PairCounts counts = some_pairs(*method, mesh.patches(), 4e6, run);
  const double seconds = core::seconds_since(start);
  const auto pairs = static_cast<double>(counts.facing_away + counts.clear + counts.subtracted);
  std::printf(
      "%-22s %6td elements, %.1f million pairs (%2.0f %% away, %2.0f %% clear, %2.0f %% in doubt, %.1f points each): "
      "%5.0f ns a pair, one thread "
      "(limit %.0f at 1e-4); largest row error of 20 %.1e\n",
      c.name, mesh.size(), 1e-6 * pairs, 100 * static_cast<double>(counts.facing_away) / pairs,
      100 * static_cast<double>(counts.clear) / pairs, 100 * static_cast<double>(counts.subtracted) / pairs,
      static_cast<double>(counts.points) / std::max(1.0, static_cast<double>(counts.subtracted)), 1e9 * seconds / pairs,
      c.limit, row_error(*method, mesh.patches(), run));
  return 1e9 * seconds / pairs <= c.limit;
}

/// Of the whole matrix, the best of three runs each, taken in turn; false where two are less than 1.8 times as fast as
/// one.
bool measure_threads(const Case& c, double tolerance) {
  const mesh::ElementMesh mesh = mesh::uniform(c.scene, 3 * c.element_size);
  const auto rays = raycast::make_ray_caster("embree", c.scene);
  const auto method =
      fem::make_form_factor_method("analytic", {c.scene, mesh.patches(), *rays, 1, fem::entry_tolerance(tolerance)});
  core::LocalRun one(1, 1), two(1, 2);
  Ignore sink;
  const auto seconds = [&](Run& run) {
    const auto start = std::chrono::steady_clock::now();
    fem::assemble(*method, mesh.patches(), sink, run);
    return core::seconds_since(start);
  };
  double of_one = seconds(one), of_two = seconds(two);
  for (int k = 0; k < 2; ++k) of_one = std::min(of_one, seconds(one)), of_two = std::min(of_two, seconds(two));
  std::printf("%-22s %6td elements: one thread %.2f s, two %.2f s, %.2f times as fast (limit 1.8)\n", c.name,
              mesh.size(), of_one, of_two, of_one / of_two);
  return of_one / of_two >= 1.8;
}

}  // namespace

int main(int argc, char** argv) {
  const double tolerance = argc > 1 ? std::atof(argv[1]) : 1e-4;
  core::LocalRun run(1, 1);
  std::printf("rows to %.0e\n", tolerance);
  const Case boxes{"room with two boxes",
                   Site().body({1, 1, 0}, {2, 1.8, 1.2}).body({3, 2.2, .5}, {4, 3, 1.6}).finish(), 0.11, 1500};
  const bool fast[] = {
      measure({"empty room", Site().finish(), 0.11, 200}, tolerance, run.get()), measure(boxes, tolerance, run.get()),
      measure(
          {"room with two spheres", Site().sphere({1.6, 1.5, 1}, .7).sphere({3.4, 2.4, 1.5}, .8).finish(), 0.11, 5000},
          tolerance, run.get()),
      measure_threads(boxes, tolerance)};
  return std::all_of(std::begin(fast), std::end(fast), [](bool it_is) { return it_is; }) ? 0 : 1;
}
