#include "visual/raster.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/error.h"
#include "core/format.h"
#include "visual/film_heaps.h"
#include "visual/hatching.h"

namespace interflect::visual {

namespace {

using results::Colour;

/// The scene within a unit box, because graphics cards compute in single precision.
struct Frame {
  Vec3 centre;
  double scale;
  Vec3 operator()(const Vec3& p) const { return (p - centre) * scale; }
};

Frame frame_of(const Raster& raster) {
  Eigen::AlignedBox3d box;
  for (const Polygons* each : {&raster.fronts, &raster.bare.polygons})
    for (const Vec3& p : each->corners) box.extend(p);
  for (const Polygons& body : raster.clear)
    for (const Vec3& p : body.corners) box.extend(p);
  return {0.5 * (box.min() + box.max()), 1 / std::max(box.diagonal().norm(), 1e-300)};
}

vtkNew<vtkPolyData> poly_data(const Polygons& polygons, std::span<const Colour> colour_of, const Frame& frame) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  vtkIdType next = 0;
  for (std::uint8_t size : polygons.sizes) {
    cells->InsertNextCell(size);
    for (int k = 0; k < size; ++k, ++next) {
      const Vec3 p = frame(polygons.corners[static_cast<std::size_t>(next)]);
      points->InsertNextPoint(p.data());
      colours->InsertNextTypedTuple(colour_of[static_cast<std::size_t>(next)].data());
      cells->InsertCellPoint(next);
    }
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  data->GetPointData()->SetScalars(colours);
  return data;
}

void add_polygons(vtkRenderer* renderer, vtkPolyData* polygons, float line_width) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(polygons);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkProperty* property = actor->GetProperty();
  property->LightingOff();
  property->SetInterpolationToFlat();
  property->BackfaceCullingOn();
  property->SetEdgeVisibility(line_width > 0);
  property->SetEdgeColor(0, 0, 0);
  property->SetLineWidth(line_width);
  renderer->AddActor(actor);
}

void aim(vtkRenderer* renderer, const scene::Camera& camera, const Frame& frame) {
  vtkCamera* lens = renderer->GetActiveCamera();
  const Vec3 eye = frame(camera.eye), target = frame(camera.target);
  lens->SetPosition(eye.data());
  lens->SetFocalPoint(target.data());
  lens->SetViewUp(camera.up.data());
  lens->SetViewAngle(std::get<scene::Pinhole>(camera.projection).fov_y_deg);
  renderer->SetNearClippingPlaneTolerance(1e-3);
  renderer->ResetCameraClippingRange();
}

/// Polygons in colours of corners.
struct Drawing {
  const Polygons& polygons;
  std::span<const Colour> colours;
  float line_width = 0;  ///< of their edges
};

/// Colours alone, factor x factor a pixel.
Samples drawn(const Raster& raster, std::span<const Drawing> drawings, Colour background, int factor) {
  const int width = raster.camera.width * factor, height = raster.camera.height * factor;
  const Frame frame = frame_of(raster);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(width, height);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(background[0] / 255.0, background[1] / 255.0, background[2] / 255.0);
  window->AddRenderer(renderer);
  for (const Drawing& each : drawings)
    if (!each.polygons.sizes.empty())
      add_polygons(renderer, poly_data(each.polygons, each.colours, frame), each.line_width);
  aim(renderer, raster.camera, frame);
  window->Render();

  vtkNew<vtkUnsignedCharArray> bytes;
  window->GetPixelData(0, 0, width - 1, height - 1, 0, bytes);
  if (bytes->GetNumberOfValues() != vtkIdType{3} * width * height)
    throw core::InputError(
        "pictures", core::format("the display cannot draw %d x %d pixels", raster.camera.width, raster.camera.height));
  Samples samples{width, height, {}, {}};
  samples.colours.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const unsigned char* byte = bytes->GetPointer(0);
  for (int y = height - 1; y >= 0; --y)  // VTK's rows run from the bottom
    for (int x = 0; x < width; ++x, byte += 3) samples.colours[samples.place(x, y)] = {byte[0], byte[1], byte[2]};
  return samples;
}

/// Faces are drawn like colours: six bits a channel, so that one that is rounded to its neighbour is still read.
constexpr std::uint32_t last_code = (1U << 18) - 1;  ///< of nothing
Colour colour_of_code(std::uint32_t code) {
  const auto channel = [&](int shift) { return static_cast<std::uint8_t>(4 * ((code >> shift) & 63U) + 2); };
  return {channel(12), channel(6), channel(0)};
}
std::uint32_t code_of_colour(const Colour& c) {
  return (std::uint32_t{c[0]} >> 2) << 12 | (std::uint32_t{c[1]} >> 2) << 6 | std::uint32_t{c[2]} >> 2;
}

/// The code of each corner's face.  Of more than a quarter of a million faces some share a number; none that is hatched
/// with one that is not.
std::vector<Colour> codes_of(const Polygons& polygons, std::span<const std::uint32_t> faces, std::uint32_t hatched) {
  std::vector<Colour> codes;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const std::uint32_t face = faces[k];
    codes.insert(codes.end(), polygons.sizes[k],
                 colour_of_code(face == Samples::back || face <= hatched
                                    ? face
                                    : hatched + 1 + (face - 1 - hatched) % (last_code - 1 - hatched)));
  }
  return codes;
}

