#pragma once

#include <functional>
#include <optional>

#include "apps/commands.h"
#include "apps/options.h"

namespace interflect::apps {

/// A command with its options, ready to run.
struct Command {
  CommonOptions common;
  std::function<ExitStatus(const CommonOptions&, Run&)> execute;
};

/// Nothing where the command line asked for help or the version (printed already).
/// @throws core::InputError  for a command line that is none
std::optional<Command> parse_command_line(int argc, char** argv);

}  // namespace interflect::apps
