#include "apps/pictures.h"

#include "apps/camera_pictures.h"
#include "core/error.h"
#include "core/format.h"
#include "core/log.h"
#include "montecarlo/render.h"
#include "results/comparison_panels.h"
#include "results/image_file.h"
#ifdef INTERFLECT_WITH_VTK
#include "visual/comparison_picture.h"
#endif

namespace interflect::apps {
namespace {

constexpr double difference_scale = 0.1;  ///< relative difference at full colour

}  // namespace

core::Image beside_each_other(const results::ComparisonPanels& panels,
                              [[maybe_unused]] const std::array<std::string, 3>& titles,
                              [[maybe_unused]] double full_scale) {
#ifdef INTERFLECT_WITH_VTK
  return visual::comparison_picture(panels, titles, full_scale);
#else
  constexpr int gap = 8;  // pixels
  return core::side_by_side({panels.fem, panels.traced, panels.difference}, gap);
#endif
}

std::string picture_file(const std::string& name, std::size_t camera) {
  return camera == 0 ? name + ".png" : core::format("%s_%zu.png", name.c_str(), camera + 1);
}

void write_comparisons(const SolvedScene& solved, const ValidateOptions& options, Run& run) try {
  for (std::uint32_t c = 0; c < solved.scene.cameras.size(); ++c) {
    run.throw_if_stopped("pictures");
    if (const scene::Camera& camera = solved.scene.cameras[c]; camera.has_lens()) {
      core::log::warning("camera '" + camera.name + "': radiosity knows no thin lens: no picture to compare");
      continue;
    }
    const core::Image fem = picture_of(solved.method(), solved.scene, {c}, run).radiance;
    const auto samples = static_cast<std::uint64_t>(options.picture_samples);
    const montecarlo::Rendering traced =
        montecarlo::render(solved.scene, {c}, samples, run, options.solve.settings.intersector);
    const auto panels =
        results::comparison_panels(solved.scene, fem, traced.radiance, traced.standard_error, difference_scale);
    results::write_png(options.solve.out / picture_file("validation", c),
                       beside_each_other(panels,
                                         {"radiosity, element by element",
                                          "path traced, " + core::format_count(traced.samples) + " samples a pixel",
                                          "(radiosity - path traced) / mean, white within 3 standard errors"},
                                         difference_scale));
  }
} catch (const core::Interrupted&) {
  core::log::warning("stopped: not every picture was drawn");
}

}  // namespace interflect::apps
