#include <gtest/gtest.h>

#include "scene/io/json_document.h"
#include "scene/io/text_file.h"
#include "texts.h"

namespace interflect::scene::io {
namespace {

using test::complaint;
using namespace std::string_literals;

std::string said_of(std::string_view text) {
  try {
    const JsonDocument parsed(text, "s.json");
    return "parsed";
  } catch (const core::InputError& error) {
    return error.what();
  }
}

TEST(JsonText, every_value_knows_its_line) {
  const JsonDocument document(
      "{ // a comment\n\"a\": 1,\n\"b\":\n[2,\n3\n],\r\n\"c\": {\"d\": \"x\"},\n\"e\": true }\n", "s.json");
  const JsonNode root = document.root();
  EXPECT_EQ(root.place(), "s.json:1: /");
  EXPECT_EQ(root.at("a").place(), "s.json:2: /a");
  EXPECT_EQ(root.at("b").place(), "s.json:4: /b");
  EXPECT_EQ(root.at("b").items()[1].place(), "s.json:5: /b/1");
  EXPECT_EQ(root.at("c").at("d").place(), "s.json:7: /c/d");
  EXPECT_EQ(root.at("e").place(), "s.json:8: /e");
}

TEST(JsonText, pointers_escape_what_the_standard_says) {
  const JsonDocument document(R"({"a/b": {"~": 1}})", "s.json");
  EXPECT_EQ(document.root().at("a/b").at("~").place(), "s.json:1: /a~1b/~0");
}

TEST(JsonText, syntax_errors_name_their_line) {
  EXPECT_TRUE(said_of("{\n\"a\": 1,\n}").starts_with("s.json:3: JSON syntax error")) << said_of("{\n\"a\": 1,\n}");
  EXPECT_TRUE(said_of("{\"a\": NaN}").starts_with("s.json:1: JSON syntax error"));
  EXPECT_TRUE(said_of("{\"a\": 1e999}").starts_with("s.json:1: number overflow")) << said_of("{\"a\": 1e999}");
  EXPECT_TRUE(said_of("{} {}").starts_with("s.json:1: JSON syntax error"));
}

TEST(JsonText, a_text_cut_anywhere_is_refused_in_one_line) {
  const std::string text = test::Text{}.str();
  const std::size_t end = text.rfind('}');
  for (std::size_t length = 0; length < end; ++length) {
    const std::string said = complaint(text.substr(0, length));
    EXPECT_TRUE(said.starts_with("s.json")) << length << said;
  }
  EXPECT_EQ(complaint(text), "read");
}

TEST(JsonText, keys_given_twice_are_refused) {
  EXPECT_EQ(said_of("{\n\"a\": 1,\n\"b\": 2,\n\"a\": 3}"), "s.json:4: the key 'a' is given twice, first in line 2");
}

TEST(JsonText, huge_nesting_is_refused) {
  EXPECT_EQ(said_of(std::string(100000, '[')), "s.json:1: nested deeper than 64 levels");
  std::string objects;
  for (int k = 0; k < 100000; ++k) objects += "{\"a\":\n";
  EXPECT_EQ(said_of(objects), "s.json:65: nested deeper than 64 levels");
}

TEST(JsonText, foreign_encodings_are_named) {
  EXPECT_EQ(said_of("\xFF\xFE{\0}\0"s), "s.json: the file is in UTF-16: UTF-8 is expected");
  EXPECT_EQ(said_of("\xFE\xFF\0{\0}"s), "s.json: the file is in UTF-16: UTF-8 is expected");
  EXPECT_EQ(said_of("{\0\"\0a\0"s), "s.json: the file is in UTF-16: UTF-8 is expected");
  EXPECT_EQ(said_of("\0{\0\"\0a"s), "s.json: the file is in UTF-16: UTF-8 is expected");
  EXPECT_EQ(said_of("\xFF\xFE\0\0{\0\0\0"s), "s.json: the file is in UTF-32: UTF-8 is expected");
  EXPECT_EQ(said_of("{\0\0\0\"\0\0\0"s), "s.json: the file is in UTF-32: UTF-8 is expected");
  EXPECT_EQ(said_of("{ \"a\":\n \"b\0\" }"s), "s.json:2: a NUL byte: text in UTF-8 is expected");
  EXPECT_EQ(said_of("\xEF\xBB\xBF{\"a\": 1}"), "parsed");  // the mark of UTF-8
  EXPECT_TRUE(said_of("{\"a\": \"\xC3(\"}").starts_with("s.json:1: JSON syntax error"));
}

TEST(JsonText, empty_files_are_named) {
  EXPECT_EQ(said_of(""), "s.json: the file is empty: a JSON object is expected");
  EXPECT_EQ(said_of(" \n\n"), "s.json: the file is empty: a JSON object is expected");
}

TEST(JsonText, messages_stay_one_line_whatever_a_key_holds) {
  const std::string said =
      complaint(R"({"format": "interflect/scene/1", "uni\nts)" + std::string(5000, 'x') + R"(": 1})");
  EXPECT_TRUE(said.starts_with("s.json:1: /uni ts"));
  EXPECT_LT(said.size(), 600u);
}

TEST(Words, the_nearest_known_one_is_suggested) {
  const std::vector<std::string> known{"reflectance", "exitance", "flux", "sides"};
  EXPECT_EQ(unknown_word("the key", "reflectence", known),
            "the key 'reflectence' is not known: did you mean 'reflectance'?");
  EXPECT_EQ(unknown_word("the key", "fulx", known), "the key 'fulx' is not known: did you mean 'flux'?");
  EXPECT_EQ(unknown_word("the key", "colour", known),
            "the key 'colour' is not known: one of reflectance, exitance, flux, sides is expected");
}

}  // namespace
}  // namespace interflect::scene::io
