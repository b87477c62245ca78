#pragma once

#include <span>
#include <utility>
#include <vector>

#include "core/run.h"
#include "core/spectrum.h"

namespace interflect::montecarlo {

/// Pictures whose pixels share walks: in a sweep each pixel has walks of its own, which may leave something in any other
/// pixel too.
///
/// A sample of a pixel is all that it gets in one sweep.  Sweeps are independent of each other, pixels are not: the
/// error of a sum of pixels is not told by theirs.
class Sweeps {
 public:
  /// What a walk leaves, and in which pixel.
  using Deposits = std::vector<std::pair<std::uint32_t, Spectrum>>;

  virtual ~Sweeps() = default;
  virtual std::size_t pixels() const = 0;
  /// So many sweeps are worth a call.
  std::uint64_t at_once() const;
  /// The same bits for any number of threads, and however sweeps are cut into calls.
  /// @return  the samples of sweeps first .. end - 1, pixel by pixel of each; empty if the run is stopped before
  std::vector<Spectrum> samples(std::uint64_t first, std::uint64_t end, Run& run) const;

 private:
  /// The walks of pixels begin .. end - 1 in sweep k, on any thread.
  /// @param samples  of all pixels; only those are added to
  virtual void sweep(std::uint64_t k, std::size_t begin, std::size_t end, std::span<Spectrum> samples,
                     Deposits& deposits) const = 0;
};

}  // namespace interflect::montecarlo
