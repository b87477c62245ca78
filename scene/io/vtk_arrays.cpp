#include "scene/io/vtk_arrays.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>

#include "core/error.h"
#include "core/format.h"
#include "scene/io/text_file.h"

namespace interflect::scene::io {
namespace {

constexpr const char* blanks = " \t\r\n";

/// A byte that deflate has compressed stands for at most so many.
constexpr std::uint64_t deflate_limit = 1032;

std::uint64_t little_endian_number(std::string_view bytes) {
  std::uint64_t value = 0;
  for (std::size_t k = bytes.size(); k-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[k]);
  return value;
}

/// The value of a base64 digit, or -1.
int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

struct NumberType {
  const char* name;
  std::size_t bytes;
  double (*read)(const char*);
};

template <class T>
double read_as(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

constexpr std::array<NumberType, 10> number_types = {{{"Float64", 8, read_as<double>},
                                                      {"Float32", 4, read_as<float>},
                                                      {"Int64", 8, read_as<std::int64_t>},
                                                      {"UInt64", 8, read_as<std::uint64_t>},
                                                      {"Int32", 4, read_as<std::int32_t>},
                                                      {"UInt32", 4, read_as<std::uint32_t>},
                                                      {"Int16", 2, read_as<std::int16_t>},
                                                      {"UInt16", 2, read_as<std::uint16_t>},
                                                      {"Int8", 1, read_as<std::int8_t>},
                                                      {"UInt8", 1, read_as<std::uint8_t>}}};

std::string attribute_or(const XmlElement& element, const char* key, const char* otherwise) {
  const std::string* value = element.attribute(key);
  return value ? *value : otherwise;
}

std::vector<double> numbers_of_text(std::string_view text) {
  std::vector<double> out;
  for (std::size_t at = text.find_first_not_of(blanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
    double value = 0;
    const auto [stop, error] = std::from_chars(text.data() + at, text.data() + end, value);
    if (stop != text.data() + end || (error != std::errc() && error != std::errc::result_out_of_range)) return {};
    out.push_back(value);  // what is too small for a double is 0; what is too large is found not to be finite later
    at = text.find_first_not_of(blanks, end);
  }
  return out;
}

/// Exactly `size` bytes of what zlib has compressed; "" if it is something else.
std::string inflated(std::string_view bytes, std::uint64_t size) {
  std::string out(size, '\0');
  uLongf length = size;
  const int result = ::uncompress(reinterpret_cast<Bytef*>(out.data()), &length,
                                  reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  return result == Z_OK && length == size ? out : "";
}

}  // namespace

/// Bytes in a row, as they are or in base64 (padded wherever a part of them ended).
class VtkArrays::Source {
 public:
  Source(std::string_view bytes, bool base64) : rest_(bytes), base64_(base64) {}

  /// At most so many bytes are left.
  std::uint64_t left() const { return spare_.size() + (base64_ ? rest_.size() / 4 * 3 : rest_.size()); }

  /// The next bytes; false where there are fewer.
  bool take(std::uint64_t count, std::string& out) {
    out.clear();
    if (count > left()) return false;
    if (!base64_) {
      out = rest_.substr(0, count);
      rest_.remove_prefix(count);
      return true;
    }
    while (spare_.size() < count)
      if (!decode_four()) return false;
    out = spare_.substr(0, count);
    spare_.erase(0, count);
    return true;
  }

 private:
  bool decode_four() {
    std::array<int, 4> digit{};
    int padding = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size()));
      if (rest_.empty()) return false;
      if (rest_[0] == '=') {
        if (k < 2) return false;
        ++padding;
      } else {
        digit[k] = base64_digit(rest_[0]);
        if (digit[k] < 0 || padding > 0) return false;
      }
      rest_.remove_prefix(1);
    }
    const int all = digit[0] << 18 | digit[1] << 12 | digit[2] << 6 | digit[3];
    for (int k = 0; k < 3 - padding; ++k) spare_ += static_cast<char>(all >> (16 - 8 * k) & 0xFF);
    return true;
  }

