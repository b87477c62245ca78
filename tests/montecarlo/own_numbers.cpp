#include <array>
#include <cmath>

#include "montecarlo/integrators.h"
#include "montecarlo/render.h"
#include "tests/montecarlo/rooms.h"

// That integrators which follow paths from the eye draw no numbers of each other's, with the same seed: or else the error of their difference would not be
// that of independent ones, as `compare` takes it.  Of n places that are all the same the correlation r of what two
// integrators find is then normal, of standard error n^-1/2.
namespace interflect::montecarlo {
namespace {

constexpr std::size_t places = 256;
const std::array<std::string, 4> names{"path", "unidirectional", "bidirectional", "distributed"};
constexpr std::size_t pairs = 6;

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  core::ScalarMoments of_a, of_b;
  double product = 0;
  for (std::size_t k = 0; k < a.size(); ++k) of_a.add(a[k]), of_b.add(b[k]);
  for (std::size_t k = 0; k < a.size(); ++k) product += (a[k] - of_a.mean()) * (b[k] - of_b.mean());
  return product / static_cast<double>(a.size() - 1) / std::sqrt(of_a.variance() * of_b.variance());
}

using Found = std::array<std::vector<double>, names.size()>;

void expect_independent(const Found& found, test::Family& family, const std::string& what) {
  for (std::size_t a = 0; a < names.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_LE(std::abs(correlation(found[a], found[b])), family.z() / std::sqrt(places))
          << names[a] << " and " << names[b] << ", " << what;
}

TEST(OwnNumbers, are_those_of_each_integrator_at_points) {
  const scene::Scene scene = test::floor_below_a_sky();
  const std::vector<measure::Measurement> asked(places, measure::PointIrradiance{Vec3(0, 0, .5), Vec3::UnitZ(), {}});
  Found found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    IntegratorSettings settings;
    settings.samples = 256;
    settings.paths = measure::PathClasses::of("FE");
    core::LocalRun run(3, 2);
    for (const Estimate& each : make_integrator(names[i], settings)->answer(scene, asked, run.get()))
      found[i].push_back(each.value[0]);
  }
  test::Family family(2 * pairs);
  expect_independent(found, family, "points");
}

// Of two integrators that shared their numbers it was .85.
TEST(OwnNumbers, are_those_of_each_integrator_in_pictures) {
  const scene::Scene scene = test::floor_below_a_sky();
  const auto caster = raycast::make_ray_caster("embree", scene);
  Found found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    RenderSettings settings;
    settings.integrator = names[i];
    settings.samples = 256;
    settings.paths = measure::PathClasses::of("FDE");
    core::LocalRun run(3, 2);
    const Rendering picture = render(scene, {0}, settings, run.get(), *caster);
    for (int k = 0; k < static_cast<int>(places); ++k) found[i].push_back(picture.radiance.at(k % 16, k / 16, 0));
  }
  test::Family family(2 * pairs);
  expect_independent(found, family, "pixels");
}

}  // namespace
}  // namespace interflect::montecarlo
