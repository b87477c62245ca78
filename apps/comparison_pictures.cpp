#include "apps/comparison_pictures.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "apps/camera_pictures.h"
#include "apps/pictures.h"
#include "core/error.h"
#include "core/format.h"
#include "core/log.h"
#include "montecarlo/integrators.h"
#include "montecarlo/render.h"
#include "results/comparison_panels.h"
#include "results/image_file.h"
#include "scene/io/json_document.h"
#include "scene/io/text_file.h"

namespace interflect::apps {
namespace {

using montecarlo::Rendering;

constexpr double difference_scale = 0.1;  ///< relative difference at full colour

/// A picture and whose it is.
struct Drawn {
  std::string by;
  Rendering picture;
};

std::string compared_file(const std::string& a, const std::string& b) {
  return core::format("compared_%s_%s.png", a.c_str(), b.c_str());
}

/// The samples asked for, or a few more of those whose samples come in sixteen copies.
std::uint64_t samples_of(const std::string& integrator, const CompareOptions& options) {
  const auto samples = static_cast<std::uint64_t>(options.samples);
  constexpr std::uint64_t copies = montecarlo::sequence_batches;
  return montecarlo::integrator_entry(integrator).by_quadrature ? (samples + copies - 1) / copies * copies : samples;
}

/// @throws core::InputError   it does not find what is asked for
/// @throws core::Interrupted  before every pixel had a sample
Rendering rendered(const scene::Scene& scene, scene::CameraId camera, const std::string& integrator,
                   const FirstPass& first_pass, const CompareOptions& options, const raycast::RayCaster& rays,
                   Run& run) {
  montecarlo::RenderSettings settings;
  settings.integrator = integrator;
  settings.samples = samples_of(integrator, options);
  settings.paths = measure::PathClasses::of(options.paths);
  settings.solution = first_pass.solution();
  return montecarlo::render(scene, camera, settings, run, rays);
}

core::Image beside(const scene::Scene& scene, const Drawn& drawn, const Drawn& first) {
  core::Image noise = drawn.picture.standard_error;
  for (std::size_t k = 0; k < noise.data.size(); ++k)
    noise.data[k] = std::hypot(noise.data[k], first.picture.standard_error.data[k]);
  const auto panels =
      results::comparison_panels(scene, drawn.picture.radiance, first.picture.radiance, noise, difference_scale);
  return beside_each_other(
      panels,
      {drawn.by + ", " + core::format_count(drawn.picture.samples) + " samples a pixel", first.by,
       core::format("(%s - %s) / mean, white within 3 standard errors", drawn.by.c_str(), first.by.c_str())},
      difference_scale);
}

/// All that a comparison can leave, by whichever integrators.
std::vector<std::string> possible_files() {
  std::vector<std::string> files;
  for (const std::string& a : montecarlo::integrator_names()) {
    for (const char* extension : {".exr", ".png"}) files.push_back(a + extension);
    for (const std::string& b : montecarlo::integrator_names()) files.push_back(compared_file(a, b));
  }
  return files;
}

/// What the record in the folder says that its run drew; nothing where there is none that can be read.
std::vector<std::string> drawn_before(const std::filesystem::path& record) try {
  const scene::io::JsonDocument document(scene::io::read_bytes(record, record.string()), record.string());
  std::vector<std::string> files;
  for (const scene::io::JsonNode& file : document.root().at("pictures").items()) files.push_back(file.string());
  return files;
} catch (const core::InputError&) {
  return {};
}

/// Draws them one by one.
class Artist {
 public:
  Artist(const scene::Scene& scene, scene::CameraId camera, const FirstPass& first_pass, const CompareOptions& options,
         Run& run)
      : scene_(scene),
        camera_(camera),
        first_pass_(first_pass),
        options_(options),
        run_(run),
        rays_(raycast::make_ray_caster(options.intersector, scene)) {}

  /// @throws core::Interrupted  before there is a picture
  void draw(const std::string& name) {
    run_.throw_if_stopped("pictures");
    Drawn drawn{name, {}};
    try {
      drawn.picture = rendered(scene_, camera_, name, first_pass_, options_, *rays_, run_);
    } catch (const core::InputError& error) {
      core::log::warning("no picture by " + name + ": " + error.what());
      return;
    }
    if (!drawn.picture.complete)
      core::log::warning(core::format("stopped: the picture by %s has %llu samples a pixel", name.c_str(),
                                      static_cast<unsigned long long>(drawn.picture.samples)));
    results::write_image(file(name + ".exr"), with_errors_and_samples(drawn.picture));
    results::write_image(file(name + ".png"), results::as_rgb(scene_, drawn.picture.radiance));
    if (first_)
      results::write_png(file(compared_file(name, first_->by)), beside(scene_, drawn, *first_));
    else
      first_ = std::move(drawn);
  }

  const std::vector<std::string>& files() const { return files_; }

 private:
  std::filesystem::path file(const std::string& name) {
    files_.push_back(name);
    return options_.out / name;
  }

  const scene::Scene& scene_;
  scene::CameraId camera_;
  const FirstPass& first_pass_;
  const CompareOptions& options_;
  Run& run_;
  std::unique_ptr<raycast::RayCaster> rays_;
  std::optional<Drawn> first_;
  std::vector<std::string> files_;
};

}  // namespace

void remove_comparison_pictures(const std::filesystem::path& folder) {
  const std::vector<std::string> possible = possible_files();
  for (const std::string& file : drawn_before(folder / "compare.json")) {
    // A record can be written by anyone: nothing is removed that no comparison draws.
    if (std::ranges::find(possible, file) == possible.end()) continue;
    std::error_code error;
    std::filesystem::remove(folder / file, error);
    if (error) core::log::warning((folder / file).string() + ": of an earlier comparison: " + error.message());
  }
}

std::vector<std::string> write_comparison_pictures(const scene::Scene& scene, scene::CameraId camera,
                                                   const std::vector<std::string>& names, const FirstPass& first_pass,
                                                   const CompareOptions& options, Run& run) {
  Artist artist(scene, camera, first_pass, options, run);
  try {
    for (const std::string& name : names) artist.draw(name);
  } catch (const core::Interrupted&) {
    core::log::warning("stopped: not every picture was drawn");
  }
  return artist.files();
}

}  // namespace interflect::apps
