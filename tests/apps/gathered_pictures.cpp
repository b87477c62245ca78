#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/vec.h"
#include "results/image_file.h"
#include "tests/apps/program.h"

namespace interflect::test {
namespace {

/// View factor from a point to a rectangle in a parallel plane at the height h, by its bounds beside the point; the
/// part of it towards either axis adds up [Hottel 1954].
double to_rectangle(double h, double x_0, double x_1, double y_0, double y_1) {
  if (x_1 <= x_0 || y_1 <= y_0) return 0;
  const auto corner = [&](double x, double y) {
    const double X = x / h, Y = y / h, along = std::sqrt(1 + X * X), across = std::sqrt(1 + Y * Y);
    return (X / along * std::atan(Y / along) + Y / across * std::atan(X / across)) / (2 * pi);
  };
  return corner(x_1, y_1) - corner(x_0, y_1) - corner(x_1, y_0) + corner(x_0, y_0);
}

constexpr double half = .5;  ///< of the source's side, at the height 2, and of the blocker's, at the height 1

/// What a point (x, y, 0) sees of the source: what the blocker hides of it is the blocker seen at the source's height,
/// twice as far away.
double seen(double x, double y) {
  const double hidden_x[] = {std::max(-half - x, 2 * (-half - x)), std::min(half - x, 2 * (half - x))},
               hidden_y[] = {std::max(-half - y, 2 * (-half - y)), std::min(half - y, 2 * (half - y))};
  return to_rectangle(2, -half - x, half - x, -half - y, half - y) -
         to_rectangle(2, hidden_x[0], hidden_x[1], hidden_y[0], hidden_y[1]);
}

// docs/truths.md 2.9.
TEST(DirectLightOfASquare, past_another_is_known) {
  for (const auto& [x, y, known] : {std::array{0., 0., 0.},
                                    {.6, 0., .007557182366},
                                    {1., 0., .029443796377},
                                    {1.5, 0., .032663265537},
                                    {1., 1., .029028221206},
                                    {.75, .75, .024093099852},
                                    {1.4, 1.4, .020596516308}})
    EXPECT_NEAR(seen(x, y), known, 1e-12) << x << ' ' << y;
}

/// A square that shines down on a floor, past another one; both are black, so that the floor's irradiance is what it
/// sees of the source.  The camera is between the blocker and the floor, and looks down.
const std::string shadow = R"({ "format": "interflect/scene/1", "units": "m", "quantity": "radiometric",
  "channels": ["y"], "weights": [1], "up": "y",
  "materials": { "floor": { "type": "diffuse", "reflectance": 0.5 }, "black": { "type": "diffuse", "reflectance": 0 },
                 "source": { "type": "diffuse", "reflectance": 0, "exitance": 1 } },
  "geometry": [
    { "name": "floor", "material": "floor", "polygon": [[-2,-2,0], [2,-2,0], [2,2,0], [-2,2,0]] },
    { "name": "source", "material": "source", "polygon": [[-0.5,-0.5,2], [-0.5,0.5,2], [0.5,0.5,2], [0.5,-0.5,2]] },
    { "name": "blocker", "material": "black", "polygon": [[-0.5,-0.5,1], [0.5,-0.5,1], [0.5,0.5,1], [-0.5,0.5,1]] } ],
  "cameras": [ { "name": "down", "eye": [0,0,0.9], "target": [0,0,0], "fov_y_deg": 121.28449291441747, "size": [40, 40] } ] })";

/// What pixels are off by.  Their middles are those of 40 x 40 parts of the floor from -1.6 to 1.6, as
/// tan(fov / 2) = 1.6 / .9.
struct Off {
  int umbra = 0, penumbra = 0;  ///< pixels
  double mean = 0, largest = 0;
  double in_errors = 0;  ///< the largest difference over the pixel's own error, of pixels that have one
};
Off off(const core::Image& image) {
  Off found;
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column) {
      const double x = (column + .5) / image.width * 3.2 - 1.6, y = (row + .5) / image.height * 3.2 - 1.6;
      const double F = seen(x, y), open = to_rectangle(2, -half - x, half - x, -half - y, half - y);
      const double difference = std::abs(image.at(column, row, 0) - .5 * inv_pi * F);
      found.umbra += F == 0;
      found.penumbra += F > 0 && F < open;
      found.mean += difference / (image.width * image.height);
      found.largest = std::max(found.largest, difference);
      if (const double error = image.at(column, row, 1); error > 1e-9)
        found.in_errors = std::max(found.in_errors, difference / error);
    }
  return found;
}

