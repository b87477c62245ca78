#include "measure/path_classes.h"

#include <gtest/gtest.h>

#include <regex>

#include "core/error.h"

namespace interflect::measure {
namespace {

PathLetter letter(char c) { return static_cast<PathLetter>(std::string("APFBDGSE").find(c)); }

/// All words of the letters up to a length.
std::vector<std::string> words(std::size_t longest) {
  std::vector<std::string> all{""};
  for (std::size_t begin = 0, length = 0; length < longest; ++length) {
    const std::size_t end = all.size();
    for (; begin < end; ++begin)
      for (const char c : std::string("APFBDGSE")) all.push_back(all[begin] + c);
  }
  return all;
}

std::regex known(const std::string& expression) {
  std::string written;
  for (const char c : expression) written += c == 'L' ? "[APFB]" : c == '.' ? "[DGS]" : std::string(1, c);
  return std::regex(written);
}

const std::vector<std::string> expressions{"L.*E",       "LD*E",       "LD?S*E",          "(A|F).*E|P(D|G).*E",
                                           "L(S*D)+S*E", "AS+(D|G)?E", "((P|F)(DS|G)*)+E"};

TEST(PathClasses, holds_the_words_of_its_expression) {
  for (const std::string& expression : expressions) {
    const PathClasses classes = PathClasses::of(expression);
    const std::regex regex = known(expression);
    for (const std::string& word : words(5))
      EXPECT_EQ(classes.contains(word), std::regex_match(word, regex)) << expression << ' ' << word;
  }
}

TEST(PathClasses, of_two_are_those_of_both_or_of_one_alone) {
  for (const std::string& first : expressions)
    for (const std::string& second : expressions) {
      const PathClasses a = PathClasses::of(first), b = PathClasses::of(second), both = a & b, only = a - b;
      for (const std::string& word : words(4)) {
        EXPECT_EQ(both.contains(word), a.contains(word) && b.contains(word)) << first << ' ' << second << ' ' << word;
        EXPECT_EQ(only.contains(word), a.contains(word) && !b.contains(word)) << first << ' ' << second << ' ' << word;
      }
      EXPECT_TRUE((both & (a - b)).empty());
      EXPECT_EQ(a == b, first == second) << first << ' ' << second;
    }
}

/// Wherever a path is cut in two, the walks from both ends accept what the whole is.
TEST(PathClasses, joins_walks_of_both_ends) {
  for (const std::string& expression : expressions) {
    const PathClasses classes = PathClasses::of(expression);
    for (const std::string& word : words(5))
      for (std::size_t cut = 0; cut <= word.size(); ++cut) {
        PathClasses::FromLight light = classes.before_light();
        for (std::size_t k = 0; k < cut; ++k) light = classes.after(light, letter(word[k]));
        PathClasses::FromEye eye = classes.before_eye();
        for (std::size_t k = word.size(); k > cut; --k) eye = classes.after(eye, letter(word[k - 1]));
        EXPECT_EQ(PathClasses::joined(light, eye), classes.contains(word)) << expression << ' ' << word << ' ' << cut;
      }
  }
}

TEST(PathClasses, shows_one_that_is_missed) {
  const PathClasses all = PathClasses::all(), path_tracing = PathClasses::of("(A|F).*E|(P|B)((D|G).*)?E");
  EXPECT_EQ((all - path_tracing).shortest(), "PSE");
  EXPECT_EQ((all - PathClasses::of("LD*E")).shortest().size(), 3u);
  EXPECT_TRUE((PathClasses::of("LD?S*E") - all).empty());
  EXPECT_EQ(PathClasses::of("L(D|G|S)*E"), all);
}

TEST(PathClasses, says_where_an_expression_is_wrong) {
  for (const auto& [expression, place] :
       std::vector<std::pair<std::string, std::string>>{{"LQE", "character 2"},
                                                        {"L(DE", "character 5"},
                                                        {"LD)E", "character 3"},
                                                        {"*L", "character 1"},
                                                        {"ldse", "character 1"},
                                                        {std::string(500, '('), "character 65"}}) {
    try {
      PathClasses::of(expression);
      FAIL() << expression;
    } catch (const core::InputError& error) {
      EXPECT_NE(std::string(error.what()).find(place), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(PathClasses::of(std::string(2000, 'D')), core::InputError);
  EXPECT_THROW(PathClasses::of(std::string(200, 'D')), core::InputError);
  EXPECT_TRUE(PathClasses::of("").empty());
  EXPECT_TRUE((PathClasses::of("LDE") & PathClasses::of("LSE")).empty());
}

}  // namespace
}  // namespace interflect::measure
