#include "core/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "core/format.h"

namespace interflect::core {
namespace {

using namespace std::chrono_literals;
constexpr auto first_report_after = 2s;
constexpr auto bar_interval = 200ms;
constexpr auto line_interval = 10s;
constexpr int bar_width = 30;

}  // namespace

Progress::Style Progress::style_of_standard_error() { return isatty(STDERR_FILENO) != 0 ? Style::bar : Style::lines; }

Progress::Stage::Stage(Progress& progress, const std::string& name, std::uint64_t total)
    : progress_(progress), name_(progress.part_ + name), total_(std::max<std::uint64_t>(total, 1)) {
  next_report_ = (start_ + first_report_after).time_since_epoch().count();
}

Progress::Stage::~Stage() {
  if (shown_ && progress_.style_ == Style::bar) {
    const std::scoped_lock lock(progress_.printing_);
    std::fprintf(stderr, "\r\033[K");
  }
}

void Progress::Stage::advance(std::uint64_t units) {
  const std::uint64_t done = done_.fetch_add(units) + units;
  if (progress_.style_ == Style::quiet) return;
  const Clock::time_point now = Clock::now();
  Clock::rep due = next_report_.load();
  if (now.time_since_epoch().count() < due) return;
  const auto interval = progress_.style_ == Style::bar ? Clock::duration(bar_interval) : Clock::duration(line_interval);
  if (next_report_.compare_exchange_strong(due, (now + interval).time_since_epoch().count()))
    progress_.report(*this, done);
}

void Progress::report(Stage& stage, std::uint64_t done) {
  const double part = std::min(1.0, static_cast<double>(done) / static_cast<double>(stage.total_));
  const double elapsed = std::chrono::duration<double>(Stage::Clock::now() - stage.start_).count();
  const double of_all = std::chrono::duration<double>(expected_end_ - Stage::Clock::now()).count();
  const std::string left = format_duration(std::max(part > 0 ? elapsed * (1 - part) / part : 0, of_all));
  const std::scoped_lock lock(printing_);
  stage.shown_ = true;
  if (style_ == Style::bar) {
    const int filled = static_cast<int>(part * bar_width);
    const std::string bar(static_cast<std::size_t>(filled), '#'),
        rest(static_cast<std::size_t>(bar_width - filled), '.');
    std::fprintf(stderr, "\r\033[K%-16s [%s%s] %3.0f %%  %s left", stage.name_.c_str(), bar.c_str(), rest.c_str(),
                 100 * part, left.c_str());
  } else {
    std::fprintf(stderr, "%s: %.0f %%, %s left\n", stage.name_.c_str(), 100 * part, left.c_str());
  }
  std::fflush(stderr);
}

}  // namespace interflect::core
