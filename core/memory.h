#pragma once

namespace interflect::core {

/// The most memory that this process has had resident so far [bytes].
double peak_memory_bytes();

}  // namespace interflect::core
