#include "apps/comparison_pictures.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <regex>

#include "apps/camera_pictures.h"
#include "apps/pictures.h"
#include "core/error.h"
#include "core/format.h"
#include "core/log.h"
#include "core/processor_time.h"
#include "montecarlo/integrators.h"
#include "montecarlo/render.h"
#include "results/comparison_panels.h"
#include "results/difference_layers.h"
#include "results/image_file.h"
#include "scene/io/json_document.h"
#include "scene/io/text_file.h"

namespace interflect::apps {
namespace {

using montecarlo::Rendering;

constexpr double difference_scale = 0.1;  ///< relative difference at full colour
constexpr const char* not_begun = "stopped before it was drawn";

/// ", but ASE": what the reader must not take for found.
std::string but(const PicturePaths& of) { return of.missed.empty() ? "" : ", but " + of.missed; }

/// Without an extension.  A part has another name than the whole.
std::string file_of(const std::string& integrator, const PicturePaths& of) {
  return of.missed.empty() ? integrator : integrator + "_but_" + of.missed;
}

/// The samples asked for, or a few more of those whose samples come in sixteen copies.
std::uint64_t samples_of(const std::string& integrator, const CompareOptions& options) {
  const auto samples = static_cast<std::uint64_t>(options.samples);
  constexpr std::uint64_t copies = montecarlo::sequence_batches;
  return montecarlo::integrator_entry(integrator).by_quadrature ? (samples + copies - 1) / copies * copies : samples;
}

/// Whether errors are those of a rule or of a solution, which neighbours have in common, not of samples of their own.
bool shares_errors(const std::string& integrator) {
  const montecarlo::IntegratorEntry& entry = montecarlo::integrator_entry(integrator);
  return entry.by_quadrature || entry.inherits_error;
}

results::ComparisonPanels panels_of(const scene::Scene& scene, const DifferenceDrawn& told, const Rendering& a,
                                    const Rendering& b) {
  core::Image own(a.radiance.width, a.radiance.height, a.radiance.channels), shared = own;
  const auto add = [&](const std::string& integrator, const core::Image& error) {
    core::Image& sum = shares_errors(integrator) ? shared : own;
    for (std::size_t k = 0; k < sum.data.size(); ++k) sum.data[k] = std::hypot(sum.data[k], error.data[k]);
  };
  add(told.a, a.standard_error);
  add(told.b, b.standard_error);
  return results::comparison_panels(scene, a.radiance, b.radiance, own, difference_scale, &shared);
}

core::Image beside(const results::ComparisonPanels& panels, const DifferenceDrawn& told, std::uint64_t samples) {
  return beside_each_other(
      panels,
      {told.a + but(told.of) + ", " + core::format_count(samples) + " samples a pixel", told.b + but(told.of),
       core::format("(%s - %s) / mean, white within 3 standard errors%s", told.a.c_str(), told.b.c_str(),
                    told.is_beyond_errors() ? ": more than they explain" : "")},
      difference_scale);
}

/// Light that errors of one picture or the other do not know of.
std::string rare_light(const DifferenceDrawn& told, const Rendering& a, const Rendering& b) {
  std::string text;
  for (const auto& [by, of] : {std::pair{&told.a, &a}, {&told.b, &b}})
    if (!of->report.rare.empty()) text += (text.empty() ? "" : "; ") + *by + ": " + of->report.rare;
  return text;
}

/// Whether it is the name of what a comparison draws, by whichever integrators.
bool is_drawn_by_comparisons(const std::string& file) {
  std::string any;
  for (const std::string& name : montecarlo::integrator_names()) any += (any.empty() ? "(" : "|") + name;
  any += ")";
  return std::regex_match(file, std::regex("(" + any + "(_but_[A-Z]+)?|compared_" + any + "_" + any + ")\\.(exr|png)"));
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
  Artist(const scene::Scene& scene, scene::CameraId camera, const std::vector<std::string>& names,
         const FirstPass& first_pass, const CompareOptions& options, Run& run)
      : scene_(scene),
        camera_(camera),
        paths_(scene, camera, measure::PathClasses::of(options.paths)),
        options_(options),
        run_(run),
        solution_(first_pass.solution()),
        rays_(raycast::make_ray_caster(options.intersector, scene)),
        own_(names.size()) {
    for (const std::string& name : names) drawn_.pictures.push_back({name, paths_.found_by(name), not_begun});
    for (std::size_t a = 0; a < names.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) add_pair(a, b);
  }

  /// Pictures first, with the differences of those that are of the same paths; then what takes pictures once more.
  /// @throws core::Interrupted  before all are drawn
  void draw() {
    const core::ProcessorTime timed(drawn_.processor_seconds);
    for (std::size_t k = 0; k < own_.size(); ++k) {
      draw_own(k);
      for (std::size_t p = 0; p < pairs_.size(); ++p)
        if (pairs_[p].a == k && is_of_own(p)) write_difference(p, *own_[k], *own_[pairs_[p].b]);
    }
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if (is_to_come(p)) draw_on(drawn_.differences[p].of);
  }

  const PicturesDrawn& drawn() const { return drawn_; }

 private:
  struct Pair {
    std::size_t a, b;  ///< integrators
  };
  using Again = std::vector<std::optional<Rendering>>;  ///< by integrator

  void add_pair(std::size_t a, std::size_t b) {
    const PictureDrawn &of_a = drawn_.pictures[a], &of_b = drawn_.pictures[b];
    const PicturePaths common = paths_.found_by_both(of_a.of, of_b.of);
    if (paths_.none(common.paths)) return;
    pairs_.push_back({a, b});
    drawn_.differences.push_back({of_a.by, of_b.by, common, not_begun});
  }

  bool is_own(std::size_t k, const PicturePaths& of) const {
    return own_[k] && paths_.are_same(drawn_.pictures[k].of.paths, of.paths);
  }
  bool is_of_own(std::size_t p) const {
    const PicturePaths& of = drawn_.differences[p].of;
    return is_own(pairs_[p].a, of) && is_own(pairs_[p].b, of);
  }
  bool is_to_come(std::size_t p) const {
    return own_[pairs_[p].a] && own_[pairs_[p].b] && drawn_.differences[p].refused == not_begun;
  }

  /// @throws core::InputError   it does not find what is asked for
  /// @throws core::Interrupted  before every pixel had a sample
  Rendering rendered(std::size_t k, const PicturePaths& of) {
    run_.throw_if_stopped("pictures");
    const std::string& integrator = drawn_.pictures[k].by;
    montecarlo::RenderSettings settings;
    settings.integrator = integrator;
    settings.samples = samples_of(integrator, options_);
    settings.paths = of.paths;
    settings.solution = solution_;
    core::Progress progress(run_.progress, "pictures: " + integrator + but(of));
    Run labelled{run_.seed, run_.threads, progress, run_.stop, run_.late};
    Rendering picture = montecarlo::render(scene_, camera_, settings, labelled, *rays_);
    if (!picture.complete)
      core::log::warning(core::format("stopped: the picture by %s%s has %llu samples a pixel", integrator.c_str(),
                                      but(of).c_str(), static_cast<unsigned long long>(picture.samples)));
    return picture;
  }

  void draw_own(std::size_t k) {
    PictureDrawn& told = drawn_.pictures[k];
    try {
      if (paths_.none(told.of.paths) && !told.of.missed.empty())
        throw core::InputError("finds none of these paths, " + told.of.missed);
      own_[k] = rendered(k, told.of);
    } catch (const core::InputError& error) {
      refuse(k, error.what());
      return;
    }
    told.samples = own_[k]->samples;
    told.complete = own_[k]->complete;
    told.report = own_[k]->report;
    told.heavy = told.report.heavy_text_of_picture(own_[k]->radiance.width, own_[k]->radiance.height);
    told.refused.clear();
    const std::string name = file_of(told.by, told.of);
    results::write_image(file(name + ".exr", told.files), with_errors_and_samples(*own_[k]));
    results::write_image(file(name + ".png", told.files), results::as_rgb(scene_, own_[k]->radiance));
  }

  void refuse(std::size_t k, const std::string& why) {
    PictureDrawn& told = drawn_.pictures[k];
    told.refused = why;
    core::log::warning("no picture by " + told.by + ": " + why);
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if (pairs_[p].a == k || pairs_[p].b == k) drawn_.differences[p].refused = "no picture by " + told.by;
  }

  /// All differences of pictures of these paths.  Those drawn again for them are kept no longer.
  void draw_on(const PicturePaths& of) {
    Again again(own_.size());
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      if (!is_to_come(p) || !paths_.are_same(drawn_.differences[p].of.paths, of.paths)) continue;
      const auto [a, b] = pairs_[p];
      if (draws_on_these(a, of, again, p) && draws_on_these(b, of, again, p))
        write_difference(p, on_these(a, of, again), on_these(b, of, again));
    }
  }

