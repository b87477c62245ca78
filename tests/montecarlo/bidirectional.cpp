#include "montecarlo/bidirectional/bidirectional_estimator.h"
#include "montecarlo/bidirectional/bidirectional_tracer.h"
#include "tests/montecarlo/rooms.h"
#include "tests/montecarlo/statistics.h"

// Walks from both ends, joined: against closed forms, against walks from one end, and strategy by strategy.
namespace interflect::montecarlo {
namespace {

using scene::SceneBuilder;
using test::at_point;
using test::expect_agreement;
using test::Question;
using test::whole;

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

TEST(Bidirectional, agrees_with_path_tracing_on_all_that_can_be_asked) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const scene::Scene scene = test::furnished(scale);
    const auto asked = test::all_of_furnished(scene, scale);
    const std::uint64_t samples = scale == 1 ? 20'000 : 4'000;
    test::expect_same(BidirectionalTracer({.samples = samples}), PathTracer({.samples = 3 * samples}), scene, asked,
                      .05);
  }
}

TEST(Bidirectional, agrees_with_path_tracing_on_every_kind_of_light) {
  const scene::Scene scene = test::lit_by_all();
  const auto asked = test::all_of_lit(scene);
  test::expect_same(BidirectionalTracer({.samples = 40'000}), PathTracer({.samples = 100'000}), scene, asked, .05);
}

TEST(Bidirectional, agrees_with_path_tracing_on_every_material_and_camera) {
  const scene::Scene scene = test::shiny();
  std::vector<measure::Measurement> asked{
      measure::PointIrradiance{Vec3(.3, 1, .4), Vec3(.6, 0, .8), {}},
      measure::PointIrradiance{Vec3(2.2, 1, .05), z, {}},
      measure::Flux{measure::patches_of(scene, test::surface_named(scene, "room/z-"), scene::Side::front)},
      measure::Flux{measure::patches_of(scene, test::surface_named(scene, "plastic/z+"), scene::Side::front)},
      measure::Flux{measure::patches_of(scene, test::surface_named(scene, "pane"), scene::Side::back)},
      measure::Flux{measure::patches_of(scene, test::surface_named(scene, "rough glass/z+"), scene::Side::front)},
      measure::Flux{measure::patches_of(scene, test::surface_named(scene, "net"), scene::Side::front)}};
  for (std::uint32_t camera = 0; camera < 5; ++camera)
    for (const int k : {0, 1, 2}) asked.push_back(measure::PixelRadiance{{camera}, 1 + (k == 1), 1 + (k == 2)});
  test::expect_same(BidirectionalTracer({.samples = 60'000}), PathTracer({.samples = 150'000}), scene, asked, .1);
}

/// Plates about a room that do not touch: where lit surfaces do, strategies that join two walks have no finite variance
/// each by itself.
scene::Scene plates() {
  SceneBuilder builder({"grey"});
  const auto add = [&](const char* name, const Vec3& corner, const Vec3& u, const Vec3& v, double rho,
                       double exitance) {
    builder.add_polygon(name, test::parallelogram(corner, u, v),
                        builder.add_material(test::diffuse(name, rho, exitance)));
  };
  add("floor", Vec3(.3, .2, 0), 1.4 * x, 1.6 * y, .7, 0);
  add("ceiling", Vec3(.4, .4, 2), 1.2 * y, 1.2 * x, .6, 3);
  add("east", Vec3(2, .3, .3), 1.4 * z, 1.4 * y, .9, .5);
  add("west", Vec3(0, .4, .4), 1.2 * y, 1.3 * z, .8, 0);
  add("north", Vec3(.4, 2, .3), 1.2 * x, 1.4 * z, .8, 0);
  builder.scene().cameras.push_back({"c", Vec3(1, -1.5, 1.4), Vec3(1, 1.2, 0), z, 30, 1, 1});
  return builder.finish();
}

