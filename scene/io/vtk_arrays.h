#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scene/io/xml_document.h"

namespace interflect::scene::io {

/// The numbers of VTK's XML files in each way in which they are written: as text; in base64; behind the rest, as they
/// are or in base64; bare or compressed by zlib; of either byte order.
class VtkArrays {
 public:
  /// @param root  <VTKFile>
  /// @throws core::InputError  where it says what is not read: other compressors, unknown encodings
  VtkArrays(const XmlElement& root, const std::string& shown);

  /// Numbers of a <DataArray>.
  /// @param count  how many there are, which the file's size allows (see most)
  /// @throws core::InputError  "FILE:LINE: ..": another number of them, data that end too soon or cannot be decoded
  std::vector<double> numbers(const XmlElement& array, std::uint64_t count) const;
  /// As many texts of an <Array type="String">: codes of letters, each text ended by a 0.
  std::vector<std::string> texts(const XmlElement& array, std::uint64_t count) const;

  /// The most numbers of whatever kind that a file of so many bytes may hold.
  std::uint64_t most(std::uint64_t bytes) const;

  [[noreturn]] void fail(const XmlElement& where, const std::string& message) const;

 private:
  class Source;
  std::string decoded(const XmlElement& array) const;

  std::string shown_;
  bool zlib_ = false, swap_ = false, appended_base64_ = false;
  std::size_t header_bytes_ = 4;
  std::string_view appended_;  ///< behind its '_'
};

}  // namespace interflect::scene::io
