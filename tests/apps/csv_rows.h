#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace interflect::test {

/// The lines of a CSV file as cells; none of the files under test quotes a cell.
inline std::vector<std::vector<std::string>> read_csv(const std::string& path) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream text(read_file(path));
  for (std::string line; std::getline(text, line);) {
    std::vector<std::string>& row = rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
  }
  return rows;
}

}  // namespace interflect::test
