#include "core/log.h"

#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <mutex>
#include <utility>

namespace interflect::core::log {
namespace {

/// A warning that is the last one again, of a method that is tried anew with other settings, says nothing new.
class WithoutRepeats final : public spdlog::sinks::base_sink<std::mutex> {
 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    std::string text(message.payload.data(), message.payload.size());
    if (message.level == spdlog::level::warn && text == last_) return;
    last_ = std::move(text);
    to_.log(message);
  }
  void flush_() override { to_.flush(); }
  void set_pattern_(const std::string& pattern) override { to_.set_pattern(pattern); }
  void set_formatter_(std::unique_ptr<spdlog::formatter> formatter) override {
    to_.set_formatter(std::move(formatter));
  }

 private:
  spdlog::sinks::stderr_color_sink_mt to_;
  std::string last_;
};

spdlog::logger& logger() {
  static const std::shared_ptr<spdlog::logger> instance = [] {
    auto made = std::make_shared<spdlog::logger>("interflect", std::make_shared<WithoutRepeats>());
    made->set_pattern("%^%l%$: %v");
    return made;
  }();
  return *instance;
}

/// The same, at any level that is set.
spdlog::logger& insistent_logger() {
  static const std::shared_ptr<spdlog::logger> instance = [] {
    auto made = logger().clone("interflect");
    made->set_level(spdlog::level::warn);
    return made;
  }();
  return *instance;
}

}  // namespace

void set_level(Level level) {
  constexpr spdlog::level::level_enum levels[] = {spdlog::level::err, spdlog::level::warn, spdlog::level::info,
                                                  spdlog::level::debug};
  logger().set_level(levels[static_cast<int>(level)]);
}

// A message is a value, never a pattern: braces in a file name must not be read as one.
void debug(const std::string& message) { logger().debug("{}", message); }
void info(const std::string& message) { logger().info("{}", message); }
void warning(const std::string& message) { logger().warn("{}", message); }
void shortfall(const std::string& message) { insistent_logger().warn("{}", message); }

}  // namespace interflect::core::log
