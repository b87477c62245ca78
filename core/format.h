#pragma once

#include <string>

namespace interflect::core {

/// printf into a string; the compiler checks the arguments against the format.
[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...);

/// "2.0 GB", "640 kB".
std::string format_bytes(double bytes);

/// "0.4 s", "38 s", "12 min", "3.5 h".
std::string format_duration(double seconds);

/// "12.34 %" of a part such as 0.1234; "-" where there is none (not a number, infinite).
std::string format_percent(double part);

/// The least number of so many significant digits that is not below a positive one: how bounds are told.
double rounded_up(double value, int digits);

/// ASCII letters in lower case, all else as it is: for extensions and names that differ in case alone.
std::string lower_case(std::string text);

/// "12 500" with thin grouping by spaces, for people; files get plain digits.
std::string format_count(unsigned long long count);

}  // namespace interflect::core
