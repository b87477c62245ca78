#pragma once

#include <memory>
#include <optional>
#include <string>

namespace interflect::visual {

class XServer;

/// What pictures are drawn on: the display of the environment where it answers, else a virtual one of our own (see
/// XServer).
///
/// While it exists, DISPLAY names it, because that is where VTK looks: make it when no other thread reads the
/// environment.
class Display {
 public:
  /// @throws core::InputError  if there is none and none can be made
  Display();
  ~Display();
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

  const XServer* own() const { return own_.get(); }  ///< null where the environment's display is used

 private:
  std::optional<std::string> before_;  ///< DISPLAY, as it was
  std::unique_ptr<XServer> own_;
};

}  // namespace interflect::visual
