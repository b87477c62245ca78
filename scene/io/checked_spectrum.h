#pragma once

#include "core/spectrum.h"
#include "scene/io/json_document.h"

namespace interflect::scene::io {

/// A number for every channel, or an array with one for each.
Spectrum read_spectrum(const JsonNode& node, int channels);

/// The same, each number checked where it stands.
template <class Check>
Spectrum read_checked(const JsonNode& node, int channels, const Check& check) {
  if (node.is_array())
    for (const JsonNode& value : node.items()) check(value);
  else if (node.is_number())
    check(node);
  return read_spectrum(node, channels);
}

}  // namespace interflect::scene::io
