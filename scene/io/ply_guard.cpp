#include <array>
#include <charconv>
#include <iterator>
#include <sstream>
#include <vector>

#include "core/error.h"
#include "core/format.h"
#include "scene/io/assimp_guard.h"
#include "scene/io/text_file.h"

namespace interflect::scene::io {
namespace {

struct Property {
  std::size_t size;        ///< of a value, or of an entry of the list [bytes]
  std::size_t count_size;  ///< of a list's count; 0: no list
};

struct Element {
  std::string name;
  std::size_t count;
  std::vector<Property> properties;
};

/// The header says what follows; this walks through it as far as it must to see that every list is there.
class PlyGuard {
 public:
  PlyGuard(std::string_view bytes, const std::string& shown) : bytes_(bytes), shown_(shown) {}

  std::size_t run() {
    if (!bytes_.starts_with("ply")) fail("this is not a PLY file: it does not begin with 'ply'");
    const std::string_view last = "\nend_header";
    const std::size_t end = bytes_.find(last);
    const std::size_t data = end == std::string_view::npos ? end : bytes_.find('\n', end + last.size());
    if (data == std::string_view::npos || bytes_.substr(end, data - end).find_last_not_of(" \t\r") >= last.size())
      fail("the PLY header has no end");
    at_ = data + 1;
    read_header(std::string(bytes_.substr(0, end)));
    double promised = 0;
    std::size_t faces = 0;
    for (const Element& element : elements_) {
      promised += static_cast<double>(element.count);
      if (element.name == "face") faces += element.count;
    }
    if (promised > static_cast<double>(bytes_.size() - at_))  // a byte each, at the very least
      fail(core::format("the header promises %.0f elements, in %zu bytes", promised, bytes_.size() - at_));
    for (const Element& element : elements_) ascii_ ? walk_text(element) : walk_binary(element);
    return faces;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw core::InputError(shown_, message); }

  void read_header(const std::string& header) {
    std::istringstream lines(header);
    std::string line;
    std::getline(lines, line);  // "ply"
    while (std::getline(lines, line)) {
      std::istringstream stream(line);
      const std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
      const std::string key = words.empty() ? "" : words[0];
      if (key == "comment" || key == "obj_info") continue;
      if (key == "format" && words.size() == 3)
        set_format(words[1]);
      else if (key == "element" && words.size() == 3)
        elements_.push_back({words[1], count_of(words[2], line), {}});
      else if (key == "property" && words.size() == 3 && !elements_.empty())
        elements_.back().properties.push_back({size_of(words[1]), 0});
      else if (key == "property" && words.size() == 5 && words[1] == "list" && !elements_.empty())
        elements_.back().properties.push_back({size_of(words[3]), size_of(words[2])});
      else if (!elements_.empty())  // before them, people write comments without the key
        fail("the PLY header's line '" + shown_word(line) + "' is not understood");
    }
  }

  void set_format(const std::string& format) {
    if (format != "ascii" && format != "binary_little_endian" && format != "binary_big_endian")
      fail(unknown_word("the PLY format", format, {"ascii", "binary_little_endian", "binary_big_endian"}));
    ascii_ = format == "ascii";
    big_endian_ = format == "binary_big_endian";
  }

  std::size_t count_of(const std::string& word, const std::string& line) const {
    std::size_t count = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), count);
    if (error != std::errc() || stop != word.data() + word.size()) fail("'" + shown_word(line) + "' has no count");
    return count;
  }

  std::size_t size_of(const std::string& type) const {
    constexpr std::array<std::array<const char*, 6>, 4> types = {
        {{"char", "uchar", "int8", "uint8", "", ""},
         {"short", "ushort", "int16", "uint16", "", ""},
         {"int", "uint", "int32", "uint32", "float", "float32"},
         {"double", "float64", "", "", "", ""}}};
    for (std::size_t k = 0; k < types.size(); ++k)
      for (const char* name : types[k])
        if (!type.empty() && type == name) return std::size_t{1} << k;
    fail("the PLY type '" + shown_word(type) + "' is not known");
  }

  [[noreturn]] void fail_cut(const Element& element) const {
    fail("the data end within the elements '" + shown_word(element.name) + "'");
  }

  /// The next one with anything in it.
  std::string_view next_line(const Element& element) {
    while (at_ < bytes_.size()) {
      const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
      const std::string_view line = bytes_.substr(at_, end - at_);
      at_ = end + 1;
      if (line.find_first_not_of(" \t\r") != std::string_view::npos) return line;
    }
    fail_cut(element);
  }

  /// Goes on by `count` values of `size` bytes that must be there.
  void skip(std::size_t count, std::size_t size, const Element& element) {
    if (count > (bytes_.size() - at_) / size) fail_cut(element);
    at_ += count * size;
  }

  void walk_binary(const Element& element) {
    std::size_t fixed = 0;
    bool lists = false;
    for (const Property& p : element.properties) {
      fixed += p.size;
      lists |= p.count_size > 0;
    }
    if (!lists) {
      if (fixed > 0) skip(element.count, fixed, element);
      return;
    }
    for (std::size_t k = 0; k < element.count; ++k)
      for (const Property& p : element.properties) {
        if (p.count_size == 0) {
          skip(1, p.size, element);
          continue;
        }
        const std::size_t start = at_;
        skip(1, p.count_size, element);
        std::size_t count = 0;
        for (std::size_t byte = 0; byte < p.count_size; ++byte)
          count = count << 8 |
                  static_cast<unsigned char>(bytes_[big_endian_ ? start + byte : start + p.count_size - 1 - byte]);
        skip(count, p.size, element);
      }
  }

  /// One line an element; a list has no more entries than its line has letters.
  void walk_text(const Element& element) {
    for (std::size_t k = 0; k < element.count && !element.properties.empty(); ++k) {
      std::string_view rest = next_line(element);
      for (const Property& p : element.properties) {
        double count = 0;
        const std::string_view word = next_word(rest);
        if (word.empty()) fail_cut(element);
        if (p.count_size == 0) continue;
        std::from_chars(word.data(), word.data() + word.size(), count);
        if (!(count >= 0 && count <= static_cast<double>(rest.size())))
          fail("a list of the elements '" + shown_word(element.name) + "' promises more than its line holds");
        for (std::size_t entry = 0; entry < static_cast<std::size_t>(count); ++entry)
          if (next_word(rest).empty()) fail_cut(element);
      }
    }
  }

  static std::string_view next_word(std::string_view& rest) {
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r"), rest.size()));
    const std::string_view word = rest.substr(0, rest.find_first_of(" \t\r"));
    rest.remove_prefix(word.size());
    return word;
  }

  std::string_view bytes_;
  const std::string& shown_;
  std::vector<Element> elements_;
  bool ascii_ = false, big_endian_ = false;
  std::size_t at_ = 0;
};

}  // namespace

GuardedFile guarded_ply(std::string bytes, const std::string& shown) {
  const std::size_t faces = PlyGuard(bytes, shown).run();
  return {std::move(bytes), faces};
}

}  // namespace interflect::scene::io
