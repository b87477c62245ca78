#include "results/record.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "results/atomic_file.h"

namespace interflect::results {

namespace {

using Json = nlohmann::ordered_json;

/// Turns records into JSON and remembers the numbers that JSON cannot hold.
class Writer {
 public:
  Json object(const Record& record, const std::string& path) {
    Json out = Json::object();
    for (const Record::Entry& entry : record.entries()) {
      const std::string here = path + "/" + entry.key;
      out[entry.key] = std::visit([&](const auto& value) { return json(value, here); }, entry.value);
    }
    return out;
  }
  const std::vector<std::string>& not_finite() const { return not_finite_; }

 private:
  Json json(std::monostate, const std::string&) { return nullptr; }
  Json json(bool value, const std::string&) { return value; }
  Json json(std::int64_t value, const std::string&) { return value; }
  Json json(std::uint64_t value, const std::string&) { return value; }
  Json json(const std::string& value, const std::string&) { return value; }
  Json json(const Record::Strings& value, const std::string&) { return value; }
  Json json(const Record& value, const std::string& path) { return object(value, path); }
  Json json(double value, const std::string& path) {
    if (std::isfinite(value)) return value;
    not_finite_.push_back(path + (std::isnan(value) ? ": nan" : value > 0 ? ": inf" : ": -inf"));
    return nullptr;
  }
  template <class T>
  Json json(const std::vector<T>& values, const std::string& path) {
    Json out = Json::array();
    for (std::size_t i = 0; i < values.size(); ++i) out.push_back(json(values[i], path + "/" + std::to_string(i)));
    return out;
  }

  std::vector<std::string> not_finite_;
};

}  // namespace

Record& Record::add_value(std::string key, Value value) {
  entries_.push_back({std::move(key), std::move(value)});
  return *this;
}
Record& Record::add(std::string key, bool value) { return add_value(std::move(key), value); }
Record& Record::add(std::string key, double value) { return add_value(std::move(key), value); }
Record& Record::add(std::string key, std::string value) { return add_value(std::move(key), std::move(value)); }
Record& Record::add(std::string key, Numbers value) { return add_value(std::move(key), std::move(value)); }
Record& Record::add(std::string key, Strings value) { return add_value(std::move(key), std::move(value)); }
Record& Record::add(std::string key, Record value) { return add_value(std::move(key), std::move(value)); }
Record& Record::add(std::string key, List value) { return add_value(std::move(key), std::move(value)); }

Record& Record::add(std::string key, const Spectrum& value, int channels) {
  return add(std::move(key), Numbers(value.data(), value.data() + channels));
}

Record& Record::add_nothing(std::string key) { return add_value(std::move(key), std::monostate{}); }

Record& Record::section(std::string key) {
  add(std::move(key), Record());
  return std::get<Record>(entries_.back().value);
}

std::string json_text(const Record& record) {
  Writer writer;
  Json out = writer.object(record, "");
  if (!writer.not_finite().empty()) out["not_finite"] = writer.not_finite();
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_json(const std::filesystem::path& file, const Record& record) { write_atomically(file, json_text(record)); }

}  // namespace interflect::results
