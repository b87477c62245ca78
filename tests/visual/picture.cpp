#include "visual/picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "environment.h"
#include "results/image_file.h"
#include "tests/support/temporary_folder.h"
#include "tiny.h"
#include "visual/bare_surfaces.h"
#include "visual/comparison_picture.h"
#include "visual/legend.h"
#include "visual/raster.h"

using namespace interflect;
using namespace interflect::visual;
using results::Colour;
using results::ColourMap;

namespace {

class Picture : public testing::Test {
 protected:
  static void SetUpTestSuite() { display_ = std::make_unique<visual::Display>(); }
  static void TearDownTestSuite() { display_.reset(); }
  static const visual::Display& display() { return *display_; }

 private:
  static std::unique_ptr<visual::Display> display_;
};
std::unique_ptr<visual::Display> Picture::display_;

Colour pixel(const core::Image& image, int x, int y) {
  Colour out;
  for (int c = 0; c < 3; ++c)
    out[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(std::lround(255 * image.at(x, y, c)));
  return out;
}

/// Where `picture` sits inside its frame.
struct Place {
  int left = 0, top = 0;
};
Place place_of(int width, int height, const std::string& caption) {
  Place place;
  framed(core::Image(width, height, {"R", "G", "B"}), caption, nullptr, &place.left, &place.top);
  return place;
}

std::vector<double> ramp(Index n) {
  std::vector<double> values;
  for (Index i = 0; i < n; ++i) values.push_back(static_cast<double>(i));
  return values;
}

/// What a ray through the middle of a pixel meets in z = 0: an element, or nothing.
int element_at(const tiny::Floor& floor, const scene::Camera& camera, int x, int y, int n) {
  const Vec3 d = camera.direction(x + 0.5, y + 0.5), eye = camera.eye - floor.offset;
  const Vec3 p = eye - eye.z() / d.z() * d;
  const int i = static_cast<int>(std::floor(p.x() * n / 2)), j = static_cast<int>(std::floor(p.y() * n / 2));
  return i < 0 || j < 0 || i >= n || j >= n ? -1 : j * n + i;
}

/// The pixel and its neighbours see the same: its colour is not a mixture.
bool inside(const tiny::Floor& floor, const scene::Camera& camera, int x, int y, int n) {
  for (int dx : {-1, 1})
    for (int dy : {-1, 1})
      if (element_at(floor, camera, x + dx, y + dy, n) != element_at(floor, camera, x, y, n)) return false;
  return true;
}

/// A surface as deep as the floor, from x0 to x1 at the height z, of a material of its own: without elements.
void add_bare(tiny::Floor& floor, const scene::Finish& finish, scene::Sides sides, double x0, double x1, double z) {
  const scene::SurfaceId id{static_cast<std::uint32_t>(floor.scene.surfaces.size())};
  scene::Material material{"m", {}, {}, sides};
  material.finish = finish;
  floor.scene.materials.push_back(material);
  scene::Surface surface{"s", {}, 0, 2, {}};
  surface.material.value = static_cast<std::uint32_t>(floor.scene.materials.size() - 1);
  surface.first_facet = static_cast<std::uint32_t>(floor.scene.facets.size()), surface.facets = 2;
  floor.scene.surfaces.push_back(surface);
  const Vec3 a(x0, 0, z), b(x1, 0, z), c(x1, 2, z), d(x0, 2, z);
  floor.scene.facets.push_back(scene::make_facet(id, {a, b, c}));
  floor.scene.facets.push_back(scene::make_facet(id, {a, c, d}));
}

}  // namespace

TEST_F(Picture, shows_each_element_where_the_cameras_rays_meet_it) {
  constexpr int n = 4;
  const tiny::Floor floor(n);
  FalseColour options;
  options.camera = floor.camera(3);
  options.range = Range{0, 15};
  const core::Image image = false_colour(display(), floor.scene, floor.mesh, ramp(floor.mesh.size()), options);
  const Place at = place_of(120, 90, "");
  int compared = 0;
  for (int y = 1; y < 89; ++y)
    for (int x = 1; x < 119; ++x) {
      if (!inside(floor, *options.camera, x, y, n)) continue;
      const int element = element_at(floor, *options.camera, x, y, n);
      const Colour expected = element < 0 ? Colour{255, 255, 255} : colour_of(options.map, element / 15.0);
      ASSERT_EQ(pixel(image, at.left + x, at.top + y), expected) << x << ' ' << y;
      ++compared;
    }
  EXPECT_GT(compared, 7000);
}

TEST_F(Picture, is_the_same_a_million_metres_away) {
  const tiny::Floor here(4), there(4, Vec3(1e6, -2e6, 5e5));
  FalseColour options;
  options.camera = here.camera(3);
  const core::Image a = false_colour(display(), here.scene, here.mesh, ramp(16), options);
  options.camera = there.camera(3);
  const core::Image b = false_colour(display(), there.scene, there.mesh, ramp(16), options);
  ASSERT_EQ(a.data.size(), b.data.size());
  double off = 0;
  for (std::size_t i = 0; i < a.data.size(); ++i) off += std::abs(a.data[i] - b.data[i]);
  EXPECT_LT(off / static_cast<double>(a.data.size()), 1e-4);  // an edge may round to the next of nine samples
}

TEST_F(Picture, from_behind_a_side_without_elements_is_dark_and_from_outside_it_is_not_there) {
  const tiny::Floor floor(2);
  FalseColour options;
  options.camera = floor.camera(-3);
  const core::Image behind = false_colour(display(), floor.scene, floor.mesh, ramp(4), options);
  const Place at = place_of(120, 90, "");
  EXPECT_EQ(pixel(behind, at.left + 60, at.top + 45), (Colour{70, 70, 70}));

  tiny::Floor turned(2);
  turned.scene.up = -Vec3::UnitZ();  // the view from outside now looks at the floor's back
  options.camera.reset();
  options.width = 120, options.height = 90;
  const core::Image outside = false_colour(display(), turned.scene, turned.mesh, ramp(4), options);
  EXPECT_EQ(pixel(outside, at.left + 60, at.top + 45), (Colour{255, 255, 255}));
  const core::Image upright = false_colour(display(), floor.scene, floor.mesh, ramp(4), options);
  EXPECT_NE(pixel(upright, at.left + 60, at.top + 45), (Colour{255, 255, 255}));
}

TEST_F(Picture, from_outside_everything_is_in_it_and_fills_it) {
  const tiny::Floor floor(2);
  Raster raster;
  raster.fronts = flat(floor.mesh, std::vector<Colour>(4, Colour{0, 0, 0}));
  for (const auto& [width, height] : {std::pair{160, 60}, {60, 160}}) {
    FalseColour options;
    options.width = width, options.height = height;
    const core::Image image = false_colour(display(), floor.scene, floor.mesh, std::vector<double>(4, 1.0), options);
    const Place at = place_of(width, height, "");
    int covered = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const bool floor_here = pixel(image, at.left + x, at.top + y) != Colour{255, 255, 255};
        covered += floor_here;
        if (x == 0 || y == 0 || x == width - 1 || y == height - 1) {
          EXPECT_FALSE(floor_here);
        }
      }
    EXPECT_GT(covered, width * height / 12);
  }
}