// Polynomials are gathered exactly; what is left is where rays of single precision hit, 4 2^-24 of the scene's 4 m,
// times the slope of F / (2 pi), which is below .1 / m: 1e-7.  Constants are gathered by rays: pixels have their
// standard errors, of which 1 600 together exceed 5.5 with a probability of 6e-5.
TEST(Render, gathers_shadows_as_they_are) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("shadow.json", shadow);
  const auto rendered = [&](const std::vector<std::string>& way) {
    std::vector<std::string> command{"render", scene, "-o", folder / "f.exr", "--element-size", "0.8", "--rays", "1"};
    command.insert(command.end(), way.begin(), way.end());
    const Outcome render = interflect(command);
    EXPECT_EQ(render.status, 0) << render.err;
    return off(results::read_exr(folder / "f.exr"));
  };
  const Off exact = rendered({"--order", "1", "--gather"}), sampled = rendered({"--gather"}),
            as_elements = rendered({});
  EXPECT_EQ(exact.umbra, 144);
  EXPECT_EQ(exact.penumbra, 1300);
  EXPECT_LT(exact.largest, 1e-7);
  EXPECT_LT(sampled.in_errors, 5.5);
  EXPECT_LT(sampled.mean, .02 * as_elements.mean) << "elements of .8 m have no shadow's edge";
}

// Parallels from below the blocker meet the floor at the middles of the same 40 x 40 parts.
TEST(Render, sees_by_parallels_too) {
  const TemporaryFolder folder;
  std::string text = shadow;
  const std::string pinhole = R"("fov_y_deg": 121.28449291441747)";
  text.replace(text.find(pinhole), pinhole.size(), R"("projection": "orthographic", "height": 3.2)");
  const Outcome render = interflect({"render", folder.write("shadow.json", text), "-o", folder / "f.exr",
                                     "--element-size", "0.8", "--rays", "1", "--order", "1", "--gather"});
  EXPECT_EQ(render.status, 0) << render.err;
  const Off exact = off(results::read_exr(folder / "f.exr"));
  EXPECT_EQ(exact.umbra, 144);
  EXPECT_EQ(exact.penumbra, 1300);
  EXPECT_LT(exact.largest, 1e-7);
}

/// A room with a lamp below its ceiling and a table below the lamp.
const std::string room_with_a_table = R"({ "format": "interflect/scene/1", "units": "m", "quantity": "radiometric",
  "channels": ["y"], "weights": [1],
  "materials": { "wall": { "type": "diffuse", "reflectance": 0.6 },
                 "table": { "type": "diffuse", "reflectance": 0.4, "sides": "both" },
                 "lamp": { "type": "diffuse", "reflectance": 0.2, "exitance": 5, "sides": "both" } },
  "geometry": [
    { "name": "room", "material": "wall", "box": { "min": [0,0,0], "max": [2,2,1.5] }, "facing": "inward" },
    { "name": "lamp", "material": "lamp", "polygon": [[0.8,0.8,1.3], [0.8,1.2,1.3], [1.2,1.2,1.3], [1.2,0.8,1.3]] },
    { "name": "table", "material": "table", "polygon": [[0.6,0.6,0.5], [1.4,0.6,0.5], [1.4,1.4,0.5], [0.6,1.4,0.5]] } ],
  "cameras": [ { "name": "low", "eye": [0.1,0.15,0.7], "target": [1.2,1.1,0.1], "fov_y_deg": 70, "size": [32, 24] } ] })";

/// Mean of a part of a picture, 8 x 8 pixels of a channel each.
double mean_of_part(const core::Image& image, int part, int channel, double power) {
  double sum = 0;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      sum += std::pow(double(image.at(part % 4 * 8 + x, part / 4 * 8 + y, channel)), power) / 64;
  return sum;
}

// Parts of 8 x 8 pixels, beneath the table and beside its shadow among them: the path tracer's means are normal, and 24
// two-sided comparisons exceed 4.7 standard errors with a probability of 1e-4.
TEST(Render, gathers_what_is_traced) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("room.json", room_with_a_table);
  const Outcome trace = interflect({"trace", scene, "--spp", "128", "--seed", "3", "-o", folder / "t.exr"});
  ASSERT_EQ(trace.status, 0) << trace.err;
  const core::Image traced = results::read_exr(folder / "t.exr");
  for (const auto& way : std::vector<std::vector<std::string>>{{"--order", "1"}, {}}) {
    std::vector<std::string> command{"render", scene, "-o", folder / "g.exr", "--gather", "--element-size", "0.4"};
    command.insert(command.end(), way.begin(), way.end());
    const Outcome render = interflect(command);
    ASSERT_EQ(render.status, 0) << render.err;
    const core::Image gathered = results::read_exr(folder / "g.exr");
    double darkest = 1, brightest = 0;
    for (int part = 0; part < 12; ++part) {
      const double radiance = mean_of_part(gathered, part, 0, 1), error = mean_of_part(gathered, part, 1, 1),
                   noise = std::sqrt(mean_of_part(traced, part, 1, 2) / 64);
      EXPECT_NEAR(radiance, mean_of_part(traced, part, 0, 1), error + 4.7 * noise) << part;
      EXPECT_LT(error + 4.7 * noise, .2 * radiance) << part;
      darkest = std::min(darkest, radiance);
      brightest = std::max(brightest, radiance);
    }
    EXPECT_LT(darkest, .65 * brightest);
  }
}

}  // namespace
}  // namespace interflect::test
