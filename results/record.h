#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/spectrum.h"

namespace interflect::results {

/// What is known of a run, as an ordered tree of named values: enough to repeat it and to judge it.  Becomes a JSON
/// file.
class Record {
 public:
  struct Entry;
  using Numbers = std::vector<double>;
  using Strings = std::vector<std::string>;
  using List = std::vector<Record>;
  using Value = std::variant<bool, std::int64_t, std::uint64_t, double, std::string, Numbers, Strings, Record, List,
                             std::monostate>;

  Record& add(std::string key, bool value);
  Record& add(std::string key, double value);
  Record& add(std::string key, std::string value);
  Record& add(std::string key, const char* value) { return add(std::move(key), std::string(value)); }
  Record& add(std::string key, Numbers value);
  Record& add(std::string key, Strings value);
  Record& add(std::string key, Record value);
  Record& add(std::string key, List value);
  /// Counts, ids and seeds: all integers as they are, whatever their size and sign.
  template <class Integer>
  requires std::is_integral_v<Integer> Record& add(const std::string& key, Integer value);
  /// The first `channels` numbers of a spectrum.
  Record& add(std::string key, const Spectrum& value, int channels);
  /// There is no such value, null.
  Record& add_nothing(std::string key);
  /// An empty section, to be filled through the reference.
  Record& section(std::string key);

  const std::vector<Entry>& entries() const { return entries_; }

 private:
  Record& add_value(std::string key, Value value);

  std::vector<Entry> entries_;
};

struct Record::Entry {
  std::string key;
  Value value;
};

// A value may be a record: only here, where entries are known, can one be made.
template <class Integer>
requires std::is_integral_v<Integer> Record& Record::add(const std::string& key, Integer value) {
  using Widest = std::conditional_t<std::is_signed_v<Integer>, std::int64_t, std::uint64_t>;
  return add_value(key, static_cast<Widest>(value));
}

/// JSON text, UTF-8, indented by two.  JSON knows no infinity and no NaN: they become null, and a list "not_finite" at
/// the end of the text says which they were ("/energy/residual/0: inf").  Numbers read back as the same bits.
std::string json_text(const Record& record);
/// @throws core::InputError  see write_atomically
void write_json(const std::filesystem::path& file, const Record& record);

}  // namespace interflect::results
