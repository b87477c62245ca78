#pragma once

#include <concepts>
#include <string>
#include <string_view>

#include "core/spectrum.h"

namespace interflect::results {

/// Comma-separated text after RFC 4180 (with plain newlines): fields that need quotes get them, numbers have 12
/// significant digits, "inf" and "nan" are written so.
class Csv {
 public:
  Csv& text(std::string_view field);
  Csv& number(double value);
  Csv& integer(long long value);
  /// The first `channels` numbers.
  Csv& numbers(const Spectrum& values, int channels);
  /// NAME_0, NAME_1, ..
  Csv& headings(std::string_view name, int channels);
  Csv& end_line();

  const std::string& str() const { return out_; }

 private:
  void separate();

  std::string out_;
  bool first_ = true;
};

}  // namespace interflect::results