  /// Draws it once more where its own picture is of others.
  bool draws_on_these(std::size_t k, const PicturePaths& of, Again& again, std::size_t p) {
    DifferenceDrawn& told = drawn_.differences[p];
    try {
      if (!is_own(k, of) && !again[k]) again[k] = rendered(k, of);
      return true;
    } catch (const core::InputError& error) {
      told.refused = error.what();
      core::log::warning("no difference of " + told.a + " and " + told.b + ": " + told.refused);
      return false;
    }
  }
  const Rendering& on_these(std::size_t k, const PicturePaths& of, const Again& again) const {
    return is_own(k, of) ? *own_[k] : *again[k];
  }

  void write_difference(std::size_t p, const Rendering& a, const Rendering& b) {
    DifferenceDrawn& told = drawn_.differences[p];
    told.samples = std::min(a.samples, b.samples);
    told.complete = a.complete && b.complete;
    told.refused.clear();
    const std::string name = "compared_" + told.a + "_" + told.b;
    const results::ComparisonPanels panels = panels_of(scene_, told, a, b);
    told.apart = panels.apart;
    told.rare = rare_light(told, a, b);
    results::write_png(file(name + ".png", told.files), beside(panels, told, a.samples));
    results::write_image(file(name + ".exr", told.files),
                         results::difference_layers({a.radiance, a.standard_error}, {b.radiance, b.standard_error}));
  }

