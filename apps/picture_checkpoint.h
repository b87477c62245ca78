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
  /// Whether it is this run's: that which it has written or goes on from.  Another that lies there is of another run.
  bool is_own() const { return own_; }
  void write(const montecarlo::FilmState& state);
  /// @throws core::InputError  there is none, or one of another scene, or of other settings
  montecarlo::FilmState read();
  /// Of a picture that needs it no more: this run's own, if there is one.  Warns where it cannot be removed.
  void remove();

 private:
  std::filesystem::path file_;
  bool own_ = false;
  results::Checkpoint of_;  ///< its digest and settings
  std::pair<Index, Index> size_;
};

montecarlo::RenderSettings render_settings(const TraceOptions& options);

}  // namespace interflect::apps
