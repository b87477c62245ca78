#include "core/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace interflect::core::log {
namespace {

spdlog::logger& logger() {
  static const std::shared_ptr<spdlog::logger> instance = [] {
    auto made = std::make_shared<spdlog::logger>("interflect", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
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
