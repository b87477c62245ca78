#include "results/comparison_panels.h"

#include "core/error.h"
#include "results/colour_map.h"
#include "results/tone_mapping.h"

namespace interflect::results {

namespace {

constexpr int block = 6;  // pixels of a side

core::Image block_means(const scene::Scene& scene, const core::Image& image) {
  core::Image means((image.width + block - 1) / block, (image.height + block - 1) / block, {"Y", "pixels"});
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      means.at(x / block, y / block, 0) += static_cast<float>(scene.weigh(image.pixel(x, y)));
      means.at(x / block, y / block, 1) += 1;
    }
  for (int y = 0; y < means.height; ++y)
    for (int x = 0; x < means.width; ++x) means.at(x, y, 0) /= means.at(x, y, 1);
  return means;
}

/// Where both are dark they agree.
double relative_difference(double fem, double traced) {
  const double mean = 0.5 * (fem + traced);
  return mean > 0 ? (fem - traced) / mean : 0;
}

core::Image difference_panel(const scene::Scene& scene, const core::Image& fem, const core::Image& traced,
                             double full_scale) {
  const core::Image a = block_means(scene, fem), b = block_means(scene, traced);
  core::Image picture(fem.width, fem.height, {"R", "G", "B"});
  for (int y = 0; y < fem.height; ++y)
    for (int x = 0; x < fem.width; ++x) {
      const double difference = relative_difference(static_cast<double>(a.at(x / block, y / block, 0)),
                                                    static_cast<double>(b.at(x / block, y / block, 0)));
      const Colour colour = colour_of(ColourMap::blue_white_red, 0.5 + 0.5 * difference / full_scale);
      for (int c = 0; c < 3; ++c)
        picture.at(x, y, c) = static_cast<float>(colour[static_cast<std::size_t>(c)]) / 255.0F;
    }
  return picture;
}

}  // namespace

ComparisonPanels comparison_panels(const scene::Scene& scene, const core::Image& fem, const core::Image& traced,
                                   double full_scale) {
  if (fem.width != traced.width || fem.height != traced.height || !(full_scale > 0))
    throw core::PreconditionError("comparison_panels: pictures of one size and a scale above 0 expected");
  const core::Image left = as_rgb(scene, fem), right = as_rgb(scene, traced);
  const ToneMapping tone{.white = white_of(right)};
  return {tone_mapped(left, tone), tone_mapped(right, tone), difference_panel(scene, fem, traced, full_scale)};
}

}  // namespace interflect::results
