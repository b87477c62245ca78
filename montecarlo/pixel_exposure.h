#pragma once

#include "montecarlo/exposure.h"

namespace interflect::montecarlo {

/// Each pixel's samples by themselves, pixel after pixel in passes over all: a stop leaves pixels with whole samples,
/// more in some.
class PixelExposure : public Exposure {
 public:
  /// @param unit  samples that a pixel has come in so many at once
  PixelExposure(std::uint64_t unit, Run& run) : unit_(unit), run_(run) {}
  std::uint64_t pass(Film& film, std::uint64_t done, std::uint64_t limit, core::Progress::Stage& stage,
                     const std::function<void()>& after_some) final;

 private:
  /// Brings a pixel from `begin` samples to `end`, on any thread.
  virtual void expose(Film& film, std::size_t pixel, std::uint64_t begin, std::uint64_t end) = 0;

  /// How many pixels' samples at once: so many that a stop, or a checkpoint, need not wait for long.  Nothing but time
  /// depends on it.
  class Pace {
   public:
    std::uint64_t portion() const { return portion_; }
    void took(std::uint64_t samples, double seconds);

   private:
    std::uint64_t portion_ = 1 << 16;
  };

  std::uint64_t unit_;
  Run& run_;
  Pace pace_;
};

}  // namespace interflect::montecarlo
