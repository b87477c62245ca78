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

#include "core/error.h"
#include "core/format.h"

namespace interflect::visual {

namespace {

/// The scene within a unit box, because graphics cards compute in single precision.
struct Frame {
  Vec3 centre;
  double scale;
  Vec3 operator()(const Vec3& p) const { return (p - centre) * scale; }
};

Frame frame_of(const Raster& raster) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : raster.fronts.corners) box.extend(p);
  return {0.5 * (box.min() + box.max()), 1 / std::max(box.diagonal().norm(), 1e-300)};
}

vtkNew<vtkPolyData> poly_data(const Polygons& polygons, const Frame& frame) {
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
      const results::Colour& colour = polygons.colours[static_cast<std::size_t>(next)];
      points->InsertNextPoint(p.data());
      colours->InsertNextTypedTuple(colour.data());
      cells->InsertCellPoint(next);
    }
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  data->GetPointData()->SetScalars(colours);
  return data;
}

void add_polygons(vtkRenderer* renderer, const Polygons& polygons, const Frame& frame, float line_width) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(poly_data(polygons, frame));
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
  lens->SetViewAngle(camera.fov_y_deg);
  renderer->SetNearClippingPlaneTolerance(1e-3);
  renderer->ResetCameraClippingRange();
}

/// The mean of blocks of factor x factor pixels, turned upside down: VTK's rows run from the bottom.
core::Image reduced(const unsigned char* pixel, int width, int height, int factor) {
  core::Image image(width, height, {"R", "G", "B"});
  for (int y = 0; y < height * factor; ++y)
    for (int x = 0; x < width * factor; ++x, pixel += 3)
      for (int c = 0; c < 3; ++c) image.at(x / factor, height - 1 - y / factor, c) += pixel[c];
  const float scale = 1.0F / (255.0F * static_cast<float>(factor * factor));
  for (float& v : image.data) v *= scale;
  return image;
}

core::Image drawn(const Raster& raster, int factor, float line_width) {
  const int width = raster.camera.width, height = raster.camera.height;
  const Frame frame = frame_of(raster);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(width * factor, height * factor);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(raster.background[0] / 255.0, raster.background[1] / 255.0, raster.background[2] / 255.0);
  window->AddRenderer(renderer);
  add_polygons(renderer, raster.fronts, frame, line_width);
  aim(renderer, raster.camera, frame);
  window->Render();

  vtkNew<vtkUnsignedCharArray> bytes;
  window->GetPixelData(0, 0, width * factor - 1, height * factor - 1, 0, bytes);
  if (bytes->GetNumberOfValues() != vtkIdType{3} * width * height * factor * factor)
    throw core::InputError("pictures", core::format("the display cannot draw %d x %d pixels", width, height));
  return reduced(bytes->GetPointer(0), width, height, factor);
}

}  // namespace

core::Image rasterised(const Display&, const Raster& raster) {
  if (raster.fronts.sizes.empty()) throw core::PreconditionError("rasterised: at least one polygon expected");
  const int side = std::max(raster.camera.width, raster.camera.height);
  const int factor = side <= 2700 ? 3 : side <= 4000 ? 2 : 1;
  core::Image image = drawn(raster, factor, 0);
  if (!raster.edges) return image;
  const core::Image lines = drawn(raster, factor, static_cast<float>(factor * std::max(1.0, side / 1200.0)));
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = 0.75F * image.data[i] + 0.25F * lines.data[i];
  return image;
}

}  // namespace interflect::visual
