#pragma once

#include <cstdint>
#include <string>

/// What a person may write as an option's value.  Each returns a complaint, empty where there is none.
namespace interflect::apps {

/// A number from `low` to `high`: not nan, and no "-5" that an unsigned option would take for a large one.
std::string outside(const std::string& text, double low, double high);

/// A whole number from 0 to `most` from "1000000" or "1e6", in digits in place of the text.
std::string to_count(std::string& text, double most);

/// Bytes from "4GB", "512 MB", "1e9", powers of ten as on a label, in place of the text.
std::string to_bytes(std::string& text);

/// Seconds from "90", "90s", "15min", "2h", in place of the text.
std::string to_seconds(std::string& text);

/// A length in metres above 0.
std::string no_length(const std::string& text);

/// "1%" or "0.01", in (0, 1), as a number in place of the text; or in [low, high].
std::string to_fraction(std::string& text);
std::string to_fraction(std::string& text, double low, double high);

/// Digits alone: a parser would take "-1" for the largest.
std::string no_whole_number(const std::string& text, std::uint64_t least, std::uint64_t most);

}  // namespace interflect::apps
