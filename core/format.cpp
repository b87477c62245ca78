#include "core/format.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>

namespace interflect::core {

std::string format(const char* pattern, ...) {
  std::va_list arguments;
  va_start(arguments, pattern);
  std::va_list measured;
  va_copy(measured, arguments);
  const int length = std::vsnprintf(nullptr, 0, pattern, measured);
  va_end(measured);
  std::string text(static_cast<std::size_t>(length > 0 ? length : 0), '\0');
  std::vsnprintf(text.data(), text.size() + 1, pattern, arguments);
  va_end(arguments);
  return text;
}

std::string format_bytes(double bytes) {
  if (bytes >= 1e9) return format("%.1f GB", bytes * 1e-9);
  if (bytes >= 1e6) return format("%.0f MB", bytes * 1e-6);
  return format("%.0f kB", bytes * 1e-3);
}

std::string format_duration(double seconds) {
  if (seconds < 10) return format("%.1f s", seconds);
  if (seconds < 100) return format("%.0f s", seconds);
  if (seconds < 100 * 60) return format("%.0f min", seconds / 60);
  return format("%.1f h", seconds / 3600);
}

std::string format_percent(double part) { return std::isfinite(part) ? format("%.2f %%", 100 * part) : "-"; }

double rounded_up(double value, int digits) {
  if (!(value > 0) || !std::isfinite(value)) return value;
  const double told = std::strtod(format("%.*g", digits, value).c_str(), nullptr);
  if (told >= value) return told;
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - digits + 1);
  return std::strtod(format("%.*g", digits, told + unit).c_str(), nullptr);
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

std::string format_count(unsigned long long count) {
  std::string digits = std::to_string(count);
  for (std::ptrdiff_t at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(static_cast<std::size_t>(at), 1, ' ');
  return digits;
}

}  // namespace interflect::core
