#pragma once

#include <functional>

#include "core/run.h"
#include "montecarlo/film/film.h"
#include "montecarlo/film/reconstruction_filter.h"
#include "scene/scene.h"

namespace interflect::montecarlo {

/// A film that light finds by itself: any path may leave something in any pixel (light tracing).
///
/// A sample of a pixel is all that one path leaves there, zero of most.  Paths are added pixel by pixel in their own
/// order: the same bits for any number of threads, and however paths are cut into calls.  Pixels share paths and are
/// not independent: the error of a sum of pixels is not told by theirs.
class SplatFilm {
 public:
  /// Both must outlive it.
  SplatFilm(const scene::Scene& scene, int width, int height, const ReconstructionFilter& filter);

  /// What one path leaves.
  class Deposits {
   public:
    /// At a point of the film [pixels], per pixel as FilmMap::image_of has it: `value` h(point - middle) in each pixel
    /// within the filter's reach.
    void add(const Vec2& film, const Spectrum& value);

   private:
    friend class SplatFilm;
    struct Deposit {
      std::uint32_t pixel;
      Spectrum value;
    };
    explicit Deposits(const SplatFilm& film) : film_(film) {}
    void join();  ///< one for each pixel, those of one pixel added in the order in which they came

    const SplatFilm& film_;
    std::vector<Deposit> of_;
  };
  using Trace = std::function<void(std::uint64_t path, Deposits& deposits)>;

  /// More paths, up to `end` in all: trace(path, deposits) of each, on any thread.  A stop leaves whole paths, the first
  /// ones.
  void expose(std::uint64_t end, Run& run, const Trace& trace);
  std::uint64_t paths() const { return paths_; }

  /// Mean over all paths.  @param largest  as of Tally::estimate
  Estimate estimate(int x, int y, const Spectrum& largest) const;

  FilmState state() const { return scoring_.state(); }
  /// @throws core::InputError  for numbers that are no state of such a film
  void restore(const FilmState& state, std::uint64_t paths);

 private:
  const scene::Scene& scene_;
  const ReconstructionFilter& filter_;
  int width_, height_;
  Film scoring_;  ///< of each pixel the paths that left something there
  std::uint64_t paths_ = 0;
};

}  // namespace interflect::montecarlo