TEST_F(Picture, true_colour_is_tone_mapped_radiance) {
  const tiny::Floor floor(2);
  TrueColour options;
  options.camera = floor.camera(3);
  options.white = 2;
  options.smooth = false;
  const std::vector<std::array<double, 3>> rgb{{1, 0.5, 0}, {1, 0.5, 0}, {1, 0.5, 0}, {4, 2, 1}};
  const core::Image image = true_colour(display(), floor.scene, floor.mesh, rgb, options);
  ASSERT_EQ(image.width, 120);  // without a caption: the camera's pixels and nothing else
  const scene::Camera& camera = *options.camera;
  for (int y = 1; y < 89; ++y)
    for (int x = 1; x < 119; ++x) {
      if (!inside(floor, camera, x, y, 2)) continue;
      const int element = element_at(floor, camera, x, y, 2);
      // sRGB of 0.5, 0.25, 0: 188, 137, 0; of 2 (clipped), 1, 0.5: 255, 255, 188.
      const Colour expected = element < 0    ? Colour{0, 0, 0}
                              : element == 3 ? Colour{255, 255, 188}
                                             : Colour{188, 137, 0};
      ASSERT_EQ(pixel(image, x, y), expected) << x << ' ' << y;
    }
}

TEST_F(Picture, the_legend_shows_the_map_from_low_to_high_and_nothing_is_cut_off) {
  const core::Image plain(200, 300, {"R", "G", "B"});
  const Legend legend{"irradiance [W/m\xc2\xb2]", ColourMap::plasma, {0, 500}, true, false};
  Place at;
  const core::Image image = framed(plain, "A caption", &legend, &at.left, &at.top);
  EXPECT_GT(image.width, at.left + 200 + 40);
  int column = -1, first = -1, last = -1;  // the bar: the first column right of the picture with the map's end colours
  for (int x = at.left + 200; x < image.width && column < 0; ++x)
    for (int y = 0; y < image.height; ++y)
      if (pixel(image, x, y) == colour_of(ColourMap::plasma, 0.5)) column = x;
  ASSERT_GE(column, 0);
  for (int y = 0; y < image.height; ++y) {
    const Colour c = pixel(image, column, y);
    if (first < 0 && c[0] > 230 && c[1] > 230 && c[2] < 60) first = y;
    if (c[2] > 125 && c[0] < 30 && c[1] < 20) last = y;
  }
  EXPECT_GT(first, at.top);
  EXPECT_GT(last, first + 200);
  int ink = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const bool dark = pixel(image, x, y)[1] < 120;
      const bool in_picture = x >= at.left && x < at.left + 200 && y >= at.top && y < at.top + 300;
      if (dark && !in_picture && x > column + 30) ++ink;
      if (x < 4 || y < 4 || x >= image.width - 4 || y >= image.height - 4) {
        EXPECT_FALSE(dark) << x << ' ' << y;
      }
    }
  EXPECT_GT(ink, 100);
}

