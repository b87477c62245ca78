#include "scene/io/xml_document.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/format.h"
#include "scene/io/text_file.h"

namespace interflect::scene::io {
namespace {

constexpr int deepest = 32;
constexpr const char* blanks = " \t\r\n";

class XmlParser {
 public:
  XmlParser(std::string_view bytes, std::string_view raw, const std::string& shown)
      : bytes_(bytes), raw_(raw), shown_(shown) {}

  XmlElement run() {
    skip_to_element();
    if (at_ >= bytes_.size() || bytes_[at_] != '<' || starts_with("</")) fail("an XML element is expected");
    return element(0);
  }

 private:
  [[noreturn]] void fail(const std::string& message) {
    throw core::InputError(core::format("%s:%d", shown_.c_str(), line_of(at_)), message);
  }
  bool starts_with(std::string_view text) const { return bytes_.substr(at_, text.size()) == text; }
  char here() const { return at_ < bytes_.size() ? bytes_[at_] : '\0'; }
  void skip_blanks() { at_ = std::min(bytes_.find_first_not_of(blanks, at_), bytes_.size()); }

  /// Counted onwards from where it was asked last: places only go forwards.
  int line_of(std::size_t at) {
    line_ += static_cast<int>(std::count(bytes_.begin() + static_cast<std::ptrdiff_t>(counted_),
                                         bytes_.begin() + static_cast<std::ptrdiff_t>(std::max(at, counted_)), '\n'));
    counted_ = std::max(at, counted_);
    return line_;
  }

  void skip_past(std::string_view end) {
    const std::size_t found = bytes_.find(end, at_);
    if (found == std::string_view::npos) fail("the file ends within a comment or a declaration");
    at_ = found + end.size();
  }

  /// To the next tag of an element, past text, comments and declarations.
  void skip_to_element() {
    while (at_ < bytes_.size()) {
      at_ = std::min(bytes_.find('<', at_), bytes_.size());
      if (starts_with("<!--"))
        skip_past("-->");
      else if (starts_with("<?"))
        skip_past("?>");
      else if (starts_with("<!"))
        skip_past(">");
      else
        return;
    }
  }

  std::string name(const char* what) {
    const std::size_t end = std::min(bytes_.find_first_of(" \t\r\n=/><\"'", at_), bytes_.size());
    if (end == at_ || end - at_ > 1000) fail(std::string(what) + " is expected");
    std::string out(bytes_.substr(at_, end - at_));
    at_ = end;
    return out;
  }

  std::string value() {
    const char quote = here();
    if (quote != '"' && quote != '\'') fail("the value of an attribute is expected in quotes");
    const std::size_t end = bytes_.find(quote, at_ + 1);
    if (end == std::string_view::npos) fail("the file ends within the value of an attribute");
    std::string out(bytes_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    constexpr std::array<std::pair<const char*, const char*>, 5> entities = {
        {{"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&apos;", "'"}, {"&amp;", "&"}}};
    for (const auto& [entity, letter] : entities)
      for (std::size_t k = out.find(entity); k != std::string::npos; k = out.find(entity, k + 1))
        out.replace(k, std::string_view(entity).size(), letter);
    return out;
  }

  /// Reads a start tag from its '<'; true if there is content behind it.
  bool start_tag(XmlElement& out) {
    out.line = line_of(at_);
    ++at_;
    out.name = name("the name of an element");
    for (;;) {
      skip_blanks();
      if (here() == '>') return ++at_, true;
      if (starts_with("/>")) return at_ += 2, false;
      std::string key = name("an attribute, or the end of the tag,");
      skip_blanks();
      if (here() != '=') fail("'=' is expected behind '" + shown_word(key) + "'");
      ++at_;
      skip_blanks();
      out.attributes.emplace_back(std::move(key), value());
    }
  }

  XmlElement element(int depth) {
    if (depth > deepest) fail("nested deeper than 32 levels");
    XmlElement out;
    if (!start_tag(out)) return out;
    const std::size_t start = at_;
    if (out.name == raw_) {
      out.text = bytes_.substr(start);
      at_ = bytes_.size();
      ended_ = true;
      return out;
    }
    out.text = bytes_.substr(start, std::min(bytes_.find('<', at_), bytes_.size()) - start);
    while (!ended_) {
      skip_to_element();
      if (at_ >= bytes_.size()) fail("the file ends within '" + shown_word(out.name) + "'");
      if (starts_with("</")) {
        end_tag(out.name);
        return out;
      }
      out.children.push_back(element(depth + 1));
    }
    return out;
  }

  void end_tag(const std::string& expected) {
    at_ += 2;
    if (name("the name of an element") != expected) fail("the end of '" + shown_word(expected) + "' is expected");
    skip_blanks();
    if (here() != '>') fail("'>' is expected");
    ++at_;
  }

  std::string_view bytes_, raw_;
  const std::string& shown_;
  std::size_t at_ = 0, counted_ = 0;
  int line_ = 1;
  bool ended_ = false;  ///< in raw bytes
};

}  // namespace

const std::string* XmlElement::attribute(std::string_view key) const {
  for (const auto& [name_of_it, value] : attributes)
    if (name_of_it == key) return &value;
  return nullptr;
}

const XmlElement* XmlElement::child(std::string_view key) const {
  for (const XmlElement& element : children)
    if (element.name == key) return &element;
  return nullptr;
}

XmlElement parse_xml(std::string_view bytes, std::string_view raw, const std::string& shown) {
  return XmlParser(bytes, raw, shown).run();
}

}  // namespace interflect::scene::io
