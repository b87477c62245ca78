#include "measure/path_classes.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "core/error.h"
#include "core/format.h"

namespace interflect::measure {
namespace {

constexpr std::size_t most_states = 64, longest_expression = 1000;
constexpr const char* letters = "APFBDGSE";

[[noreturn]] void too_many(const std::string& expression) {
  throw core::InputError("paths '" + expression + "'", "an expression of at most 64 states expected");
}

}  // namespace

/// Reads an expression: Thompson's automaton, whose sets of states become the states of the answer.
class PathExpression {
 public:
  explicit PathExpression(const std::string& text) : text_(text) {
    if (text.size() > longest_expression) too_many(text.substr(0, 20) + "..");
  }

  PathClasses read() {
    const Part whole = alternatives();
    if (at_ < text_.size()) fail("a letter of LAPFBDGSE.()|*+? expected");
    return determined(whole);
  }

 private:
  struct State {
    std::array<int, path_letters> on;  ///< -1: none
    std::vector<int> free;             ///< without a letter
  };
  struct Part {
    int first, last;
  };

  [[noreturn]] void fail(const std::string& expected) const {
    throw core::InputError(core::format("paths '%s', at character %zu", text_.c_str(), at_ + 1), expected);
  }
  int state() {
    states_.push_back({});
    states_.back().on.fill(-1);
    return static_cast<int>(states_.size()) - 1;
  }
  void freely(int from, int to) { states_[static_cast<std::size_t>(from)].free.push_back(to); }
  void skip_spaces() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  bool take(char c) {
    skip_spaces();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  Part alternatives() {
    const Part all{state(), state()};
    do {
      const Part one = sequence();
      freely(all.first, one.first), freely(one.last, all.last);
    } while (take('|'));
    return all;
  }
  Part sequence() {
    Part all{state(), 0};
    all.last = all.first;
    for (skip_spaces(); at_ < text_.size() && text_[at_] != '|' && text_[at_] != ')'; skip_spaces()) {
      const Part next = repeated();
      freely(all.last, next.first);
      all.last = next.last;
    }
    return all;
  }
  Part repeated() {
    Part part = single();
    for (;;) {
      const bool any = take('*'), more = !any && take('+'), maybe = !any && !more && take('?');
      if (!any && !more && !maybe) return part;
      const Part around{state(), state()};
      freely(around.first, part.first), freely(part.last, around.last);
      if (any || more) freely(part.last, part.first);
      if (any || maybe) freely(around.first, around.last);
      part = around;
    }
  }
  Part single() {
    if (++depth_ > most_states) fail("no more brackets in brackets expected");
    if (take('(')) {
      const Part inside = alternatives();
      if (!take(')')) fail("a closing bracket expected");
      --depth_;
      return inside;
    }
    --depth_;
    const Part part{state(), state()};
    const std::string read(1, text_[at_]), meant = read == "L" ? "APFB" : read == "." ? "DGS" : read;
    for (const char c : meant) {
      const std::size_t letter = std::string(letters).find(c);
      if (letter == std::string::npos) fail("a letter of LAPFBDGSE.()|*+? expected");
      states_[static_cast<std::size_t>(part.first)].on[letter] = part.last;
    }
    ++at_;
    return part;
  }

  void close(std::set<int>& of) const {
    std::vector<int> left(of.begin(), of.end());
    while (!left.empty()) {
      const int s = left.back();
      left.pop_back();
      for (const int to : states_[static_cast<std::size_t>(s)].free)
        if (of.insert(to).second) left.push_back(to);
    }
  }
  PathClasses determined(const Part& whole) const {
    std::set<int> begin{whole.first};
    close(begin);
    std::map<std::set<int>, std::uint8_t> number{{begin, 0}};
    std::vector<std::set<int>> sets{begin};
    std::vector<PathClasses::Row> next;
    std::vector<bool> accepting;
    for (std::size_t s = 0; s < sets.size(); ++s) {
      accepting.push_back(sets[s].contains(whole.last));
      PathClasses::Row row;
      for (std::size_t letter = 0; letter < path_letters; ++letter) {
        std::set<int> to;
        for (const int from : sets[s])
          if (const int on = states_[static_cast<std::size_t>(from)].on[letter]; on >= 0) to.insert(on);
        close(to);
        const auto [found, is_new] = number.try_emplace(to, static_cast<std::uint8_t>(sets.size()));
        if (is_new) sets.push_back(to);
        if (sets.size() > 255) too_many(text_);
        row[letter] = found->second;
      }
      next.push_back(row);
    }
    return PathClasses::smallest(std::move(next), std::move(accepting), text_);
  }

  const std::string& text_;
  std::size_t at_ = 0, depth_ = 0;
  std::vector<State> states_;
};

PathClasses PathClasses::of(const std::string& expression) { return PathExpression(expression).read(); }

/// Moore's refinement: states are one where no path tells them apart.
PathClasses PathClasses::smallest(std::vector<Row> next, std::vector<bool> accepting, std::string expression) {
  std::vector<std::uint8_t> part(accepting.begin(), accepting.end());
  for (std::size_t count = 0;;) {
    std::map<std::pair<std::uint8_t, Row>, std::uint8_t> number;  // the first state is in the first part
    std::vector<std::uint8_t> finer(part.size());
    for (std::size_t s = 0; s < part.size(); ++s) {
      Row to;
      for (std::size_t letter = 0; letter < path_letters; ++letter) to[letter] = part[next[s][letter]];
      finer[s] = number.try_emplace({part[s], to}, static_cast<std::uint8_t>(number.size())).first->second;
    }
    part = std::move(finer);
    if (number.size() == count) break;
    count = number.size();
  }
  const std::size_t states = 1 + *std::max_element(part.begin(), part.end());
  if (states > most_states) too_many(expression);
  PathClasses found;
  found.next_.resize(states);
  for (std::size_t s = 0; s < part.size(); ++s) {
    for (std::size_t letter = 0; letter < path_letters; ++letter) found.next_[part[s]][letter] = part[next[s][letter]];
    if (accepting[s]) found.accepting_ |= FromEye{1} << part[s];
  }
  found.expression_ = std::move(expression);
  return found;
}

PathClasses PathClasses::combined(const PathClasses& a, const PathClasses& b, bool with_b) {
  const std::string expression = "(" + a.expression_ + (with_b ? ") and (" : ") but not (") + b.expression_ + ")";
  std::map<std::pair<std::uint8_t, std::uint8_t>, std::uint8_t> number{{{0, 0}, 0}};
  std::vector<std::pair<std::uint8_t, std::uint8_t>> pairs{{0, 0}};
  std::vector<Row> next;
  std::vector<bool> accepting;
  for (std::size_t s = 0; s < pairs.size(); ++s) {
    const auto [in_a, in_b] = pairs[s];
    accepting.push_back(joined(in_a, a.accepting_) && joined(in_b, b.accepting_) == with_b);
    Row row;
    for (std::size_t letter = 0; letter < path_letters; ++letter) {
      const std::pair to{a.next_[in_a][letter], b.next_[in_b][letter]};
      const auto [found, is_new] = number.try_emplace(to, static_cast<std::uint8_t>(pairs.size()));
      if (is_new) pairs.push_back(to);
      if (pairs.size() > 255) too_many(expression);
      row[letter] = found->second;
    }
    next.push_back(row);
  }
  return smallest(std::move(next), std::move(accepting), expression);
}

PathClasses::FromEye PathClasses::after(FromEye walk, PathLetter letter) const {
  FromEye before = 0;
  for (std::size_t s = 0; s < next_.size(); ++s)
    before |= FromEye{joined(next_[s][static_cast<std::size_t>(letter)], walk)} << s;
  return before;
}

std::string PathClasses::shortest() const {
  std::vector<std::pair<std::uint8_t, std::string>> found{{std::uint8_t{0}, ""}};
  std::vector<bool> seen(next_.size(), false);
  seen[0] = true;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const auto [state, path] = found[k];
    if (joined(state, accepting_)) return path;
    for (std::size_t letter = 0; letter < path_letters; ++letter) {
      const std::uint8_t to = next_[state][letter];
      if (seen[to]) continue;
      seen[to] = true;
      found.emplace_back(to, path + letters[letter]);
    }
  }
  return "";
}

bool PathClasses::contains(const std::string& path) const {
  FromLight walk = before_light();
  for (const char c : path) {
    const std::size_t letter = std::string(letters).find(c);
    if (letter == std::string::npos) return false;
    walk = next_[walk][letter];
  }
  return joined(walk, accepting_);
}

}  // namespace interflect::measure
