#include "apps/option_validators.h"

#include <CLI/CLI.hpp>

#include "apps/option_texts.h"
#include "core/format.h"

namespace interflect::apps {

CLI::Validator within(double low, double high) {
  return {[=](std::string& text) { return outside(text, low, high); }, core::format("in [%g, %g]", low, high)};
}
CLI::Validator count(double most) {
  return {[=](std::string& text) { return to_count(text, most); }, core::format("up to %g", most)};
}
CLI::Validator memory() { return {to_bytes, "SIZE"}; }
CLI::Validator duration() { return {to_seconds, "TIME"}; }
CLI::Validator length() { return {no_length, "METRES"}; }
CLI::Validator fraction() {
  return {[](std::string& text) { return to_fraction(text); }, "PART"};
}
CLI::Validator fraction(double low, double high) {
  return {[=](std::string& text) { return to_fraction(text, low, high); },
          core::format("PART in [%g %%, %g %%]", 100 * low, 100 * high)};
}
CLI::Validator given(const std::string& what) {
  return {[=](std::string& text) { return text.empty() ? what + " is expected" : std::string(); }, ""};
}
CLI::Validator named(const std::string& what) { return given("the name of " + what); }
CLI::Validator whole(std::uint64_t least, std::uint64_t most) {
  return {
      [=](std::string& text) { return no_whole_number(text, least, most); },
      core::format("in [%llu, %llu]", static_cast<unsigned long long>(least), static_cast<unsigned long long>(most))};
}

}  // namespace interflect::apps