TEST_F(Picture, a_caption_longer_than_its_picture_is_not_cut_off) {
  const core::Image image = framed(core::Image(20, 90, {"R", "G", "B"}), "path traced, 64 samples a pixel", nullptr);
  EXPECT_GT(image.width, 150);
  for (int y = 0; y < image.height; ++y) EXPECT_EQ(pixel(image, image.width - 4, y), (Colour{255, 255, 255})) << y;
}

TEST_F(Picture, edges_darken_the_borders_of_elements_alone) {
  const tiny::Floor floor(2);
  FalseColour options;
  options.camera = floor.camera(3);
  const std::vector<double> same(4, 1.0);
  const core::Image plain = false_colour(display(), floor.scene, floor.mesh, same, options);
  options.edges = true;
  const core::Image edged = false_colour(display(), floor.scene, floor.mesh, same, options);
  int darker = 0, lighter = 0;
  for (std::size_t i = 0; i < plain.data.size(); ++i) {
    darker += edged.data[i] < plain.data[i] - 0.05F;
    lighter += edged.data[i] > plain.data[i] + 0.01F;
  }
  EXPECT_GT(darker, 100);
  EXPECT_LT(darker, 120 * 90);
  EXPECT_EQ(lighter, 0);
}

TEST_F(Picture, faces_of_one_colour_are_told_apart_by_their_outlines) {
  tiny::Floor floor(2);
  FalseColour options;
  options.camera = floor.camera(3);
  const std::vector<double> same(4, 1.0);
  const core::Image outlined = false_colour(display(), floor.scene, floor.mesh, same, options);
  options.outlines = false;
  const core::Image plain = false_colour(display(), floor.scene, floor.mesh, same, options);
  const auto darker = [&](int x, int y) {
    const Place at = place_of(120, 90, "");
    return outlined.at(at.left + x, at.top + y, 1) < plain.at(at.left + x, at.top + y, 1) - 0.05F;
  };
  int outside = 0, inside = 0;
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 120; ++x) {
      const bool rim =
          element_at(floor, *options.camera, x - 2, y, 2) < 0 || element_at(floor, *options.camera, x + 2, y, 2) < 0 ||
          element_at(floor, *options.camera, x, y - 2, 2) < 0 || element_at(floor, *options.camera, x, y + 2, 2) < 0;
      (rim ? outside : inside) += darker(x, y);
    }
  EXPECT_GT(outside, 100);
  EXPECT_EQ(inside, 0);  // elements of one face are not
}

