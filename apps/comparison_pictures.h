#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/comparison_paths.h"
#include "apps/first_pass.h"
#include "apps/options.h"
#include "core/run.h"
#include "montecarlo/sample_report.h"
#include "results/comparison_panels.h"
#include "scene/scene.h"

namespace interflect::apps {

/// What an integrator drew.
struct PictureDrawn {
  std::string by;
  PicturePaths of;
  std::string refused;               ///< why there is none; empty: there is one
  std::vector<std::string> files{};  ///< their names
  std::uint64_t samples = 0;         ///< a pixel
  bool complete = false;             ///< it has all samples that were asked for
  montecarlo::SampleReport report{};
  std::string heavy{};  ///< of those, where one sample is much (SampleReport::heavy_text_of_picture)
};

/// How two of them differ on the paths that both find, a - b.
struct DifferenceDrawn {
  std::string a, b;
  PicturePaths of;
  std::string refused;
  std::vector<std::string> files{};
  std::uint64_t samples = 0;  ///< a pixel, of the picture of these paths that has fewer
  bool complete = false;      ///< both of them
  results::BlocksApart apart{};
  std::string rare{};  ///< light that errors of one or the other do not know of; empty: none

  /// Errors of fewer samples a block are not known well enough to judge by.
  static constexpr std::uint64_t fewest_samples = 500;
  bool is_judged() const { return samples * results::BlocksApart::side * results::BlocksApart::side >= fewest_samples; }
  bool is_beyond_errors() const { return is_judged() && !apart.is_explained(); }
};

struct PicturesDrawn {
  std::vector<PictureDrawn> pictures;        ///< in the order of the integrators
  std::vector<DifferenceDrawn> differences;  ///< of each that has paths in common with one before it
  double processor_seconds = 0;              ///< of all threads, for all of them

  std::vector<std::string> files() const;
};

/// Removes what an earlier comparison left in the folder, by its compare.json: pictures that this one does not write
/// would look like its own.  Those of other commands stay.
void remove_comparison_pictures(const std::filesystem::path& folder);

/// NAME.exr and NAME.png of each integrator, NAME_but_MISSED of one that finds a part of what is asked for; and of each
/// pair compared_NAME_EARLIER.png, both beside each other and what differs, and .exr, what differs in numbers, on the
/// paths that both find: who found more is drawn once more for each set of such paths.  They grow sample by sample, as
/// those of `trace`: where the run is stopped, the one at work is kept with the samples that it has, and those to come
/// are not drawn.  Who refuses is told of in a warning.
PicturesDrawn write_comparison_pictures(const scene::Scene& scene, scene::CameraId camera,
                                        const std::vector<std::string>& names, const FirstPass& first_pass,
                                        const CompareOptions& options, Run& run);

}  // namespace interflect::apps
