#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace interflect::test {

/// The bytes of an array, its length checked.
inline std::string decoded(const std::string& xml, const std::string& name) {
  std::size_t at = xml.find("Name=\"" + name + "\"");
  if (at == std::string::npos) return "none";
  at = xml.find(">\n", at) + 2;
  const std::string text = xml.substr(at, xml.find('\n', at) - at);
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for (char c : text) {
    if (c == '=') break;
    group = group << 6 | static_cast<std::uint32_t>(digits.find(c));
    if ((bits += 6) >= 8) bytes += static_cast<char>(group >> (bits -= 8) & 255u);
  }
  std::uint64_t length = 0;
  std::memcpy(&length, bytes.data(), sizeof length);
  EXPECT_EQ(bytes.size(), sizeof length + length) << name;
  return bytes.substr(sizeof length);
}

/// Of the array of that name of a .vtu of ours.
template <class T>
std::vector<T> values(const std::string& xml, const std::string& name) {
  const std::string bytes = decoded(xml, name);
  std::vector<T> out(bytes.size() / sizeof(T));
  std::memcpy(out.data(), bytes.data(), out.size() * sizeof(T));
  return out;
}

}  // namespace interflect::test