TEST_F(Picture, what_is_beside_everything_is_not_the_white_of_a_diverging_map) {
  const tiny::Floor floor(2);
  FalseColour options;
  options.camera = floor.camera(6);
  options.map = ColourMap::blue_white_red;
  const core::Image image = false_colour(display(), floor.scene, floor.mesh, std::vector<double>(4, 0.0), options);
  const Place at = place_of(120, 90, "");
  EXPECT_EQ(pixel(image, at.left + 60, at.top + 45), colour_of(ColourMap::blue_white_red, 0.5));
  EXPECT_LT(pixel(image, at.left + 2, at.top + 2)[1], 230);
}

// The front and the side of a box share an edge, on which corners of the side's elements lie and none of the front's:
// the side's back, which the front hides, would show there by rounding, dark before the wall behind.
TEST_F(Picture, no_specks_of_backs_show_at_the_edges_of_bodies) {
  constexpr int cuts = 7;
  const auto patch = [](std::array<Vec3, 4> ring) { return make_patch(scene::SurfaceId{0}, scene::Side::front, ring); };
  std::vector<scene::SurfacePatch> patches{patch({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, 1), Vec3(0, 0, 1)}),
                                           patch({Vec3(-9, 2, -9), Vec3(9, 2, -9), Vec3(9, 2, 9), Vec3(-9, 2, 9)})};
  for (double k = 0; k < cuts; ++k)
    patches.push_back(
        patch({Vec3(1, 0, k / cuts), Vec3(1, 1, k / cuts), Vec3(1, 1, (k + 1) / cuts), Vec3(1, 0, (k + 1) / cuts)}));
  const mesh::ElementMesh mesh(std::move(patches));
  const scene::Scene scene = tiny::Floor(1).scene;
  TrueColour options;
  options.white = 1;
  options.smooth = false;
  const std::vector<std::array<double, 3>> rgb(2 + cuts, {1, 1, 1});
  int dark = 0;
  for (double turn = 0; turn < 10; ++turn) {
    options.camera =
        scene::Camera{"", Vec3(0.2 + 0.03 * turn, -2, 0.6), Vec3(0.9, 0, 0.4), Vec3(0.1, 0, 1), 30, 160, 120};
    const core::Image image = true_colour(display(), scene, mesh, rgb, options);
    for (float v : image.data) dark += v < 1;
  }
  EXPECT_EQ(dark, 0);
}

