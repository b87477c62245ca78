#pragma once

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
CLI::Validator seed();

}  // namespace interflect::apps
