#include "apps/display_or_warning.h"

#include <string>

#include "core/error.h"
#include "core/log.h"

namespace interflect::apps {

std::unique_ptr<visual::Display> display_or_warning() {
  try {
    return std::make_unique<visual::Display>();
  } catch (const core::InputError& error) {
    core::log::warning(std::string("no pictures: ") + error.what());
    return nullptr;
  }
}

}  // namespace interflect::apps
