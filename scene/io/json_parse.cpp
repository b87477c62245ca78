#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/format.h"
#include "scene/io/json_document.h"
#include "scene/io/text_file.h"

namespace interflect::scene::io {
namespace {

constexpr std::size_t deepest_nesting = 64;

/// How far the parser has read: it asks for characters one by one, and lines are counted behind it.
struct Reading {
  std::string_view text;
  std::size_t consumed = 0, counted = 0;
  int line = 1;

  /// The line of the token that was read last.  A number is known to end only by the character after it, which may be a
  /// line break: the last character consumed does not count.
  int line_now() {
    for (const std::size_t end = consumed > 0 ? consumed - 1 : 0; counted < end; ++counted)
      line += text[counted] == '\n';
    return line;
  }
};

class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(Reading* reading, std::size_t at) : reading_(reading), at_(at) {}
  reference operator*() const { return reading_->text[at_]; }
  CountingIterator& operator++() {
    reading_->consumed = ++at_;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator before = *this;
    ++*this;
    return before;
  }
  friend bool operator==(const CountingIterator& a, const CountingIterator& b) { return a.at_ == b.at_; }

 private:
  Reading* reading_;
  std::size_t at_;
};

/// What is left of "[json.exception.parse_error.101] parse error at line 3, column 5: syntax error while ..".
std::string bare_message(std::string message) {
  if (const auto column = message.find(", column "); column != std::string::npos)
    if (const auto colon = message.find(": ", column); colon != std::string::npos) message.erase(0, colon + 2);
  if (message.starts_with('['))
    if (const auto end = message.find("] "); end != std::string::npos) message.erase(0, end + 2);
  if (message.starts_with("syntax error ")) message.replace(0, 13, "JSON syntax error ");
  message = core::single_line(message);
  return message.size() > 200 ? message.substr(0, 200) + ".." : message;
}

/// Builds the values as the parser reports them.  A member returns true to go on, as the parser wants it.
class TreeHandler {
 public:
  TreeHandler(Reading& reading, const std::string& file) : reading_(reading), file_(file) {}
  std::unique_ptr<JsonValue> root = std::make_unique<JsonValue>();

  bool null() { return put(JsonValue::Kind::null) != nullptr; }
  bool boolean(bool b) {
    put(JsonValue::Kind::boolean)->boolean = b;
    return true;
  }
  bool number_integer(std::int64_t n) { return number(static_cast<double>(n)); }
  bool number_unsigned(std::uint64_t n) { return number(static_cast<double>(n)); }
  bool number_float(double x, const std::string&) { return number(x); }
  bool string(std::string& text) {
    put(JsonValue::Kind::string)->string = std::move(text);
    return true;
  }
  bool binary(nlohmann::json::binary_t&) { return false; }
  bool start_object(std::size_t) { return open(JsonValue::Kind::object); }
  bool start_array(std::size_t) { return open(JsonValue::Kind::array); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool key(std::string& name) {
    JsonValue& object = *open_.back();
    if (const auto same = std::find(object.keys.begin(), object.keys.end(), name); same != object.keys.end())
      fail(core::format("the key '%s' is given twice, first in line %d", shown_word(name).c_str(),
                        object.items[static_cast<std::size_t>(same - object.keys.begin())].line));
    object.keys.push_back(std::move(name));
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& error) {
    fail(bare_message(error.what()));
  }

 private:
  [[noreturn]] void fail(const std::string& message) {
    throw core::InputError(core::format("%s:%d", file_.c_str(), reading_.line_now()), message);
  }
  bool number(double x) {
    put(JsonValue::Kind::number)->number = x;
    return true;
  }
  JsonValue* put(JsonValue::Kind kind) {
    JsonValue* value = root.get();
    if (!open_.empty()) value = &open_.back()->items.emplace_back();
    value->kind = kind;
    value->line = reading_.line_now();
    return value;
  }
  bool open(JsonValue::Kind kind) {
    if (open_.size() == deepest_nesting) fail(core::format("nested deeper than %zu levels", deepest_nesting));
    open_.push_back(put(kind));  // stays where it is: its parent grows only after it is closed
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  Reading& reading_;
  const std::string& file_;
  std::vector<JsonValue*> open_;
};

}  // namespace

JsonDocument::JsonDocument(std::string_view text, std::string file) : file_(std::move(file)) {
  require_text(text, file_);
  Reading reading{without_byte_order_mark(text)};
  if (reading.text.find_first_not_of(" \t\r\n") == std::string_view::npos)
    throw core::InputError(file_, "the file is empty: a JSON object is expected");
  TreeHandler handler(reading, file_);
  nlohmann::json::sax_parse(CountingIterator(&reading, 0), CountingIterator(&reading, reading.text.size()), &handler,
                            nlohmann::json::input_format_t::json, true, true);
  root_ = std::move(handler.root);
}

}  // namespace interflect::scene::io
