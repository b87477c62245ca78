#pragma once

#include <cstdint>
#include <string>

namespace CLI {
class Validator;
}

/// What a person may write as an option's value (option_texts.h), as the parser takes it.
namespace interflect::apps {

CLI::Validator within(double low, double high);
CLI::Validator count(double most);
CLI::Validator memory();
CLI::Validator duration();
CLI::Validator length();
CLI::Validator fraction();
CLI::Validator fraction(double low, double high);
CLI::Validator whole(std::uint64_t least, std::uint64_t most);
/// Not "", as a variable that is not set leaves it, which would pass for none given.
CLI::Validator given(const std::string& what);
CLI::Validator named(const std::string& what);

}  // namespace interflect::apps
