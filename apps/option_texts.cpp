#include "apps/option_texts.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/format.h"

namespace interflect::apps {
namespace {

/// A number and what follows it.
struct Quantity {
  double value;
  std::string unit;
};

std::optional<Quantity> quantity_of(const std::string& text) {
  try {
    std::size_t used = 0;
    const double value = std::stod(text, &used);
    return Quantity{value, text.substr(used)};
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

/// A positive number of the first unit in place of the text.
std::string in_units(std::string& text, std::initializer_list<std::pair<const char*, double>> units,
                     const std::string& expected) {
  auto quantity = quantity_of(text);
  if (quantity) quantity->unit.erase(0, quantity->unit.find_first_not_of(' '));
  for (const auto& [name, factor] : units)
    if (quantity && quantity->unit == name && quantity->value > 0 && std::isfinite(quantity->value)) {
      text = core::format("%.17g", quantity->value * factor);
      return {};
    }
  return "'" + text + "' is not " + expected;
}

std::string to_fraction(std::string& text, const std::function<bool(double)>& is_fine, const std::string& range) {
  const auto part = quantity_of(text);
  if (!part || !(part->unit.empty() || part->unit == "%")) return "'" + text + "' is not a part such as 1% or 0.01";
  const double value = part->value * (part->unit.empty() ? 1.0 : 0.01);
  if (!is_fine(value)) return "'" + text + "' is not " + range;
  text = core::format("%.17g", value);
  return {};
}

}  // namespace

std::string outside(const std::string& text, double low, double high) {
  const auto number = quantity_of(text);
  const bool fine = number && number->unit.empty() && number->value >= low && number->value <= high;
  return fine ? std::string() : core::format("Value %s not in range %g to %g", text.c_str(), low, high);
}

std::string to_count(std::string& text, double most) {
  const auto number = quantity_of(text);
  const bool fine = number && number->unit.empty() && number->value >= 0 && number->value <= most &&
                    number->value == std::floor(number->value);
  if (!fine) return core::format("'%s' is not a whole number from 0 to %g", text.c_str(), most);
  text = core::format("%.0f", number->value);
  return {};
}

std::string to_bytes(std::string& text) {
  return in_units(text, {{"", 1.0}, {"kB", 1e3}, {"MB", 1e6}, {"GB", 1e9}, {"TB", 1e12}}, "a size such as 4GB");
}

std::string to_seconds(std::string& text) {
  return in_units(text, {{"", 1.0}, {"s", 1.0}, {"min", 60}, {"h", 3600}}, "a time such as 90s, 15min or 2h");
}

std::string no_length(const std::string& text) {
  const auto length = quantity_of(text);
  const bool fine = length && length->unit.empty() && length->value > 0 && std::isfinite(length->value);
  return fine ? std::string() : "'" + text + "' is not a number of metres above 0";
}

std::string to_fraction(std::string& text) {
  return to_fraction(
      text, [](double value) { return value > 0 && value < 1; }, "above 0 and below 100 %");
}

std::string to_fraction(std::string& text, double low, double high) {
  return to_fraction(
      text, [=](double value) { return value >= low && value <= high; },
      core::format("from %g to %g %%", 100 * low, 100 * high));
}

std::string no_whole_number(const std::string& text, std::uint64_t least, std::uint64_t most) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size() && value >= least && value <= most) return {};
  return core::format("'%s' is not a whole number from %llu to %llu", text.c_str(),
                      static_cast<unsigned long long>(least), static_cast<unsigned long long>(most));
}

}  // namespace interflect::apps
