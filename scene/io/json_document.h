#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/vec.h"

namespace interflect::scene::io {

/// A value of a JSON text, with the line where it begins.
struct JsonValue {
  enum class Kind { null, boolean, number, string, array, object };
  Kind kind = Kind::null;
  int line = 0;
  bool boolean = false;
  double number = 0;
  std::string string;
  std::vector<JsonValue> items;   ///< of an array, or the values of an object
  std::vector<std::string> keys;  ///< of an object, beside `items`
};

/// A value seen from where it stands, so that complaints name their place: "office.json:41:
/// /materials/walls/reflectance: ..".
///
/// A cursor: it must not outlive its JsonDocument.  Everything that does not fit throws core::InputError.
class JsonNode {
 public:
  JsonNode(const JsonValue& value, const std::string& file, std::string pointer)
      : value_(&value), file_(&file), pointer_(std::move(pointer)) {}

  [[noreturn]] void fail(const std::string& message) const;
  std::string place() const;  ///< "office.json:41: /materials/walls"

  bool is_number() const { return value_->kind == JsonValue::Kind::number; }
  bool is_string() const { return value_->kind == JsonValue::Kind::string; }
  bool is_array() const { return value_->kind == JsonValue::Kind::array; }
  bool is_object() const { return value_->kind == JsonValue::Kind::object; }

  /// Refuses keys that are not among these, and names the nearest that is.
  void only(const std::vector<std::string>& known) const;
  bool has(std::string_view key) const { return member(key) != nullptr; }
  JsonNode at(std::string_view key) const;  ///< refuses an object without the key
  std::vector<std::pair<std::string, JsonNode>> members() const;

  /// Elements of an array of at least `least` and, unless 0, at most `most`.
  std::vector<JsonNode> items(std::size_t least = 0, std::size_t most = 0) const;

  std::string string() const;
  bool boolean() const;
  double number() const;                            ///< finite
  double number_in(double low, double high) const;  ///< ends included
  double positive() const;                          ///< finite and > 0
  int integer_in(int low, int high) const;
  Vec3 vec3() const;
  /// The position of a string among `words`.
  std::size_t one_of(const std::vector<std::string>& words) const;

 private:
  const JsonValue* member(std::string_view key) const;
  JsonNode child(std::string_view step, const JsonValue& value) const;
  void require(JsonValue::Kind kind) const;

  const JsonValue* value_;
  const std::string* file_;
  std::string pointer_;
};

/// A whole JSON text.  `//` comments are allowed; keys that are given twice are not, nor nesting beyond 64.
class JsonDocument {
 public:
  /// @throws core::InputError  "FILE:LINE: what was expected"
  JsonDocument(std::string_view text, std::string file);
  JsonNode root() const { return {*root_, file_, ""}; }

 private:
  std::string file_;
  std::unique_ptr<JsonValue> root_;
};

}  // namespace interflect::scene::io
