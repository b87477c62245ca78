#include "montecarlo/sweep_exposure.h"

#include <algorithm>

namespace interflect::montecarlo {

std::uint64_t SweepExposure::pass(Film& film, std::uint64_t done, std::uint64_t limit, core::Progress::Stage& stage,
                                  const std::function<void()>& after_some) {
  const std::size_t pixels = sweeps().pixels();
  const std::uint64_t end = std::min(limit, done + sweeps().at_once());
  std::vector<Spectrum> samples((end - done) * pixels);
  if (!dark()) samples = sweeps().samples(done, end, run_);
  if (samples.empty()) return done;  // stopped within a sweep
  for (std::size_t s = 0; s < samples.size(); ++s) film.add(s % pixels, samples[s], scene_.weigh(samples[s]));
  stage.advance(samples.size());
  after_some();
  return end;
}

}  // namespace interflect::montecarlo
