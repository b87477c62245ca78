#include "visual/display.h"

#include <X11/Xlib.h>

#include <cstdlib>

#include "core/format.h"
#include "visual/x_server.h"

namespace interflect::visual {

namespace {

/// VTK aborts the program where it cannot connect, so somebody has to try before.
bool answers(const char* display) {
  if (display == nullptr || *display == '\0') return false;
  ::Display* connection = XOpenDisplay(display);
  if (connection == nullptr) return false;
  XCloseDisplay(connection);
  return true;
}

}  // namespace

Display::Display() {
  const char* display = std::getenv("DISPLAY");
  if (answers(display)) return;
  if (display != nullptr) before_ = display;
  own_ = std::make_unique<XServer>();
  ::setenv("DISPLAY", core::format(":%d", own_->number()).c_str(), 1);
}

Display::~Display() {
  if (own_ == nullptr) return;
  if (before_)
    ::setenv("DISPLAY", before_->c_str(), 1);
  else
    ::unsetenv("DISPLAY");
}

}  // namespace interflect::visual
