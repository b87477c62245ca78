#pragma once

#include <filesystem>
#include <optional>

#include "apps/options.h"
#include "montecarlo/render.h"
#include "results/checkpoint.h"

namespace interflect::apps {

/// What a traced picture goes on from: NAME.checkpoint.h5 beside NAME.exr.
class PictureCheckpoint {
 public:
  PictureCheckpoint(const scene::Scene& scene, scene::CameraId camera, const TraceOptions& options,
                    const CommonOptions& common);

  const std::filesystem::path& file() const { return file_; }
  void write(const montecarlo::FilmState& state) const;
  /// @throws core::InputError  there is none, or one of another scene, or of other settings
  montecarlo::FilmState read() const;

 private:
  std::filesystem::path file_;
  results::Checkpoint of_;  ///< its digest and settings
  std::pair<Index, Index> size_;
};

montecarlo::RenderSettings render_settings(const TraceOptions& options);

}  // namespace interflect::apps