  std::string_view rest_;
  bool base64_;
  std::string spare_;  ///< decoded and not taken yet
};

VtkArrays::VtkArrays(const XmlElement& root, const std::string& shown) : shown_(shown) {
  if (const std::string* compressor = root.attribute("compressor")) {
    if (*compressor != "vtkZLibDataCompressor")
      fail(root, "its data are compressed by '" + shown_word(*compressor) + "': zlib, or none, is expected");
    zlib_ = true;
  }
  const std::string order = attribute_or(root, "byte_order", "LittleEndian");
  if (order != "LittleEndian" && order != "BigEndian")
    fail(root, unknown_word("the byte order", order, {"LittleEndian", "BigEndian"}));
  swap_ = (order == "LittleEndian") != (std::endian::native == std::endian::little);
  const std::string header = attribute_or(root, "header_type", "UInt32");
  if (header != "UInt32" && header != "UInt64")
    fail(root, unknown_word("the header type", header, {"UInt32", "UInt64"}));
  header_bytes_ = header == "UInt32" ? 4 : 8;
  const XmlElement* appended = root.child("AppendedData");
  if (!appended) return;
  const std::string encoding = attribute_or(*appended, "encoding", "base64");
  if (encoding != "raw" && encoding != "base64")
    fail(*appended, unknown_word("the encoding", encoding, {"raw", "base64"}));
  appended_base64_ = encoding == "base64";
  const std::size_t start = appended->text.find('_');
  if (start == std::string_view::npos) fail(*appended, "the appended data do not begin with '_'");
  appended_ = appended->text.substr(start + 1);
}

void VtkArrays::fail(const XmlElement& where, const std::string& message) const {
  throw core::InputError(core::format("%s:%d", shown_.c_str(), where.line), message);
}

std::uint64_t VtkArrays::most(std::uint64_t bytes) const { return zlib_ ? deflate_limit * bytes : bytes; }

/// The bytes of an array that is not written as text.
std::string VtkArrays::decoded(const XmlElement& array) const {
  const auto make_source = [&]() -> Source {
    const std::string format = attribute_or(array, "format", "");
    if (format == "binary") return {array.text, true};
    if (format != "appended") fail(array, unknown_word("the format", format, {"ascii", "binary", "appended"}));
    const std::string offset = attribute_or(array, "offset", "");
    std::uint64_t at = 0;
    const auto [stop, error] = std::from_chars(offset.data(), offset.data() + offset.size(), at);
    if (offset.empty() || error != std::errc() || stop != offset.data() + offset.size() || at > appended_.size())
      fail(array, "its offset does not lie in the appended data");
    return {appended_.substr(at), appended_base64_};
  };
  Source source = make_source();
  std::string bytes;
  const auto header = [&] {
    if (!source.take(header_bytes_, bytes)) fail(array, "the data end within an array, or are not in base64");
    if (swap_) std::reverse(bytes.begin(), bytes.end());
    return little_endian_number(bytes);
  };
  const std::uint64_t first = header();
  if (!zlib_) {
    if (!source.take(first, bytes)) fail(array, "the data end within an array, or are not in base64");
    return bytes;
  }
  if (first > source.left()) fail(array, "it promises more blocks than there are data");
  if (first == 0) return "";
  const std::uint64_t block = header(), last = header();
  std::vector<std::uint64_t> sizes;
  for (std::uint64_t k = 0; k < first; ++k) sizes.push_back(header());
  std::string out;
  for (std::uint64_t k = 0; k < first; ++k) {
    const std::uint64_t size = k + 1 == first && last != 0 ? last : block;
    if (!source.take(sizes[k], bytes)) fail(array, "the data end within an array, or are not in base64");
    if (size > deflate_limit * (sizes[k] + 1)) fail(array, "a block of it promises more than it can hold");
    const std::string plain = inflated(bytes, size);
    if (plain.size() != size) fail(array, "a block of it cannot be decompressed");
    out += plain;
  }
  return out;
}

std::vector<double> VtkArrays::numbers(const XmlElement& array, std::uint64_t count) const {
  const std::string name = attribute_or(array, "type", "");
  const auto type =
      std::find_if(number_types.begin(), number_types.end(), [&](const NumberType& t) { return t.name == name; });
  if (type == number_types.end()) fail(array, "the type '" + shown_word(name) + "' is not a known type of numbers");
  std::vector<double> out;
  if (attribute_or(array, "format", "") == "ascii") {
    out = numbers_of_text(array.text);
  } else {
    std::string bytes = decoded(array);
    if (bytes.size() % type->bytes != 0) fail(array, "its data are no whole numbers of its type");
    for (std::size_t at = 0; at < bytes.size(); at += type->bytes) {
      const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
      if (swap_) std::reverse(place, place + static_cast<std::ptrdiff_t>(type->bytes));
      out.push_back(type->read(bytes.data() + at));
    }
  }
  if (out.size() != count)
    fail(array, core::format("%llu numbers are expected, not %zu", static_cast<unsigned long long>(count), out.size()));
  return out;
}

std::vector<std::string> VtkArrays::texts(const XmlElement& array, std::uint64_t count) const {
  std::string letters;
  if (attribute_or(array, "format", "") == "ascii")
    for (const double code : numbers_of_text(array.text))
      letters += code > 0 && code < 256 ? static_cast<char>(static_cast<unsigned char>(code)) : '\0';
  else
    letters = decoded(array);
  std::vector<std::string> out;
  for (std::size_t at = 0; at < letters.size();) {
    const std::size_t end = std::min(letters.find('\0', at), letters.size());
    out.push_back(letters.substr(at, end - at));
    at = end + 1;
  }
  if (out.size() != count)
    fail(array, core::format("%llu texts are expected, not %zu", static_cast<unsigned long long>(count), out.size()));
  return out;
}

}  // namespace interflect::scene::io
