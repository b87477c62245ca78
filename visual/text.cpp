#include "visual/text.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <algorithm>

#include "core/error.h"

namespace interflect::visual {

namespace {

/// Coverage of the whole line box, from the font's highest to its lowest letter.
core::Image line_box(const std::string& text, int size, bool bold) {
  vtkTextRenderer* type = vtkTextRenderer::GetInstance();
  if (type == nullptr) throw core::PreconditionError("VTK was built without its text renderer");
  vtkNew<vtkTextProperty> property;
  property->SetFontFamilyToArial();
  property->SetFontSize(size);
  property->SetBold(bold);
  property->SetColor(1, 1, 1);
  property->SetJustificationToLeft();
  property->SetVerticalJustificationToBottom();
  constexpr int pixels_per_inch = 72;  // a point is a pixel
  int used[2] = {0, 0};
  vtkNew<vtkImageData> drawn;
  if (!type->RenderString(property, text, drawn, used, pixels_per_inch, vtkTextRenderer::FreeType)) return {};
  int extent[6];
  drawn->GetExtent(extent);
  const int width = std::min(used[0], extent[1] - extent[0] + 1), height = std::min(used[1], extent[3] - extent[2] + 1);
  if (width < 1 || height < 1) return {};
  core::Image coverage(width, height, {"coverage"});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto* rgba =
          static_cast<const unsigned char*>(drawn->GetScalarPointer(extent[0] + x, extent[2] + height - 1 - y, 0));
      coverage.at(x, y, 0) = static_cast<float>(rgba[3]) / 255.0F;
    }
  return coverage;
}

/// Rows from the base line down to the bottom of the line box: below an H there is nothing.
int descent(int size, bool bold) {
  const core::Image letter = line_box("H", size, bold);
  for (int y = letter.height - 1; y >= 0; --y)
    for (int x = 0; x < letter.width; ++x)
      if (letter.at(x, y, 0) > 0.5F) return letter.height - 1 - y;
  return 0;
}

}  // namespace

TextLine set_in_type(const std::string& text, int size, bool bold) {
  TextLine line;
  if (text.empty()) return line;
  line.coverage = line_box(text, size, bold);
  line.width = line.coverage.width;
  line.height = line.coverage.height;
  line.ascent = line.height - descent(size, bold);
  return line;
}

void draw_text(core::Image& picture, const TextLine& line, int x, int base, results::Colour colour) {
  for (int row = 0; row < line.height; ++row)
    for (int column = 0; column < line.width; ++column) {
      const int at_x = x + column, at_y = base - line.ascent + row;
      if (at_x < 0 || at_y < 0 || at_x >= picture.width || at_y >= picture.height) continue;
      const float ink = line.coverage.at(column, row, 0);
      for (int c = 0; c < 3; ++c) {
        float& v = picture.at(at_x, at_y, c);
        v += ink * (static_cast<float>(colour[static_cast<std::size_t>(c)]) / 255.0F - v);
      }
    }
}

}  // namespace interflect::visual
