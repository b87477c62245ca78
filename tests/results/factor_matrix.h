#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/random.h"
#include "results/factors.h"

namespace interflect::test {

/// A symmetric matrix of any numbers, which no geometry has: files shall not care.
struct Matrix {
  explicit Matrix(std::size_t n) : size(n), K(n * n), error(n * n) {
    core::RandomNumbers numbers(7, n, 0);
    for (std::size_t i = 0; i < n; ++i) {
      elements.area.push_back(0.1 + numbers.next());
      elements.normal.emplace_back(0, 0, i % 2 == 0 ? 1 : -1);
      elements.centroid.emplace_back(numbers.next(), numbers.next(), 1e-300 * numbers.next());
      elements.name.push_back(i % 3 == 0   ? "wall, \"west\""
                              : i % 3 == 1 ? "plate/back"
                                           : "B\xC3\xB6"
                                             "den " +
                                                 std::to_string(i));
      for (std::size_t j = i; j < n; ++j) {
        const bool hidden = (i + j) % 5 == 4;
        K[i * n + j] = K[j * n + i] = hidden ? 0 : numbers.next() / 3 * std::pow(10, -3 * numbers.next());
        error[i * n + j] = error[j * n + i] = hidden ? 0 : 1e-9 * numbers.next();
      }
    }
  }

  std::vector<double> tile(const std::vector<double>& all, std::size_t i0, std::size_t j0, std::size_t rows,
                           std::size_t columns) const {
    std::vector<double> out;
    for (std::size_t a = 0; a < rows; ++a)
      for (std::size_t b = 0; b < columns; ++b) out.push_back(all[(i0 + a) * size + j0 + b]);
    return out;
  }

  results::FactorRows rows() const {
    return [this](Index i, std::span<double> F, std::span<double> bound) {
      const auto r = static_cast<std::size_t>(i);
      for (std::size_t j = 0; j < size; ++j)
        F[j] = K[r * size + j] / elements.area[r], bound[j] = error[r * size + j] / elements.area[r];
    };
  }

  std::size_t size;
  results::FactorElements elements;
  std::vector<double> K, error;
};

/// What is said of bad input; "" of good.  More than one line is said so.
inline std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const core::InputError& problem) {
    const std::string what = problem.what();
    return what.find('\n') == std::string::npos ? what : "MORE THAN ONE LINE: " + what;
  }
  return "";
}

}  // namespace interflect::test
