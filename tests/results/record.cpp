#include "results/record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/support/temporary_folder.h"

using namespace interflect;
using namespace interflect::results;
using nlohmann::json;

TEST(Record, keeps_its_order_and_every_kind_of_value) {
  Record record;
  record.add("zeta", "text").add("alpha", 1.5).add("count", std::uint64_t{1} << 60).add("flag", true);
  record.add("seed", ~std::uint64_t{0}).add("below", -7);
  record.section("inner").add("numbers", Record::Numbers{1, 2}).add("words", Record::Strings{"a", "b"});
  record.add("list", Record::List{Record().add("i", 1), Record().add("i", 2)});
  Spectrum s;
  s[0] = 7;
  record.add("spectrum", s, 1);
  const std::string text = json_text(record);
  EXPECT_LT(text.find("zeta"), text.find("alpha"));
  EXPECT_EQ(json::parse(text), json::parse(R"({"zeta": "text", "alpha": 1.5, "count": 1152921504606846976, "flag": true,
    "seed": 18446744073709551615, "below": -7,
    "inner": {"numbers": [1.0, 2.0], "words": ["a", "b"]}, "list": [{"i": 1}, {"i": 2}], "spectrum": [7.0]})"));
}

TEST(Record, numbers_read_back_as_the_same_bits) {
  Record::Numbers numbers{1.0 / 3, 1e-300, 5e-324, 1.7976931348623157e308, -0.1, 123456789.123456789};
  const json back = json::parse(json_text(Record().add("n", numbers)));
  for (std::size_t i = 0; i < numbers.size(); ++i) EXPECT_EQ(back["n"][i].get<double>(), numbers[i]);
}

TEST(Record, what_json_cannot_hold_becomes_null_and_is_listed) {
  const double inf = std::numeric_limits<double>::infinity();
  Record record;
  record.section("a").add("bound", inf).add("list", Record::Numbers{1, -inf, std::nan("")});
  const json back = json::parse(json_text(record));
  EXPECT_TRUE(back["a"]["bound"].is_null());
  EXPECT_TRUE(back["a"]["list"][1].is_null());
  EXPECT_EQ(back["not_finite"], json({"/a/bound: inf", "/a/list/1: -inf", "/a/list/2: nan"}));
}

TEST(Record, text_that_is_not_utf8_still_makes_valid_json) {
  EXPECT_NO_THROW({ EXPECT_FALSE(json::parse(json_text(Record().add("name", "caf\xe9"))).empty()); });
  EXPECT_EQ(json::parse(json_text(Record().add("name", "a\"b\\c\n")))["name"], "a\"b\\c\n");
}

TEST(Record, is_written_as_a_file) {
  const test::TemporaryFolder scratch;
  write_json(scratch / "summary.json", Record().add("elements", 5));
  EXPECT_EQ(test::read_file(scratch / "summary.json"), "{\n  \"elements\": 5\n}\n");
}
