#pragma once

namespace interflect::montecarlo {

/// Whether ways are drawn to lights (next-event estimation), or paths meet them by chance alone.
enum class NextEvent : bool { no, yes };

}  // namespace interflect::montecarlo
