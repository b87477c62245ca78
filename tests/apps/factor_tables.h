#pragma once

#include <map>
#include <regex>
#include <sstream>
#include <string>

namespace interflect::test {

struct TableEntry {
  double F, error;
};
/// F and its error by the two columns before them.
inline std::map<std::pair<std::string, std::string>, TableEntry> entries_of(const std::string& csv) {
  std::map<std::pair<std::string, std::string>, TableEntry> entries;
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    const std::size_t error = line.rfind(','), F = line.rfind(',', error - 1), to = line.rfind(',', F - 1);
    entries[{line.substr(0, to), line.substr(to + 1, F - to - 1)}] = {std::stod(line.substr(F + 1)),
                                                                      std::stod(line.substr(error + 1))};
  }
  return entries;
}

/// As Circumstances::interrupt_when: the progress, which is told after two seconds, says that there are some tiles.
inline bool some_tiles(const std::string& err) {
  static const std::regex pattern("form factors: [1-9][0-9]* %");
  return std::regex_search(err, pattern);
}

}  // namespace interflect::test
