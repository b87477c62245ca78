#include "montecarlo/film/splat_film.h"

#include <algorithm>

#include "core/error.h"
#include "montecarlo/film/spread.h"

namespace interflect::montecarlo {
namespace {

constexpr Index paths_per_block = 128, blocks_at_once = 64;
constexpr Index bands = 64;  ///< of pixels, each with its own list, so that lists are added in parallel

}  // namespace

SplatFilm::SplatFilm(const scene::Scene& scene, int width, int height, const ReconstructionFilter& filter)
    : scene_(scene),
      filter_(filter),
      width_(width),
      height_(height),
      scoring_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), scene.channel_count()) {}

void SplatFilm::Deposits::add(const Vec2& film, const Spectrum& value) {
  spread(film, film_.width_, film_.height_, film_.filter_, [&](int x, int y, double h) {
    of_.push_back({static_cast<std::uint32_t>(y * film_.width_ + x), h * value});
  });
}

void SplatFilm::Deposits::join() {
  std::stable_sort(of_.begin(), of_.end(), [](const Deposit& a, const Deposit& b) { return a.pixel < b.pixel; });
  std::size_t kept = 0;
  for (std::size_t k = 0; k < of_.size(); ++k)
    if (kept > 0 && of_[kept - 1].pixel == of_[k].pixel)
      of_[kept - 1].value += of_[k].value;
    else
      of_[kept++] = of_[k];
  of_.erase(of_.begin() + static_cast<std::ptrdiff_t>(kept), of_.end());
}

void SplatFilm::expose(std::uint64_t end, Run& run, const Trace& trace) {
  const auto pixels = static_cast<Index>(scoring_.pixels());
  const Index band = (pixels + bands - 1) / bands;
  using Lists = std::vector<std::vector<Deposits::Deposit>>;  // [band], in the order of paths
  while (paths_ < end && !run.stop.stop_requested()) {
    const auto count = static_cast<Index>(
        std::min<std::uint64_t>(end - paths_, static_cast<std::uint64_t>(paths_per_block * blocks_at_once)));
    std::vector<Lists> left(static_cast<std::size_t>((count + paths_per_block - 1) / paths_per_block), Lists(bands));
    run.threads.for_blocks(count, paths_per_block, [&](Index begin, Index past) {
      Lists& lists = left[static_cast<std::size_t>(begin / paths_per_block)];
      for (Index path = begin; path < past; ++path) {
        Deposits deposits(*this);
        trace(paths_ + static_cast<std::uint64_t>(path), deposits);
        deposits.join();
        for (const Deposits::Deposit& each : deposits.of_)
          lists[static_cast<std::size_t>(Index{each.pixel} / band)].push_back(each);
      }
    });
    run.threads.for_blocks(bands, 1, [&](Index b, Index) {
      for (const Lists& lists : left)
        for (const Deposits::Deposit& each : lists[static_cast<std::size_t>(b)])
          scoring_.add(each.pixel, each.value, scene_.weigh(each.value));
    });
    paths_ += static_cast<std::uint64_t>(count);
  }
}

Estimate SplatFilm::estimate(int x, int y, const Spectrum& largest) const {
  Tally all =
      scoring_.tally(static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
  const std::uint64_t without = paths_ - all.moments.count();
  all.moments.merge({without, Spectrum::zero(), Spectrum::zero()});
  all.weighed.merge({without, 0, 0});
  return all.estimate(largest);
}

void SplatFilm::restore(const FilmState& state, std::uint64_t paths) {
  scoring_.restore(state);
  for (std::size_t p = 0; p < scoring_.pixels(); ++p)
    if (scoring_.samples(p) > paths) throw core::InputError("film", "more scoring paths than paths");
  paths_ = paths;
}

}  // namespace interflect::montecarlo
