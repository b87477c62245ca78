#include "scene/io/text_file.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <numeric>

#include "core/error.h"
#include "core/format.h"

namespace interflect::scene::io {
namespace {

/// The encoding that the first bytes betray, if it is one that is not read.
const char* foreign_encoding(std::string_view bytes) {
  const auto starts = [&](std::string_view mark) { return bytes.substr(0, mark.size()) == mark; };
  if (starts({"\xFF\xFE\0\0", 4}) || starts({"\0\0\xFE\xFF", 4})) return "UTF-32";
  if (starts("\xFF\xFE") || starts("\xFE\xFF")) return "UTF-16";
  if (bytes.size() < 4) return nullptr;
  const auto zero = [&](std::size_t k) { return bytes[k] == '\0'; };
  if ((zero(0) && zero(1) && zero(2) && !zero(3)) || (!zero(0) && zero(1) && zero(2) && zero(3))) return "UTF-32";
  if ((zero(0) && !zero(1) && zero(2) && !zero(3)) || (!zero(0) && zero(1) && !zero(2) && zero(3))) return "UTF-16";
  return nullptr;
}

/// Letters to change, add or drop, or neighbours to swap (optimal string alignment).
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  std::iota(d[0].begin(), d[0].end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    d[i][0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

std::string read_bytes(const std::filesystem::path& file, const std::string& shown) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw core::InputError(shown, "there is no such file");
  if (std::filesystem::is_directory(status)) throw core::InputError(shown, "this is a directory: a file is expected");
  if (!std::filesystem::is_regular_file(status)) throw core::InputError(shown, "this is not a regular file");
  const auto size = std::filesystem::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (!stream || error) throw core::InputError(shown, std::string("cannot be opened: ") + std::strerror(errno));
  std::string bytes(static_cast<std::size_t>(size), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (stream.gcount() != static_cast<std::streamsize>(bytes.size()))
    throw core::InputError(shown, "cannot be read to its end");
  return bytes;
}

void require_text(std::string_view bytes, const std::string& shown) {
  if (const char* encoding = foreign_encoding(bytes))
    throw core::InputError(shown, core::format("the file is in %s: UTF-8 is expected", encoding));
  if (const auto at = bytes.find('\0'); at != std::string_view::npos) {
    const auto line = 1 + std::count(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    throw core::InputError(core::format("%s:%td", shown.c_str(), line), "a NUL byte: text in UTF-8 is expected");
  }
}

std::string_view without_byte_order_mark(std::string_view text) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  return text;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string_view::npos ? std::string_view()
                                         : text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

std::optional<double> number_of(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || stop != word.data() + word.size()) return std::nullopt;
  return value;
}

std::string one_line(std::string_view text) {
  std::string line = core::single_line(std::string(text));
  std::erase_if(line, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; });
  return line;
}

std::string shown_word(std::string_view word) {
  constexpr std::size_t longest = 60;
  return word.size() > longest ? one_line(word.substr(0, longest)) + ".." : one_line(word);
}

std::string unknown_word(const std::string& kind, const std::string& word, const std::vector<std::string>& known) {
  const std::string message = kind + " '" + shown_word(word) + "' is not known: ";
  const std::string* nearest = nullptr;
  std::size_t least = std::clamp<std::size_t>(word.size() / 3, 1, 3);  // further away is no slip of the finger
  if (word.size() <= 60)
    for (const std::string& k : known) {
      const std::size_t d = k.size() <= 60 ? edit_distance(word, k) : least + 1;
      if (d <= least && (!nearest || d < least)) least = d, nearest = &k;
    }
  if (nearest) return message + "did you mean '" + shown_word(*nearest) + "'?";
  std::string list;
  for (const std::string& k : known) list += (list.empty() ? "" : ", ") + shown_word(k);
  return message + (list.empty() ? "there are none" : "one of " + list + " is expected");
}

}  // namespace interflect::scene::io
