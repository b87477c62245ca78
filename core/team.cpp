#include "core/team.h"

#include <chrono>
#include <system_error>

#include "core/error.h"
#include "core/seconds_since.h"

namespace interflect::core {
namespace {

constexpr int looks = 512;    // some ten microseconds
constexpr int yields = 1024;  // some hundred, where there are as many processors as threads

/// Whether it is so in a moment: looks again and again.
template <class Condition>
bool looks_until(const Condition& condition) {
  for (int look = 0; look < looks; ++look) {
    if (condition()) return true;
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
  }
  return false;
}

/// Whether it is so soon: later lets others run in between looks, as they may be what it waits for.
template <class Condition>
bool is_soon(const Condition& condition) {
  if (looks_until(condition)) return true;
  for (int yield = 0; yield < yields; ++yield) {
    if (condition()) return true;
    std::this_thread::yield();
  }
  return false;
}

}  // namespace

double StepCount::wait_for(Index steps) const {
  const auto is_done = [&] { return steps_.load(std::memory_order_acquire) >= steps; };
  if (looks_until(is_done)) return 0;
  const auto start = std::chrono::steady_clock::now();
  while (!is_soon(is_done)) {
  }
  return seconds_since(start);
}

Team::Team(unsigned members) {
  if (members == 0) throw PreconditionError("team: a member expected");
  others_.reserve(members - 1);
  try {
    for (unsigned member = 1; member < members; ++member) others_.emplace_back([this, member] { serve(member); });
  } catch (const std::system_error&) {  // there are no more threads: a smaller team does the same work
  } catch (...) {
    dismiss();
    throw;
  }
}

Team::~Team() { dismiss(); }

void Team::dismiss() {
  body_ = nullptr;
  called_.fetch_add(1, std::memory_order_release);
  called_.notify_all();
  for (std::thread& other : others_) other.join();
}

void Team::work(const std::function<void(unsigned)>& body) {
  body_ = &body;
  busy_.store(size() - 1, std::memory_order_relaxed);
  called_.fetch_add(1, std::memory_order_release);
  called_.notify_all();
  [&]() noexcept { body(0); }();
  if (is_soon([&] { return busy_.load(std::memory_order_acquire) == 0; })) return;
  for (unsigned busy; (busy = busy_.load(std::memory_order_acquire)) != 0;) busy_.wait(busy, std::memory_order_acquire);
}

void Team::serve(unsigned member) {
  for (Index served = 0;; ++served) {
    if (!is_soon([&] { return called_.load(std::memory_order_acquire) != served; }))
      called_.wait(served, std::memory_order_acquire);
    if (body_ == nullptr) return;
    [&]() noexcept { (*body_)(member); }();
    if (busy_.fetch_sub(1, std::memory_order_acq_rel) == 1) busy_.notify_one();
  }
}

}  // namespace interflect::core
