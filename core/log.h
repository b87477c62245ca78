#pragma once

#include <string>

/// Messages to people, on standard error; standard output is for results.
namespace interflect::core::log {

enum class Level { quiet, warnings, info, debug };

void set_level(Level level);
void debug(const std::string& message);
void info(const std::string& message);
void warning(const std::string& message);  ///< said once where it is the last message again
/// A warning that a quiet run prints too: in what the results fall short of what was asked, where that is its exit
/// status.
void shortfall(const std::string& message);

}  // namespace interflect::core::log
