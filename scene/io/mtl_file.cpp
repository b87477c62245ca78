#include "scene/io/mtl_file.h"

#include <algorithm>

#include "core/error.h"
#include "core/format.h"
#include "scene/io/text_file.h"

namespace interflect::scene::io {
namespace {

constexpr std::string_view blanks = " \t\r";

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    const std::size_t end = std::min(text.find_first_of(blanks), text.size());
    words.emplace_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return words;
}

/// A line after its key into the materials so far: a name may have blanks and "#", all else ends before a comment.
void read_line(std::string_view line, const std::string& place, std::vector<MtlEntry>& out) {
  line = trimmed(line);
  const std::string_view key = line.substr(0, std::min(line.find_first_of(blanks), line.size()));
  if (key.empty() || key.front() == '#') return;
  if (key == "newmtl") {
    out.push_back({core::single_line(std::string(trimmed(line.substr(key.size())))), place, {}});
    return;
  }
  if (out.empty())
    throw core::InputError(place, "'" + shown_word(key) + "' stands before the first material (newmtl NAME)");
  const std::string_view rest = line.substr(key.size());
  out.back().statements.push_back({std::string(key), words_of(rest.substr(0, rest.find('#'))), place});
}

}  // namespace

const MtlEntry::Statement* MtlEntry::find(const std::string& key) const {
  const auto found =
      std::find_if(statements.rbegin(), statements.rend(), [&](const Statement& s) { return s.key == key; });
  return found == statements.rend() ? nullptr : &*found;
}

std::vector<MtlEntry> read_mtl(const std::filesystem::path& file, const std::string& shown) {
  const std::string bytes = read_bytes(file, shown);
  require_text(bytes, shown);
  std::string_view text = without_byte_order_mark(bytes);
  std::vector<MtlEntry> all;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    read_line(text.substr(0, end), core::format("%s:%zu", shown.c_str(), number), all);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  std::vector<MtlEntry> first;
  for (MtlEntry& entry : all)
    if (std::none_of(first.begin(), first.end(), [&](const MtlEntry& e) { return e.name == entry.name; }))
      first.push_back(std::move(entry));
  return first;
}

std::vector<std::filesystem::path> mtl_files(const std::filesystem::path& folder, const std::string& named) {
  std::error_code error;
  if (std::filesystem::exists(folder / named, error)) return {folder / named};
  std::vector<std::filesystem::path> files;
  for (const std::string& word : words_of(named)) files.push_back(folder / word);
  return files;
}

}  // namespace interflect::scene::io
