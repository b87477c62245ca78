#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/format.h"
#include "scene/io/json_document.h"
#include "scene/io/text_file.h"

namespace interflect::scene::io {
namespace {

const char* describe(JsonValue::Kind kind) {
  switch (kind) {
    case JsonValue::Kind::null:
      return "null";
    case JsonValue::Kind::boolean:
      return "true or false";
    case JsonValue::Kind::number:
      return "a number";
    case JsonValue::Kind::string:
      return "a string";
    case JsonValue::Kind::array:
      return "an array";
    case JsonValue::Kind::object:
      return "an object";
  }
  return "nothing";
}

/// One step of a JSON pointer (RFC 6901).
std::string escaped(std::string_view step) {
  std::string out;
  for (char c : step) {
    if (c == '~')
      out += "~0";
    else if (c == '/')
      out += "~1";
    else
      out += c;
  }
  return out;
}

}  // namespace

std::string JsonNode::place() const {
  return core::format("%s:%d: %s", file_->c_str(), value_->line, pointer_.empty() ? "/" : pointer_.c_str());
}

void JsonNode::fail(const std::string& message) const { throw core::InputError(place(), message); }

void JsonNode::require(JsonValue::Kind kind) const {
  if (value_->kind != kind) fail(std::string(describe(kind)) + " is expected, not " + describe(value_->kind));
}

JsonNode JsonNode::child(std::string_view step, const JsonValue& value) const {
  return {value, *file_, pointer_ + "/" + shown_word(escaped(step))};
}

const JsonValue* JsonNode::member(std::string_view key) const {
  require(JsonValue::Kind::object);
  const auto at = std::find(value_->keys.begin(), value_->keys.end(), key);
  return at == value_->keys.end() ? nullptr : &value_->items[static_cast<std::size_t>(at - value_->keys.begin())];
}

JsonNode JsonNode::at(std::string_view key) const {
  const JsonValue* value = member(key);
  if (!value) fail("the key '" + std::string(key) + "' is missing");
  return child(key, *value);
}

void JsonNode::only(const std::vector<std::string>& known) const {
  for (const auto& [key, node] : members())
    if (std::find(known.begin(), known.end(), key) == known.end()) node.fail(unknown_word("the key", key, known));
}

std::vector<std::pair<std::string, JsonNode>> JsonNode::members() const {
  require(JsonValue::Kind::object);
  std::vector<std::pair<std::string, JsonNode>> out;
  for (std::size_t k = 0; k < value_->keys.size(); ++k)
    out.emplace_back(value_->keys[k], child(value_->keys[k], value_->items[k]));
  return out;
}

std::vector<JsonNode> JsonNode::items(std::size_t least, std::size_t most) const {
  require(JsonValue::Kind::array);
  const std::size_t count = value_->items.size();
  if (least > 0 && least == most && count != least)
    fail(core::format("%zu elements are expected, not %zu", least, count));
  if (count < least) fail(core::format("at least %zu elements are expected, not %zu", least, count));
  if (most > 0 && count > most) fail(core::format("at most %zu elements are expected, not %zu", most, count));
  std::vector<JsonNode> out;
  out.reserve(count);
  for (std::size_t k = 0; k < count; ++k) out.push_back(child(std::to_string(k), value_->items[k]));
  return out;
}

std::string JsonNode::string() const {
  require(JsonValue::Kind::string);
  return value_->string;
}

bool JsonNode::boolean() const {
  require(JsonValue::Kind::boolean);
  return value_->boolean;
}

double JsonNode::number() const {
  require(JsonValue::Kind::number);
  if (!std::isfinite(value_->number)) fail("a finite number is expected");
  return value_->number;
}

double JsonNode::number_in(double low, double high) const {
  const double x = number();
  if (x < low || x > high) fail(core::format("%.9g is outside %.9g..%.9g", x, low, high));
  return x;
}

double JsonNode::positive() const {
  const double x = number();
  if (!(x > 0)) fail(core::format("%.9g is not positive", x));
  return x;
}

int JsonNode::integer_in(int low, int high) const {
  const double x = number_in(low, high);
  if (x != std::floor(x)) fail(core::format("%.9g is not a whole number", x));
  return static_cast<int>(x);
}

Vec3 JsonNode::vec3() const {
  const auto parts = items(3, 3);
  return {parts[0].number(), parts[1].number(), parts[2].number()};
}

std::size_t JsonNode::one_of(const std::vector<std::string>& words) const {
  const std::string word = string();
  const auto at = std::find(words.begin(), words.end(), word);
  if (at == words.end()) fail(unknown_word("the word", word, words));
  return static_cast<std::size_t>(at - words.begin());
}

}  // namespace interflect::scene::io
