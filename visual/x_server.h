#pragma once

#include <sys/types.h>

namespace interflect::visual {

/// A virtual X server (Xvfb) of our own: it ends with this object, and with the program however that ends.
///
/// It runs in a session of its own, so that a Ctrl-C reaches the program alone, and is told by the kernel (PDEATHSIG)
/// when the thread that started it is gone: keep the object on a thread that lives as long.
class XServer {
 public:
  /// @throws core::InputError  naming the package, if it cannot be started
  XServer();
  ~XServer();
  XServer(const XServer&) = delete;
  XServer& operator=(const XServer&) = delete;

  int number() const { return number_; }  ///< N of DISPLAY=:N
  pid_t process() const { return process_; }

 private:
  void end();

  pid_t process_ = -1;
  int number_ = -1;
};

}  // namespace interflect::visual
