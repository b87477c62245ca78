#pragma once

#include <stdexcept>
#include <string>

namespace interflect::core {

/// Bad input from outside: a file, a number, an option.  The command line prints `what()` and exits with 2.
///
/// `what()` is one line: where it is ("office.json:41: /materials/walls/reflectance") and what was expected instead.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& what) : std::runtime_error(what) {}
  InputError(const std::string& place, const std::string& expected) : std::runtime_error(place + ": " + expected) {}
};

/// A caller broke a documented precondition: a bug, not bad input.
class PreconditionError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// The run was asked to stop (Ctrl-C) before there was anything worth keeping.
class Interrupted : public std::runtime_error {
 public:
  explicit Interrupted(const std::string& stage) : std::runtime_error("interrupted during " + stage) {}
};

/// One line out of possibly many: what a message from a library becomes before it is shown.
std::string single_line(const std::string& text);

}  // namespace interflect::core