// Each strategy by itself, unweighed, finds what paths of its length bring.
TEST(Bidirectional, finds_the_same_by_each_strategy_alone) {
  const scene::Scene scene = plates();
  const std::vector<measure::Measurement> asked{
      measure::Flux{measure::patches_of(scene, test::surface_named(scene, "floor"), scene::Side::front)},
      measure::PointIrradiance{Vec3(1, .8, .9), Vec3(.8, 0, .6), {}}, measure::PixelRadiance{{0}, 0, 0}};
  const auto alone = [&](int s, int t, std::size_t m) {
    core::LocalRun run(static_cast<std::uint64_t>(10 * s + t));
    return BidirectionalTracer({.samples = 400'000, .only = BidirectionalStrategy{s, t}})
        .answer(scene, {&asked[m], 1}, run.get())[0];
  };
  int compared = 0;
  const double limit = test::critical_z(test::alpha, 41);
  for (std::size_t m = 0; m < asked.size(); ++m)
    for (int edges = 1; edges <= 4; ++edges) {
      const Estimate known = alone(0, edges + 1, m);
      if (m == 2 && edges == 1) continue;  // a pixel sees lights itself
      for (int s = 1; s <= edges + 1; ++s) {
        const int t = edges + 1 - s;
        if (t == 0 && m != 0) continue;  // nothing arrives on a point
        const Estimate found = alone(s, t, m);
        const double error = std::hypot(known.standard_error[0], found.standard_error[0]);
        EXPECT_NEAR(found.value[0], known.value[0], limit * error) << m << ": " << s << ", " << t;
        EXPECT_LT(error, .04 * known.value[0]) << m << ": " << s << ", " << t;
        ++compared;
      }
    }
  EXPECT_EQ(compared, 14 + 10 + 9);
}

// A furnace's walls, points and pixels, one wall of it a mirror that loses nothing, every corner of a wide picture.
TEST(Bidirectional, sees_a_furnace_everywhere) {
  SceneBuilder builder({"grey"});
  const auto wall = builder.add_material(test::diffuse("wall", .6, .4));
  builder.add_box("room", {Vec3(0, 0, 0), Vec3(2, 3, 1)}, wall, SceneBuilder::Facing::inward);
  scene::Material mirror;
  mirror.finish = scene::Mirror{test::grey(1)};
  mirror.sides = scene::Sides::both;
  builder.add_polygon("mirror", test::parallelogram(Vec3(1.2, 0, 0), 3 * y, z), builder.add_material(mirror));
  builder.scene().cameras.push_back({"c", Vec3(.9, 1.2, .4), Vec3(1.5, 2.8, .7), Vec3(.3, .1, 1), 90, 3, 3});
  const scene::Scene scene = builder.finish();
  std::vector<Question> questions;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) questions.push_back({measure::PixelRadiance{{0}, a, b}, test::grey(inv_pi), "pixel"});
  questions.push_back(at_point(Vec3(1, 1, .5), Vec3(0, .6, .8), 1));
  for (const char* side : {"x-", "x+", "y-", "z+"}) questions.push_back(whole(scene, std::string("room/") + side, 1));
  expect_agreement(BidirectionalTracer({.samples = 60'000}), scene, questions, .01);
}

// Light that comes by a mirror alone: walks from the light find it, and walks from the eye that meet the light.
TEST(Bidirectional, finds_what_a_mirror_throws) {
  SceneBuilder builder({"grey"});
  scene::Material mirror;
  mirror.finish = scene::Mirror{test::grey(.8)};
  mirror.sides = scene::Sides::both;
  builder.add_polygon("light", test::parallelogram(z, y, x), builder.add_material(test::diffuse("l", 0, 1)));
  builder.add_polygon("beside", test::parallelogram(z + x, y, x), builder.add_material(test::diffuse("b", 0, 0)));
  builder.add_polygon("aslant", test::parallelogram(z + x + y, y, x), builder.add_material(test::diffuse("a", 0, 0)));
  builder.add_polygon("mirror", test::parallelogram(-20 * (x + y), 40 * x, 40 * y), builder.add_material(mirror));
  expect_agreement(
      BidirectionalTracer({.samples = 400'000}), builder.finish(),
      {whole(builder.scene(), "beside", .8 * .0480641029851), whole(builder.scene(), "aslant", .8 * .0351071009097)},
      .01);
}

// What is measured counts light from its own side alone and picks lights so, while the rough glass that it lies on picks
// them from both: a light's walk that arrives there straight is weighed as the picks for what is measured are.
TEST(Bidirectional, weighs_lights_by_picks_for_what_is_measured) {
  SceneBuilder builder({"grey"});
  scene::Material glass;
  glass.finish = scene::Glass{1.5, .3};
  glass.sides = scene::Sides::both;
  builder.add_polygon("sheet", test::parallelogram(Vec3::Zero(), x, y), builder.add_material(glass));
  builder.add_polygon("above", test::parallelogram(1.2 * z, y, x), builder.add_material(test::diffuse("a", 0, 1)));
  builder.add_polygon("below", test::parallelogram(-1.2 * z, x, y), builder.add_material(test::diffuse("b", 0, 20)));
  const scene::Scene scene = builder.finish();
  const auto asked = [&](scene::Side side) {
    return measure::Flux{measure::patches_of(scene, test::surface_named(scene, "sheet"), side)};
  };
  test::expect_same(BidirectionalTracer({.samples = 400'000}), PathTracer({.samples = 1'000'000}), scene,
                    {asked(scene::Side::front), asked(scene::Side::back)}, .002);
}

/// A slab of rough glass between a lamp above and a floor, with a camera inside of it.
scene::Scene slab(const Vec3& camera_target) {
  SceneBuilder builder({"grey"});
  scene::Material glass;
  glass.finish = scene::Glass{1.5, .5};
  glass.sides = scene::Sides::both;
  builder.add_box("slab", {Vec3(-1, -1, 0), Vec3(1, 1, .4)}, builder.add_material(glass));
  builder.add_polygon("floor", test::parallelogram(Vec3(-.5, -.5, -.3), x, y),
                      builder.add_material(test::diffuse("f", .5, 0)));
  builder.add_polygon("lamp", test::parallelogram(Vec3(-.5, -.5, .7), y, x),
                      builder.add_material(test::diffuse("l", .5, 1)));
  builder.scene().cameras.push_back({"c", Vec3(0, 0, .2), camera_target, y, 40, 1, 1});
  return builder.finish();
}

// Joined within rough glass: what passes its two faces is squeezed at one and spread at the other.
TEST(Bidirectional, joins_walks_within_rough_glass) {
  const scene::Scene scene = slab(Vec3(0, 0, -1));
  test::expect_same(BidirectionalTracer({.samples = 200'000}), PathTracer({.samples = 800'000}), scene,
                    {measure::Flux{measure::patches_of(scene, test::surface_named(scene, "floor"), scene::Side::front)},
                     measure::PointIrradiance{Vec3(0, 0, .2), z, {}}, measure::PixelRadiance{{0}, 0, 0}},
                    .01);
}

// One face of it between lamp and camera: paths of two edges, met, joined and splatted, each unweighed.  Radiance gains
// the square of the index there, 2.25, whoever carries it.
TEST(Bidirectional, passes_rough_glass_the_same_by_each_strategy_alone) {
  const scene::Scene scene = slab(Vec3(0, 0, 1));
  const measure::Measurement pixel = measure::PixelRadiance{{0}, 0, 0};
  const auto alone = [&](int s, int t) {
    core::LocalRun run(static_cast<std::uint64_t>(10 * s + t));
    return BidirectionalTracer({.samples = 100'000, .only = BidirectionalStrategy{s, t}})
        .answer(scene, {&pixel, 1}, run.get())[0];
  };
  const Estimate known = alone(0, 3);
  for (const auto& [s, t] : {std::pair(1, 2), std::pair(2, 1)}) {
    const Estimate found = alone(s, t);
    const double error = std::hypot(known.standard_error[0], found.standard_error[0]);
    EXPECT_NEAR(found.value[0], known.value[0], test::critical_z(test::alpha, 2) * error) << s << ", " << t;
    EXPECT_LT(error, .1 * known.value[0]) << s << ", " << t;
  }
}

// A small lamp's light through glass onto a floor that a camera sees: found by paths from the lamp, which few of the
// eye's find.  With as many walks, counted as many times as there are, bidirectional tracing knows it far better.
TEST(Bidirectional, knows_a_caustic_better_than_path_tracing) {
  SceneBuilder builder({"grey"});
  scene::Material glass;
  glass.finish = scene::Glass{1.5, 0};
  glass.sides = scene::Sides::both;
  builder.add_polygon("floor", test::parallelogram(Vec3(-2, -2, 0), 4 * x, 4 * y),
                      builder.add_material(test::diffuse("f", .5, 0)));
  builder.add_polygon("lamp", test::parallelogram(Vec3(-.02, -.02, 2), .04 * y, .04 * x),
                      builder.add_material(test::diffuse("l", 0, 900)));
  builder.add_box("glass", {Vec3(-.5, -.5, .5), Vec3(.5, .5, .8)}, builder.add_material(glass));
  builder.scene().cameras.push_back({"c", Vec3(1.5, 0, .4), Vec3(0, 0, 0), z, 20, 4, 4});
  const scene::Scene scene = builder.finish();
  std::vector<measure::Measurement> asked;
  for (int row = 1; row < 4; ++row)
    for (int column = 0; column < 4; ++column) asked.push_back(measure::PixelRadiance{{0}, column, row});
  core::LocalRun run(1);
  const auto both = BidirectionalTracer({.samples = 2'000}).answer(scene, asked, run.get()),
             eye = PathTracer({.samples = 200'000}).answer(scene, asked, run.get());
  const double limit = test::critical_z(test::alpha, asked.size());
  for (std::size_t m = 0; m < asked.size(); ++m) {
    EXPECT_NEAR(both[m].value[0], eye[m].value[0],
                limit * std::hypot(both[m].standard_error[0], eye[m].standard_error[0]))
        << m;
    // A hundred times fewer, and no worse.
    EXPECT_LT(both[m].standard_error[0], 2 * eye[m].standard_error[0]) << m;
  }
}

// Classes of paths add up to the whole.
TEST(Bidirectional, splits_light_by_classes_of_paths) {
  const scene::Scene scene = test::shiny();
  const std::vector<measure::Measurement> asked{
      measure::Flux{measure::patches_of(scene, test::surface_named(scene, "room/z-"), scene::Side::front)},
      measure::PointIrradiance{Vec3(.3, 1, .4), Vec3(.6, 0, .8), {}}, measure::PixelRadiance{{0}, 2, 1}};
  core::LocalRun run(3);
  const auto all = BidirectionalTracer({.samples = 100'000}).answer(scene, asked, run.get());
  std::vector<Spectrum> sum(asked.size()), variance(asked.size());
  for (const char* paths : {"LS*E", "LS*(D|G)S*E", "L(S*(D|G)S*)(S*(D|G)S*)+E"}) {
    core::LocalRun other(17);
    const auto part = BidirectionalTracer({.samples = 100'000, .paths = measure::PathClasses::of(paths)})
                          .answer(scene, asked, other.get());
    for (std::size_t m = 0; m < asked.size(); ++m) {
      sum[m] += part[m].value;
      variance[m] += part[m].standard_error * part[m].standard_error;
    }
  }
  const double limit = test::critical_z(test::alpha, 6);
  for (std::size_t m = 0; m < asked.size(); ++m)
    for (int c = 0; c < 2; ++c) {
      // One seed's parts are one walk's: their errors may add up.
      const double error = std::hypot(std::sqrt(3 * variance[m][c]), all[m].standard_error[c]);
      EXPECT_NEAR(sum[m][c], all[m].value[c], limit * error) << m << ", channel " << c;
      EXPECT_LT(error, .1 * all[m].value[c]);
    }
}

/// A path's vertices with densities drawn at random, and what each strategy makes it with, all multiplied out.
class AnyPath {
 public:
  AnyPath(std::uint64_t seed, int edges) : numbers_(seed, 0, 0), k_(edges) {
    for (int i = 0; i <= k_; ++i) {
      at_.push_back({u(), u(), u()});
      cosine_.push_back(.1 + .9 * u());
      forward_.push_back(.1 + u());
      back_.push_back(.1 + u());
      delta_.push_back(i > 0 && i < k_ && u() < .3);
      if (delta_.back()) forward_.back() = back_.back() = 1;
    }
    emission_ = .1 + u(), picked_ = .1 + u(), place_ = .1 + u();
    light_is_delta_ = u() < .3, can_be_hit_ = u() < .5;
  }
  /// Weight of strategy s by all densities; 0 if it cannot make the path.
  double brute(int s) const {
    double sum = 0;
    for (int j = 0; j <= k_ + 1; ++j) sum += density(j);
    return density(s) / sum;
  }
  /// By the sums that walks carry.
  double recursive(int s) const {
    if (s == 0) return 1 / (1 + by_eye(0, picked_, emission_ * forward_[0]));
    if (s == k_ + 1) return 1 / (1 + from_light(k_).of_others(place_, back_[static_cast<std::size_t>(k_)]));
    const auto last = static_cast<std::size_t>(s - 1), zed = static_cast<std::size_t>(s);
    const double to_y = back_[zed] * g(zed, last), to_z = forward_[last] * g(last, zed);
    const double light =
        s == 1 ? (light_is_delta_ ? 0 : to_y / picked_) : from_light(s - 1).of_others(to_y, back_[last]);
    const double eye = from_eye(s).of_others(to_z, forward_[zed]);
    return 1 / (1 + light + (s == 1 ? emission_ / picked_ : 1) * eye);
  }
  bool can_make(int s) const { return density(s) > 0; }

 private:
  double u() { return numbers_.next(); }
  /// From solid angle at a to area at b.
  double g(std::size_t a, std::size_t b) const { return cosine_[b] / (at_[a] - at_[b]).squaredNorm(); }
  double density(int s) const {
    if (s == 0 && light_is_delta_) return 0;
    if (s == k_ + 1 && !can_be_hit_) return 0;
    if (s > 0 && s <= k_ && (delta_[static_cast<std::size_t>(s - 1)] || delta_[static_cast<std::size_t>(s)])) return 0;
    double p = s == 0 ? 1 : s == 1 ? picked_ : emission_;
    for (int i = 1; i < s; ++i)
      p *= forward_[static_cast<std::size_t>(i - 1)] * g(static_cast<std::size_t>(i - 1), static_cast<std::size_t>(i));
    if (s <= k_) p *= place_;
    for (int i = k_ - 1; i >= s; --i)
      p *= back_[static_cast<std::size_t>(i + 1)] * g(static_cast<std::size_t>(i + 1), static_cast<std::size_t>(i));
    return p;
  }
  PartialWeights walked(std::vector<std::size_t> order, PartialWeights weights, const std::vector<double>& on,
                        const std::vector<double>& home, double first_joins) const {
    for (std::size_t i = 0; i + 1 < order.size(); ++i) {
      const std::size_t a = order[i], b = order[i + 1];
      Departure departure = delta_[a] ? Departure::mirrored(at_[a], weights, cosine_[a])
                                      : Departure::scattered(at_[a], weights, on[a], cosine_[a], home[a]);
      if (i == 0) departure.joins = first_joins, departure.others = weights.a;
      weights = departure.arrived(at_[b], departure.pdf_area(at_[b], cosine_[b]));
    }
    return weights;
  }
  PartialWeights from_light(int last) const {
    std::vector<std::size_t> order;
    for (int i = 0; i <= last; ++i) order.push_back(static_cast<std::size_t>(i));
    return walked(order, {light_is_delta_ ? 0 : 1 / emission_, 0}, forward_, back_, picked_ / emission_);
  }
  PartialWeights from_eye(int last) const {
    std::vector<std::size_t> order;
    for (int i = k_; i >= last; --i) order.push_back(static_cast<std::size_t>(i));
    return walked(order, {can_be_hit_ ? 1 / place_ : 0, 0}, back_, forward_, 1);
  }
  double by_eye(int last, double pdf_area, double pdf_then) const {
    const PartialWeights weights = from_eye(last);
    return pdf_area * weights.a + pdf_then * weights.b;
  }

  core::RandomNumbers numbers_;
  int k_;
  std::vector<Vec3> at_;
  std::vector<double> cosine_, forward_, back_;  ///< pdfs at a vertex towards the next, and the one before [1/sr]
  std::vector<bool> delta_;
  double emission_, picked_, place_;  ///< of x_0 by emission and by a pick; of x_k [1/m²]
  bool light_is_delta_, can_be_hit_;
};

TEST(PartialWeights, are_those_of_all_strategies_one_by_one) {
  int compared = 0;
  for (std::uint64_t seed = 0; seed < 5000; ++seed) {
    const int edges = 1 + static_cast<int>(seed % 7);
    const AnyPath path(seed, edges);
    double sum = 0;
    for (int s = 0; s <= edges + 1; ++s) {
      if (!path.can_make(s)) continue;
      EXPECT_NEAR(path.recursive(s), path.brute(s), 1e-12) << seed << ", s = " << s << " of " << edges;
      sum += path.recursive(s);
      ++compared;
    }
    EXPECT_TRUE(sum == 0 || std::abs(sum - 1) < 1e-12) << seed;
  }
  EXPECT_GT(compared, 10'000);
}

}  // namespace
}  // namespace interflect::montecarlo
