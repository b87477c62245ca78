#include <gtest/gtest.h>

#include "core/random.h"
#include "fem/assembly.h"
#include "fem/operator/dense_symmetric.h"
#include "tests/fem/rooms.h"

namespace interflect::fem {
namespace {

using test::Room;

/// A box of unequal walls, with or without a few triangles at random inside it that hide and have no elements.
struct Scenes {
  explicit Scenes(std::uint64_t seed) {
    Room empty, with_screens;
    for (Room* room : {&empty, &with_screens}) room->box({0, 0, 0}, {1, 2, 0.7}, 2);
    core::RandomNumbers random(seed, 0, 0);
    const auto anywhere = [&] {
      return Vec3(0.1 + 0.8 * random.next(), 0.2 + 1.6 * random.next(), 0.1 + 0.5 * random.next());
    };
    for (int k = 0; k < 3; ++k) {
      const Vec3 corner = anywhere(), other = anywhere(), third = anywhere();
      with_screens.screen(corner, 0.4 * (other - corner), 0.4 * (third - corner));
    }
    patches = empty.patches;
    open = std::make_unique<scene::Scene>(empty.finish());
    hidden = std::make_unique<scene::Scene>(with_screens.finish());
  }
  std::vector<scene::SurfacePatch> patches;
  std::unique_ptr<scene::Scene> open, hidden;
};

std::vector<double> areas_of(std::span<const scene::SurfacePatch> patches) {
  std::vector<double> areas;
  for (const auto& patch : patches) areas.push_back(patch.area);
  return areas;
}

/// Entries with what is stated of their errors, 5 standard errors of what was sampled.
class Stated final : public ExchangeSink {
 public:
  explicit Stated(std::span<const scene::SurfacePatch> patches)
      : K(areas_of(patches)), error(Eigen::MatrixXd::Zero(K.size(), K.size())) {}
  void add(Index a, Index b, const ExchangeEntry& entry) override {
    K.add(a, b, entry);
    error(a, b) = error(b, a) = entry.bound + 5 * entry.standard_error;
    smallest = std::min({smallest, entry.K, entry.bound, entry.standard_error});
  }
  DenseSymmetric K;
  Eigen::MatrixXd error;
  double smallest = 0;
};

std::unique_ptr<const Stated> stated(const std::string& method, const scene::Scene& scene,
                                     std::span<const scene::SurfacePatch> patches) {
  const auto rays = raycast::make_ray_caster("embree", scene);
  FormFactorContext context{scene, patches, *rays, 3, 1e-2};
  context.resolution = 64;
  core::LocalRun run(3, 1);  // one thread: the sink of this test is not made for more
  auto entries = std::make_unique<Stated>(patches);
  assemble(*make_form_factor_method(method, context), patches, *entries, run);
  return entries;
}

class FormFactorBounds : public testing::TestWithParam<std::string> {};

// 0 <= F <= 1, A_i F_ij <= min(A_i, A_j), exactly, and K symmetric exactly (there is one number a pair): whatever the
// method errs by.
TEST_P(FormFactorBounds, hold_exactly_in_random_scenes) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Scenes scenes(seed);
    const auto entries = stated(GetParam(), *scenes.hidden, scenes.patches);
    EXPECT_GE(entries->smallest, 0);
    for (Index a = 0; a < entries->K.size(); ++a)
      for (Index b = 0; b < entries->K.size(); ++b) {
        const double K = entries->K.entry(a, b), of_a = entries->K.gram()[static_cast<std::size_t>(a)],
                     of_b = entries->K.gram()[static_cast<std::size_t>(b)];
        EXPECT_GE(K, 0);
        EXPECT_LE(K, std::min(of_a, of_b));
        EXPECT_EQ(K, entries->K.entry(b, a));
      }
  }
}

// What hides cannot add light: not beyond what is stated of the errors of both.
TEST_P(FormFactorBounds, occluded_is_at_most_unoccluded) {
  double least_ratio = 1;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Scenes scenes(seed);
    const auto hidden = stated(GetParam(), *scenes.hidden, scenes.patches),
               open = stated(GetParam(), *scenes.open, scenes.patches);
    for (Index a = 0; a < hidden->K.size(); ++a)
      for (Index b = a + 1; b < hidden->K.size(); ++b) {
        EXPECT_LE(hidden->K.entry(a, b), open->K.entry(a, b) + hidden->error(a, b) + open->error(a, b) + 1e-15)
            << seed << ": " << a << ", " << b;
        if (open->K.entry(a, b) > 0) least_ratio = std::min(least_ratio, hidden->K.entry(a, b) / open->K.entry(a, b));
      }
  }
  EXPECT_LT(least_ratio, 0.5) << "nothing was hidden, nothing was tested";
}

std::string as_test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Methods, FormFactorBounds, testing::ValuesIn(form_factor_names()), as_test_name);

// Without an error the matrix alone: 4 N² bytes and the parts of tiles that are not needed.
TEST(DenseSymmetric, takes_at_most_4_2_bytes_times_N_squared) {
  for (const Index n : {3000, 5000}) {
    const DenseSymmetric K(std::vector<double>(static_cast<std::size_t>(n), 1.0));
    EXPECT_LE(K.bytes(), 4.2 * static_cast<double>(n * n)) << n;
  }
}

}  // namespace
}  // namespace interflect::fem
