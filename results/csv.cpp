#include "results/csv.h"

#include "core/format.h"

namespace interflect::results {

void Csv::separate() {
  if (!first_) out_ += ',';
  first_ = false;
}

Csv& Csv::text(std::string_view field) {
  separate();
  if (field.find_first_of(",\"\r\n") == std::string_view::npos) {
    out_ += field;
    return *this;
  }
  out_ += '"';
  for (char c : field) out_.append(c == '"' ? 2 : 1, c);
  out_ += '"';
  return *this;
}

Csv& Csv::number(double value) {
  separate();
  out_ += core::format("%.12g", value);
  return *this;
}

Csv& Csv::integer(long long value) {
  separate();
  out_ += std::to_string(value);
  return *this;
}

Csv& Csv::numbers(const Spectrum& values, int channels) {
  for (int c = 0; c < channels; ++c) number(values[c]);
  return *this;
}

Csv& Csv::headings(std::string_view name, int channels) {
  for (int c = 0; c < channels; ++c) text(std::string(name) + "_" + std::to_string(c));
  return *this;
}

Csv& Csv::end_line() {
  out_ += '\n';
  first_ = true;
  return *this;
}

}  // namespace interflect::results
