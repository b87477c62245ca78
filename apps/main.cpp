#include <cstdio>
#include <exception>
#include <new>

#include "apps/command_line.h"
#include "apps/session.h"
#include "core/build_info.h"
#include "core/error.h"
#include "core/log.h"

namespace {

using namespace interflect;

int complain(const std::string& message, int status) {
  std::fprintf(stderr, "interflect: %s\n", core::single_line(message).c_str());
  return status;
}

int run(int argc, char** argv) {
  if (const std::string why = core::unsupported_processor(); !why.empty()) return complain(why, apps::bad_input);
  apps::block_watched_signals();
  const std::optional<apps::Command> command = apps::parse_command_line(argc, argv);
  if (!command) return apps::success;
  const apps::CommonOptions& common = command->common;
  core::log::set_level(common.quiet     ? core::log::Level::quiet
                       : common.verbose ? core::log::Level::debug
                                        : core::log::Level::info);
  apps::Session session(common);
  return command->execute(common, session.run());
}

/// Results that did not arrive are no success.
int with_output_flushed(int status) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
  return complain("standard output cannot be written", apps::bad_input);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return with_output_flushed(run(argc, argv));
  } catch (const core::InputError& error) {
    return complain(error.what(), apps::bad_input);
  } catch (const core::Interrupted& stop) {
    return complain(stop.what(), apps::not_met);
  } catch (const std::bad_alloc&) {
    return complain("not enough memory; larger elements (--element-size) need less", apps::bad_input);
  } catch (const std::exception& error) {
    return complain(std::string("internal error, please report it: ") + error.what(), apps::not_met);
  }
}
