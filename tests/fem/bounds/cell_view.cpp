#include "fem/bounds/cell_view.h"

#include <gtest/gtest.h>

#include "fem/point_view_factors.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

using test::Room;

/// A closed room with two bodies, one on the floor.
struct Furnished {
  Furnished() {
    Room room;
    room.box(Vec3(0, 0, 0), Vec3(2, 1.5, 1), 3);
    room.box(Vec3(.4, .3, .2), Vec3(.5, .4, .3), 2, false);
    room.box(Vec3(1.3, .8, 0), Vec3(.3, .3, .5), 1, false);
    scene = room.finish();
    patches = room.patches;
  }
  scene::Scene scene;
  std::vector<scene::SurfacePatch> patches;
};

// What is seen of each element, past all that hides, is between the sums of its parts' bounds wherever in the cell one
// looks from; and the bounds of all elements hold 1 between them.
TEST(CellView, holds_what_is_seen_of_every_element) {
  const Furnished room;
  const Surroundings around(room.scene, room.patches, true);
  const PointViewFactors factors(room.scene, room.patches);
  std::vector<double> F(room.patches.size()), error(room.patches.size());
  for (std::size_t i = 0; i < room.patches.size(); i += 3)
    for (const bool finer : {false, true}) {
      const scene::SurfacePatch& patch = room.patches[i];
      const Cell cell = around.cell(patch.ring());
      CellView view(around, cell);
      if (finer) view.refine([](const PartSeen&) { return 1.0; }, .01, 200);
      std::vector<double> least(F.size()), most(F.size());
      double all_least = 0, all_most = 0;
      for (const auto parts : {view.far(), view.near()})
        for (const PartSeen& part : parts) {
          least[static_cast<std::size_t>(part.element)] += part.factor.least;
          most[static_cast<std::size_t>(part.element)] += part.factor.most;
          all_least += part.factor.least;
          all_most += part.factor.most;
        }
      EXPECT_LE(all_least, 1 + 1e-12);
      EXPECT_GE(all_most, 1 - 1e-12);
      for (const double u : {.02, .37, .5, .98})
        for (const double v : {.03, .6, .97}) {
          const Vec3 x = point_on(patch.ring(), u, v);
          factors({x, patch.normal(), patch.surface}, F, error);
          for (std::size_t j = 0; j < F.size(); ++j) {
            EXPECT_LE(F[j], most[j] + 1e-9) << i << ' ' << j;
            EXPECT_GE(F[j], least[j] - 1e-9) << i << ' ' << j;
          }
        }
    }
}

// Cutting says more, never less.
TEST(CellView, knows_more_of_smaller_parts) {
  const Furnished room;
  const Surroundings around(room.scene, room.patches, true);
  const Cell cell = around.cell(room.patches[4].ring());
  double before = 1e9;
  for (const std::size_t cuts : {0u, 10u, 100u, 1000u}) {
    CellView view(around, cell);
    view.refine([](const PartSeen&) { return 1.0; }, 0, cuts);
    double doubt = 0;
    for (const PartSeen& part : view.near()) doubt += part.factor.most - part.factor.least;
    EXPECT_LE(doubt, before * 1.02) << cuts;  // parts that touch the cell have no less than all of them had
    before = doubt;
  }
}

}  // namespace
}  // namespace interflect::fem