TEST(PictureFile, is_written_without_a_display_in_the_environment) {
  const test::Environment none("DISPLAY", nullptr);
  const test::TemporaryFolder scratch;
  const tiny::Floor floor(2);
  FalseColour options;
  options.width = 64, options.height = 48;
  {
    const visual::Display own;
    results::write_png(scratch / "picture.png", false_colour(own, floor.scene, floor.mesh, ramp(4), options));
  }
  EXPECT_EQ(test::read_file(scratch / "picture.png").substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(std::getenv("DISPLAY"), nullptr);
}

TEST(ComparisonPicture, has_the_panels_as_they_are_with_words_over_them_and_a_legend) {
  constexpr int width = 300, height = 200;  // wider than the words
  const auto grey = [](float level) {
    core::Image image(width, height, {"R", "G", "B"});
    std::fill(image.data.begin(), image.data.end(), level);
    return image;
  };
  const core::Image picture =
      comparison_picture({grey(0.25F), grey(0.5F), grey(0.75F)}, {"radiosity", "path traced", "their difference"}, 0.1);
  Place at;
  const core::Image one = framed(grey(0), "x", nullptr, &at.left, &at.top);
  ASSERT_EQ(picture.height, one.height);
  ASSERT_GT(picture.width, 3 * one.width);  // the legend is beside the last
  for (int panel = 0; panel < 3; ++panel) {
    const int left = panel * one.width + at.left;
    for (int y : {0, height - 1})
      for (int x : {0, width - 1})
        EXPECT_FLOAT_EQ(picture.at(left + x, at.top + y, 1), 0.25F * static_cast<float>(panel + 1));
    int ink = 0;
    for (int y = 0; y < at.top; ++y)
      for (int x = left; x < left + width; ++x) ink += picture.at(x, y, 1) < 0.5F;
    EXPECT_GT(ink, 20) << "panel " << panel << " has no words";
  }
  int blue = 0, red = 0;  // of the legend
  for (int y = at.top; y < picture.height; ++y)
    for (int x = 3 * one.width; x < picture.width; ++x) {
      const Colour c = pixel(picture, x, y);
      blue += c[2] > 150 && c[0] < 60;
      red += c[0] > 140 && c[1] < 60;
    }
  EXPECT_GT(blue, 20);
  EXPECT_GT(red, 20);
}

// A mirror beside the floor, and a pane that stands above a half of it: both hatched and named.  The floor is read through
// the pane; pictures of scenes without them are what they were.
TEST_F(Picture, hatches_what_has_no_elements_and_says_so) {
  constexpr int n = 2;
  tiny::Floor floor(n);
  const core::Image without = true_colour(display(), floor.scene, floor.mesh, std::vector<std::array<double, 3>>(4),
                                          {.caption = {}, .white = 1, .camera = floor.camera(6)});
  EXPECT_EQ(without.height, 90);
  add_bare(floor, scene::Mirror{Spectrum(0.9)}, scene::Sides::front, 2, 4, 0);
  add_bare(floor, scene::Pane{Spectrum(0.9)}, scene::Sides::both, 0, 1, 0.1);
  FalseColour options;
  options.camera = floor.camera(6);
  options.range = Range{0, 3};
  options.outlines = false;
  const core::Image image = false_colour(display(), floor.scene, floor.mesh, std::vector<double>(4, 3), options);
  const Place at = place_of(120, 90, "");
  const Colour of_floor = colour_of(options.map, 1);
  int striped = 0, plain = 0, clear = 0, through = 0;
  for (int y = 1; y < 89; ++y)
    for (int x = 1; x < 119; ++x) {
      const Vec3 d = options.camera->direction(x + 0.5, y + 0.5);
      const Vec3 p = options.camera->eye - options.camera->eye.z() / d.z() * d;
      if (std::abs(p.y() - 1) > 0.9) continue;
      const Colour seen = pixel(image, at.left + x, at.top + y);
      const bool grey = seen[0] == seen[1] && seen[1] == seen[2];
      if (p.x() > 2.1 && p.x() < 3.9) {
        EXPECT_TRUE(grey && seen[0] > 150 && seen[0] < 235) << x << ' ' << y;
        ++(seen[0] < 200 ? striped : plain);
      } else if (p.x() > 0.1 && p.x() < 0.8) {
        ++(seen == of_floor ? through : clear);
      } else if (p.x() > 1.2 && p.x() < 1.9) {
        EXPECT_EQ(seen, of_floor) << x << ' ' << y;
      }
    }
  EXPECT_GT(striped, 50);
  EXPECT_GT(plain, 50);
  EXPECT_GT(clear, 20);
  EXPECT_GT(through, 3 * clear);
  const core::Image noted = true_colour(display(), floor.scene, floor.mesh, std::vector<std::array<double, 3>>(4),
                                        {.caption = {}, .white = 1, .camera = floor.camera(6)});
  EXPECT_GT(noted.height, 100);  // a line below it
  EXPECT_EQ(note_of(bare_surfaces(floor.scene, floor.mesh)), "hatched: no elements (mirror, glass)");
}

// A pane before a block of glass, the floor and a mirror.  All that was seen without it is seen with it but where its
// stripes are, an eighteenth.  Of clear bodies one behind the other each has as many, and a mirror keeps its own, a
// third.
TEST_F(Picture, shows_behind_a_pane_what_is_there_without_it) {
  tiny::Floor floor(2);
  add_bare(floor, scene::Glass{1.5}, scene::Sides::both, 0, 1, 0.1);
  add_bare(floor, scene::Mirror{Spectrum(0.9)}, scene::Sides::front, 2, 4, 0);
  FalseColour options;
  options.camera = floor.camera(6);
  options.camera->width = 480, options.camera->height = 360;
  options.range = Range{0, 3};
  const auto drawn = [&] {
    return false_colour(display(), floor.scene, floor.mesh, std::vector<double>(4, 3), options);
  };
  const core::Image without = drawn();
  add_bare(floor, scene::Pane{Spectrum(0.9)}, scene::Sides::both, -1, 5, 0.5);
  const core::Image with = drawn();

  constexpr int ground = 228, stripe = 158;  // of hatching: any channel
  const int of_floor = colour_of(options.map, 1)[2];
  struct Part {
    double x0, x1;  ///< of the floor's plane
    int under;      ///< its blue without stripes
    double before, after;
    double striped_before = 0, striped = 0;
    int pixels = 0, lost = 0;
  };
  std::array<Part, 3> parts{{{0.1, 0.9, of_floor, 1. / 18, 2. / 18},
                             {1.1, 1.9, of_floor, 0, 1. / 18},
                             {2.1, 3.9, ground, 1. / 3, 1. / 3 + 2. / 3 / 18}}};
  const Place at = place_of(480, 360, "");
  for (int y = 1; y < 359; ++y)
    for (int x = 1; x < 479; ++x) {
      const Vec3 eye = options.camera->eye, d = options.camera->direction(x + 0.5, y + 0.5);
      const Vec3 p = eye - eye.z() / d.z() * d, on_pane = eye - (eye.z() - 0.5) / d.z() * d;
      if (std::abs(p.y() - 1) > 0.9 || std::abs(on_pane.y() - 1) > 0.9) continue;
      for (Part& part : parts) {
        if (p.x() < part.x0 || p.x() > part.x1) continue;
        const auto striped = [&](const core::Image& image) {  // what part of the pixel
          return (pixel(image, at.left + x, at.top + y)[2] - part.under) / double(stripe - part.under);
        };
        ++part.pixels;
        part.striped_before += striped(without);
        part.striped += striped(with);
        part.lost += striped(with) < striped(without) - 1e-9;
      }
    }
  for (const Part& part : parts) {
    EXPECT_GT(part.pixels, 3000);
    EXPECT_EQ(part.lost, 0) << part.x0;
    EXPECT_NEAR(part.striped_before / part.pixels, part.before, 0.01) << part.x0;  // the rim's stripes are cut off
    EXPECT_NEAR(part.striped / part.pixels, part.after, 0.01) << part.x0;
  }
}

TEST_F(Picture, a_logarithmic_legend_says_so) {
  const core::Image plain(200, 300, {"R", "G", "B"});
  Place at;
  const auto second_line = [&](bool logarithmic) {
    const Legend legend{"known within [lx]", ColourMap::plasma, {1, 100, logarithmic}, false, false};
    const core::Image image = framed(plain, "", &legend, &at.left, &at.top);
    int ink = 0;  // type is 13 pixels high here; below one line the first number's upper edge is at 24
    for (int y = at.top + 18; y < at.top + 23; ++y)
      for (int x = at.left + 210; x < image.width; ++x) ink += pixel(image, x, y)[1] < 120;
    return ink;
  };
  EXPECT_EQ(second_line(false), 0);
  EXPECT_GT(second_line(true), 40);
}

TEST_F(Picture, has_a_line_below_it_where_there_is_something_to_say) {
  const tiny::Floor floor(2);
  const std::vector<std::array<double, 3>> rgb(4, {1, 1, 1});
  const core::Image plain = true_colour(display(), floor.scene, floor.mesh, rgb,
                                        {.caption = {}, .white = 1, .camera = floor.camera(3)}),
                    said = true_colour(display(), floor.scene, floor.mesh, rgb,
                                       {.caption = {}, .note = "dimmed", .white = 1, .camera = floor.camera(3)});
  EXPECT_GT(said.height, plain.height);
  for (int y = 0; y < plain.height; ++y)
    for (int x = 0; x < plain.width; ++x) ASSERT_EQ(pixel(said, x, y), pixel(plain, x, y)) << x << ' ' << y;
  int ink = 0;
  for (int y = plain.height; y < said.height; ++y)
    for (int x = 0; x < said.width; ++x) ink += pixel(said, x, y)[1] < 120;
  EXPECT_GT(ink, 30);
}
