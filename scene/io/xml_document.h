#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace interflect::scene::io {

/// An element of an XML text, with the line where it begins.
struct XmlElement {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<XmlElement> children;
  std::string_view text;  ///< in the bytes of the file: from its start to its first child, as it stands
  int line = 0;

  const std::string* attribute(std::string_view key) const;
  const XmlElement* child(std::string_view key) const;  ///< the first of that name
};

/// The root of an XML text: elements, attributes, comments, the five named entities; nesting to 32.  Of an element
/// called `raw` all that follows to the end of the bytes is its text, and ends the document: VTK puts binary data
/// there.
/// @param bytes  outlive what is returned
/// @throws core::InputError  "FILE:LINE: what was expected"
XmlElement parse_xml(std::string_view bytes, std::string_view raw, const std::string& shown);

}  // namespace interflect::scene::io
