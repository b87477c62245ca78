#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace interflect::scene::io {

/// The bytes of a regular file.
/// @param shown  how messages name the file
/// @throws core::InputError  missing, a directory, not readable
std::string read_bytes(const std::filesystem::path& file, const std::string& shown);

/// Refuses what cannot be text in UTF-8 or ASCII: UTF-16 and UTF-32 are named, a NUL byte is placed ("FILE:LINE: ...").
void require_text(std::string_view bytes, const std::string& shown);

/// The text without the byte order mark that some editors put before UTF-8.
std::string_view without_byte_order_mark(std::string_view text);

/// "'reflectence' is not known: did you mean 'reflectance'?", or the list of what is known where nothing is near.
std::string unknown_word(const std::string& kind, const std::string& word, const std::vector<std::string>& known);

/// Without blanks, tabs and carriage returns at both ends.
std::string_view trimmed(std::string_view text);

/// The number that a word is, correctly rounded, with or without a plus before it; nothing where it is none.
std::optional<double> number_of(std::string_view word);

/// Text from a file on one line, without control characters.
std::string one_line(std::string_view text);

/// A word from a file, fit for a message: one line, cut after 60 characters.
std::string shown_word(std::string_view word);

}  // namespace interflect::scene::io
