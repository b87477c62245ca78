#include "results/npz_file.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/error.h"

namespace interflect::results {

namespace {

static_assert(std::endian::native == std::endian::little, "zip and the arrays are little-endian");

using CrcTable = std::array<std::array<std::uint32_t, 256>, 8>;

/// table[k][b]: what the byte b does to the state k bytes further on.
constexpr CrcTable crc_table = [] {
  CrcTable table{};
  for (std::uint32_t b = 0; b < 256; ++b) {
    std::uint32_t c = b;
    for (int bit = 0; bit < 8; ++bit) c = (c >> 1) ^ (c & 1 ? 0xEDB88320u : 0);
    table[0][b] = c;
  }
  for (std::size_t k = 1; k < 8; ++k)
    for (std::size_t b = 0; b < 256; ++b) table[k][b] = (table[k - 1][b] >> 8) ^ table[0][table[k - 1][b] & 0xFF];
  return table;
}();

/// Little-endian fields, one behind the other.
class Fields {
 public:
  Fields& u16(std::uint64_t value) { return put(value, 2); }
  Fields& u32(std::uint64_t value) { return put(value, 4); }
  Fields& u64(std::uint64_t value) { return put(value, 8); }
  Fields& text(std::string_view value) {
    out_ += value;
    return *this;
  }
  const std::string& str() const { return out_; }

