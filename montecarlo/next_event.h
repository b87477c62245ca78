#pragma once

#include <string>

namespace interflect::montecarlo {

/// Whether ways are drawn to lights (next-event estimation), or paths meet them by chance alone.
enum class NextEvent : bool { no, yes };

/// Of path tracing either way, in messages and in seeds: both draw numbers of their own.
inline std::string path_tracer_name(NextEvent next_event) {
  return next_event == NextEvent::yes ? "path tracer" : "unidirectional path tracer";
}

}  // namespace interflect::montecarlo