std::vector<std::uint32_t> faces_in(const Raster& raster, int factor) {
  const auto codes = [&](const Polygons& polygons, std::span<const std::uint32_t> faces) {
    return codes_of(polygons, faces, raster.hatched);
  };
  const std::vector<Colour> fronts = codes(raster.fronts, raster.faces),
                            bare = codes(raster.bare.polygons, raster.bare.faces);
  const std::array drawings{Drawing{raster.fronts, fronts}, Drawing{raster.bare.polygons, bare}};
  std::vector<std::uint32_t> faces;
  for (const Colour& colour : drawn(raster, drawings, colour_of_code(last_code), factor).colours) {
    const std::uint32_t code = code_of_colour(colour);
    faces.push_back(code == last_code ? Samples::nothing : code);
  }
  return faces;
}

/// Where each body of a heap is seen: all that is not clear hides it, and nothing else.
std::vector<std::uint8_t> clear_bodies_in(const Raster& raster, std::span<const std::size_t> heap, int factor) {
  constexpr std::size_t most = 255;  // of more some share a number
  const std::vector<Colour> hidden(std::max(raster.fronts.corners.size(), raster.bare.polygons.corners.size()),
                                   colour_of_code(0));
  std::vector<std::vector<Colour>> codes;
  std::vector<Drawing> drawings{{raster.fronts, hidden}, {raster.bare.polygons, hidden}};
  for (const std::size_t body : heap)
    codes.emplace_back(raster.clear[body].corners.size(), colour_of_code(1 + static_cast<std::uint32_t>(body % most)));
  for (std::size_t k = 0; k < heap.size(); ++k) drawings.push_back({raster.clear[heap[k]], codes[k]});
  std::vector<std::uint8_t> bodies;
  for (const Colour& colour : drawn(raster, drawings, colour_of_code(0), factor).colours)
    bodies.push_back(static_cast<std::uint8_t>(code_of_colour(colour)));
  return bodies;
}

Colour mixed(const Colour& a, const Colour& b, double part_of_b) {
  Colour out;
  for (std::size_t c = 0; c < 3; ++c) out[c] = static_cast<std::uint8_t>(std::lround(a[c] + part_of_b * (b[c] - a[c])));
  return out;
}

/// The mean of blocks of factor x factor samples.
core::Image reduced(const Samples& samples, int factor) {
  core::Image image(samples.width / factor, samples.height / factor, {"R", "G", "B"});
  for (int y = 0; y < samples.height; ++y)
    for (int x = 0; x < samples.width; ++x)
      for (int c = 0; c < 3; ++c)
        image.at(x / factor, y / factor, c) += samples.colours[samples.place(x, y)][static_cast<std::size_t>(c)];
  const float scale = 1.0F / (255.0F * static_cast<float>(factor * factor));
  for (float& v : image.data) v *= scale;
  return image;
}

/// Of a picture of 800 pixels a side: one sample of a third of a pixel on each side.
int reach_of_outlines(int side, int factor) {
  return std::max(1, static_cast<int>(std::lround(factor * side / 2400.0)));
}

/// From stripe to stripe, of a picture of 800 pixels a side eight of them; of a small one no fewer than four.
int period_of_hatching(int side, int factor) { return factor * std::max(4, side / 100); }

/// All but what is clear.
/// @param line_width  of elements' edges
Samples coloured(const Raster& raster, int factor, float line_width) {
  const std::array drawings{Drawing{raster.fronts, raster.fronts.colours, line_width},
                            Drawing{raster.bare.polygons, raster.bare.polygons.colours}};
  return drawn(raster, drawings, raster.background, factor);
}

}  // namespace

core::Image rasterised(const Display&, const Raster& raster, bool* any_hatched) {
  if (raster.fronts.sizes.empty()) throw core::PreconditionError("rasterised: at least one polygon expected");
  if (!raster.faces.empty() && raster.faces.size() != raster.fronts.sizes.size())
    throw core::PreconditionError("rasterised: a face per polygon expected");
  const int side = std::max(raster.camera.width, raster.camera.height);
  const int factor = side <= 2700 ? 3 : side <= 4000 ? 2 : 1;
  Samples samples = coloured(raster, factor, 0);
  if (raster.edges) {
    const auto width = static_cast<float>(factor * std::max(1.0, side / 1200.0));
    const Samples lines = coloured(raster, factor, width);
    for (std::size_t i = 0; i < lines.colours.size(); ++i)
      samples.colours[i] = mixed(samples.colours[i], lines.colours[i], 0.25);
  }
  if (!raster.faces.empty()) {
    constexpr int pixels_enough = 64;
    constexpr std::size_t most_heaps = 8;  // each is drawn and kept; what stands behind as many may stay hidden
    samples.faces = faces_in(raster, factor);
    for (const std::vector<std::size_t>& heap : film_heaps(raster.clear, raster.camera, most_heaps))
      samples.clear.push_back(clear_bodies_in(raster, heap, factor));
    leave_out_specks(samples);
    const bool any = hatching::hatch(samples, raster.hatched, period_of_hatching(side, factor));
    if (any_hatched != nullptr) *any_hatched = any;
    draw_outlines(samples, reach_of_outlines(side, factor), pixels_enough * factor * factor, raster.outlines);
  }
  return reduced(samples, factor);
}

}  // namespace interflect::visual