  std::filesystem::path file(const std::string& name, std::vector<std::string>& files) const {
    files.push_back(name);
    return options_.out / name;
  }

  const scene::Scene& scene_;
  scene::CameraId camera_;
  ComparedPaths paths_;
  const CompareOptions& options_;
  Run& run_;
  measure::SurfaceSolution solution_;
  std::unique_ptr<raycast::RayCaster> rays_;
  Again own_;                ///< each one's picture of what it finds
  std::vector<Pair> pairs_;  ///< as drawn_.differences
  PicturesDrawn drawn_;
};

}  // namespace

std::vector<std::string> PicturesDrawn::files() const {
  std::vector<std::string> all;
  for (const PictureDrawn& each : pictures) all.insert(all.end(), each.files.begin(), each.files.end());
  for (const DifferenceDrawn& each : differences) all.insert(all.end(), each.files.begin(), each.files.end());
  return all;
}

void remove_comparison_pictures(const std::filesystem::path& folder) {
  for (const std::string& file : drawn_before(folder / "compare.json")) {
    // A record can be written by anyone: nothing is removed that no comparison draws.
    if (!is_drawn_by_comparisons(file)) continue;
    std::error_code error;
    std::filesystem::remove(folder / file, error);
    if (error) core::log::warning((folder / file).string() + ": of an earlier comparison: " + error.message());
  }
}

PicturesDrawn write_comparison_pictures(const scene::Scene& scene, scene::CameraId camera,
                                        const std::vector<std::string>& names, const FirstPass& first_pass,
                                        const CompareOptions& options, Run& run) {
  Artist artist(scene, camera, names, first_pass, options, run);
  try {
    artist.draw();
  } catch (const core::Interrupted&) {
    core::log::warning("stopped: not every picture was drawn");
  }
  return artist.drawn();
}

}  // namespace interflect::apps
