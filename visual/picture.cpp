#include "visual/picture.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "results/tone_mapping.h"
#include "visual/bare_surfaces.h"
#include "visual/faces.h"
#include "visual/legend.h"
#include "visual/raster.h"
#include "visual/shading.h"
#include "visual/view.h"

namespace interflect::visual {

namespace {

constexpr results::Colour white{255, 255, 255}, pale{216, 216, 216}, black{0, 0, 0}, dark_back{70, 70, 70};

std::vector<double> areas_of(const mesh::ElementMesh& mesh) {
  std::vector<double> areas;
  for (const scene::SurfacePatch& patch : mesh.patches()) areas.push_back(patch.area);
  return areas;
}

void require_size(std::size_t values, const mesh::ElementMesh& mesh) {
  if (mesh.size() == 0 || values != static_cast<std::size_t>(mesh.size()))
    throw core::PreconditionError("picture: one value per element expected");
}

void append(Polygons& to, const Polygons& more) {
  to.corners.insert(to.corners.end(), more.corners.begin(), more.corners.end());
  to.sizes.insert(to.sizes.end(), more.sizes.begin(), more.sizes.end());
  to.colours.insert(to.colours.end(), more.colours.begin(), more.colours.end());
}

std::string with_squares(std::string text) {
  for (std::size_t at; (at = text.find("m2")) != std::string::npos;) text.replace(at, 2, "m\xc2\xb2");
  return text;
}

/// The face of each polygon, from 1, of elements that were drawn as `pieces` polygons each.
template <class Pieces>
std::vector<std::uint32_t> faces_of_polygons(const scene::Scene& scene, const mesh::ElementMesh& mesh,
                                             const Pieces& pieces) {
  std::vector<std::uint32_t> out;
  const std::vector<std::uint32_t> faces = faces_of(scene, mesh);
  for (std::size_t e = 0; e < faces.size(); ++e) out.insert(out.end(), pieces(e), faces[e] + 1);
  return out;
}

std::vector<std::uint32_t> faces_of_polygons(const scene::Scene& scene, const mesh::ElementMesh& mesh,
                                             const mesh::SmoothMesh& smooth, std::size_t polygons) {
  std::vector<std::uint32_t> out;
  const std::vector<std::uint32_t> faces = faces_of(scene, mesh);
  for (std::uint32_t e : smooth.element) out.insert(out.end(), polygons / smooth.element.size(), faces[e] + 1);
  return out;
}

/// Where one looks from, what is behind everything, and what is there without elements.
void set_view(Raster& raster, const scene::Scene& scene, const mesh::ElementMesh& mesh, BareSurfaces& bare,
              const std::optional<scene::Camera>& camera, int width, int height, results::Colour backs,
              results::Colour behind) {
  raster.camera = camera ? *camera : outside_view(scene, width, height);
  raster.background = behind;
  for (std::uint32_t& face : raster.faces) face += bare.faces;
  if (camera)
    for (const std::span<const scene::SurfacePatch> patches :
         {mesh.patches(), std::span<const scene::SurfacePatch>(bare.patches)})
      append(raster.fronts, black_backs(scene, patches, backs));
  raster.faces.resize(raster.fronts.sizes.size(), Samples::back);
  raster.bare = std::move(bare.opaque);
  raster.clear = std::move(bare.clear);
  raster.hatched = bare.faces;
}

/// What is to be said below a picture.
std::vector<Note> notes_of(const std::string& own, const BareSurfaces& bare, bool any_hatched) {
  std::vector<Note> notes;
  if (!own.empty()) notes.push_back({own});
  if (any_hatched) notes.push_back({note_of(bare), true});
  return notes;
}

core::Image false_coloured(const Display& display, const scene::Scene& scene, const mesh::ElementMesh& mesh,
                           Raster raster, const Legend& legend, const FalseColour& options) {
  raster.edges = options.edges;
  raster.outlines = options.outlines;
  BareSurfaces bare = bare_surfaces(scene, mesh);
  set_view(raster, scene, mesh, bare, options.camera, options.width, options.height, dark_back,
           options.map == results::ColourMap::blue_white_red ? pale : white);
  bool any_hatched = false;
  const core::Image picture = framed(rasterised(display, raster, &any_hatched), options.caption, &legend);
  return noted(picture, notes_of(options.note, bare, any_hatched));
}

core::Image true_coloured(const Display& display, const scene::Scene& scene, const mesh::ElementMesh& mesh,
                          Raster raster, const TrueColour& options) {
  BareSurfaces bare = bare_surfaces(scene, mesh);
  set_view(raster, scene, mesh, bare, options.camera, options.width, options.height, black,
           options.camera ? black : white);
  bool any_hatched = false;
  core::Image picture = rasterised(display, raster, &any_hatched);
  if (!options.caption.empty()) picture = framed(picture, options.caption, nullptr);
  return noted(picture, notes_of(options.note, bare, any_hatched));
}

Legend legend_of(const FalseColour& options, const Range& range, std::span<const double> values) {
  if (!(range.high > range.low)) throw core::PreconditionError("picture: an ascending range expected");
  Legend legend{with_squares(options.title), options.map, range, false, false};
  for (const double v : values) {
    legend.open_above = legend.open_above || v > range.high;
    legend.open_below = legend.open_below || v < range.low;
  }
  return legend;
}

}  // namespace

core::Image false_colour(const Display& display, const scene::Scene& scene, const mesh::ElementMesh& mesh,
                         std::span<const double> values, const FalseColour& options) {
  require_size(values.size(), mesh);
  const bool diverging = options.map == results::ColourMap::blue_white_red;
  const Legend legend =
      legend_of(options, options.range ? *options.range : range_of(values, areas_of(mesh), diverging), values);
  std::vector<results::Colour> colours;
  for (double v : values) colours.push_back(results::colour_of(options.map, legend.range.part(v)));
  Raster raster;
  raster.fronts = flat(mesh, colours);
  raster.faces = faces_of_polygons(scene, mesh, [](std::size_t) { return 1; });
  return false_coloured(display, scene, mesh, std::move(raster), legend, options);
}

core::Image true_colour(const Display& display, const scene::Scene& scene, const mesh::ElementMesh& mesh,
                        std::span<const std::array<double, 3>> rgb, const TrueColour& options) {
  require_size(rgb.size(), mesh);
  double bright = options.white;
  if (!(bright > 0)) {
    std::vector<double> largest;
    for (const auto& colour : rgb) largest.push_back(std::max({colour[0], colour[1], colour[2]}));
    bright = results::weighted_quantile(largest, areas_of(mesh), 0.99);
  }
  if (!(bright > 0)) bright = 1;
  Raster raster;
  if (options.smooth) {
    raster.fronts = smooth(mesh, rgb, bright);
    raster.faces = faces_of_polygons(scene, mesh, [&](std::size_t e) { return mesh.patches()[e].corners; });
  } else {
    std::vector<results::Colour> colours;
    for (const auto& colour : rgb) colours.push_back(display_colour(colour, bright));
    raster.fronts = flat(mesh, colours);
    raster.faces = faces_of_polygons(scene, mesh, [](std::size_t) { return 1; });
  }
  return true_coloured(display, scene, mesh, std::move(raster), options);
}

core::Image false_colour(const Display& display, const scene::Scene& scene, const mesh::ElementMesh& mesh,
                         const mesh::SmoothMesh& smooth, std::span<const double> of_points,
                         const FalseColour& options) {
  if (!options.range || of_points.size() != smooth.points.size())
    throw core::PreconditionError("picture: a range, and one value per point expected");
  const Legend legend = legend_of(options, *options.range, of_points);
  Raster raster;
  raster.fronts =
      curved(smooth, of_points, [&](double v) { return results::colour_of(options.map, legend.range.part(v)); });
  raster.faces = faces_of_polygons(scene, mesh, smooth, raster.fronts.sizes.size());
  return false_coloured(display, scene, mesh, std::move(raster), legend, options);
}

core::Image true_colour(const Display& display, const scene::Scene& scene, const mesh::ElementMesh& mesh,
                        const mesh::SmoothMesh& smooth, std::span<const std::array<double, 3>> of_points,
                        const TrueColour& options) {
  if (!(options.white > 0) || of_points.size() != smooth.points.size())
    throw core::PreconditionError("picture: a white, and one value per point expected");
  Raster raster;
  raster.fronts = curved(smooth, of_points, options.white);
  raster.faces = faces_of_polygons(scene, mesh, smooth, raster.fronts.sizes.size());
  return true_coloured(display, scene, mesh, std::move(raster), options);
}

}  // namespace interflect::visual