 private:
  Fields& put(std::uint64_t value, int bytes) {
    for (int k = 0; k < bytes; ++k) out_ += static_cast<char>(value >> (8 * k) & 0xFF);
    return *this;
  }
  std::string out_;
};

constexpr std::uint64_t in_zip64 = 0xFFFFFFFFu;  // "see the zip64 field"
constexpr std::uint64_t version_plain = 20, version_zip64 = 45, utf8_names = 1u << 11, january_1980 = 1u << 5 | 1;

std::string npy_header(const std::string& type, const std::vector<std::uint64_t>& shape) {
  std::string text = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (";
  for (std::size_t k = 0; k < shape.size(); ++k) text += (k > 0 ? ", " : "") + std::to_string(shape[k]);
  text += shape.size() == 1 ? ",), }" : "), }";
  constexpr std::size_t before = 10, alignment = 64;
  text.append(alignment - 1 - (before + text.size()) % alignment, ' ');
  text += '\n';
  return Fields().text("\x93NUMPY").text({"\1\0", 2}).u16(text.size()).text(text).str();
}

/// The code points of UTF-8 text.
std::u32string decoded(std::string_view text) {
  std::u32string out;
  for (std::size_t k = 0; k < text.size();) {
    const auto byte = static_cast<unsigned char>(text[k]);
    const std::size_t length = byte < 0x80 ? 1 : byte >> 5 == 6 ? 2 : byte >> 4 == 14 ? 3 : byte >> 3 == 30 ? 4 : 0;
    char32_t code = length < 2 ? byte : byte & (0x7Fu >> length);
    bool good = length > 0 && k + length <= text.size();
    for (std::size_t i = 1; good && i < length; ++i) {
      const auto next = static_cast<unsigned char>(text[k + i]);
      good = next >> 6 == 2;
      code = code << 6 | (next & 0x3Fu);
    }
    good = good && code <= 0x10FFFF && !(code >= 0xD800 && code < 0xE000);
    out += good ? code : U'\uFFFD';
    k += good ? length : 1;
  }
  return out;
}

template <class T>
std::string_view bytes_of(std::span<const T> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

}  // namespace

void Crc32::add(std::string_view bytes) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(bytes[k]); };
  std::uint32_t s = state_;
  std::size_t at = 0;
  for (; at + 8 <= bytes.size(); at += 8) {
    std::uint32_t low, high;
    std::memcpy(&low, bytes.data() + at, 4);
    std::memcpy(&high, bytes.data() + at + 4, 4);
    low ^= s;
    s = 0;
    for (std::size_t k = 0; k < 4; ++k)
      s ^= crc_table[7 - k][low >> (8 * k) & 0xFF] ^ crc_table[3 - k][high >> (8 * k) & 0xFF];
  }
  for (; at < bytes.size(); ++at) s = (s >> 8) ^ crc_table[0][(s ^ byte(at)) & 0xFF];
  state_ = s;
}

void NpzFile::emit(std::string_view bytes) {
  file_.write(bytes);
  position_ += bytes.size();
}

void NpzFile::begin(const std::string& name, const std::string& type, std::size_t item,
                    const std::vector<std::uint64_t>& shape) {
  if (left_ > 0) throw core::PreconditionError("NpzFile: an array is not filled");
  const std::string header = npy_header(type, shape);
  std::uint64_t size = item;
  for (const std::uint64_t n : shape) size *= n;
  const Entry& entry = entries_.emplace_back(Entry{name + ".npy", position_, header.size() + size, 0});
  const bool large = entry.size >= zip64_from_;
  Fields extra;
  if (large) extra.u16(1).u16(16).u64(entry.size).u64(entry.size);
  // The fields of these records, in their order:
  // clang-format off
  emit(Fields().text("PK\3\4").u16(large ? version_zip64 : version_plain).u16(utf8_names).u16(0).u16(0).u16(january_1980)
           .u32(0).u32(large ? in_zip64 : entry.size).u32(large ? in_zip64 : entry.size)
           .u16(entry.name.size()).u16(extra.str().size()).text(entry.name).text(extra.str()).str());
  // clang-format on
  crc_ = {};
  left_ = entry.size;
  put(header);
}

void NpzFile::put(std::string_view bytes) {
  if (bytes.size() > left_) throw core::PreconditionError("NpzFile: more than the shape holds");
  crc_.add(bytes);
  emit(bytes);
  left_ -= bytes.size();
}

void NpzFile::put(std::span<const double> numbers) { put(bytes_of(numbers)); }

void NpzFile::end() {
  if (left_ > 0) throw core::PreconditionError("NpzFile: an array is not filled");
  constexpr std::uint64_t crc_position = 14;  // in the header, which had to come before the bytes
  entries_.back().crc = crc_.value();
  file_.write_over(entries_.back().position + crc_position, Fields().u32(crc_.value()).str());
}

void NpzFile::add(const std::string& name, std::span<const double> numbers, const std::vector<std::uint64_t>& shape) {
  begin(name, "<f8", sizeof(double), shape);
  put(numbers);
  end();
}

void NpzFile::add(const std::string& name, std::span<const std::string> texts) {
  std::size_t width = 1;
  for (const std::string& text : texts) width = std::max(width, decoded(text).size());
  begin(name, "<U" + std::to_string(width), 4 * width, {texts.size()});
  for (const std::string& text : texts) {
    std::u32string letters = decoded(text);
    letters.resize(width, U'\0');
    put(bytes_of(std::span<const char32_t>(letters)));
  }
  end();
}

std::string NpzFile::directory_entry(const Entry& entry) const {
  const bool large = entry.size >= zip64_from_, far = entry.position >= zip64_from_;
  Fields extra;
  if (large || far) {
    extra.u16(1).u16((large ? 16 : 0) + (far ? 8 : 0));
    if (large) extra.u64(entry.size).u64(entry.size);
    if (far) extra.u64(entry.position);
  }
  const std::uint64_t size = large ? in_zip64 : entry.size;
  const std::uint64_t version = large || far ? version_zip64 : version_plain;
  // clang-format off
  return Fields().text("PK\1\2").u16(version).u16(version).u16(utf8_names).u16(0).u16(0).u16(january_1980).u32(entry.crc)
      .u32(size).u32(size).u16(entry.name.size()).u16(extra.str().size()).u16(0).u16(0).u16(0).u32(0)
      .u32(far ? in_zip64 : entry.position).text(entry.name).text(extra.str()).str();
  // clang-format on
}

void NpzFile::keep() {
  if (left_ > 0) throw core::PreconditionError("NpzFile: an array is not filled");
  const std::uint64_t start = position_;
  for (const Entry& entry : entries_) emit(directory_entry(entry));
  const std::uint64_t size = position_ - start, count = entries_.size();
  const bool far = start >= zip64_from_;
  if (far) {
    const std::uint64_t here = position_;
    // clang-format off
    emit(Fields().text("PK\6\6").u64(44).u16(version_zip64).u16(version_zip64).u32(0).u32(0).u64(count).u64(count)
             .u64(size).u64(start).str());
    // clang-format on
    emit(Fields().text("PK\6\7").u32(0).u64(here).u32(1).str());
  }
  emit(Fields().text("PK\5\6").u16(0).u16(0).u16(count).u16(count).u32(size).u32(far ? in_zip64 : start).u16(0).str());
  file_.keep();
}

}  // namespace interflect::results
