#include "visual/x_server.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <fstream>
#include <optional>
#include <string>
#include <thread>

#include "core/error.h"
#include "core/format.h"

namespace interflect::visual {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto patience = std::chrono::seconds(60);  // on a busy machine
constexpr int number_descriptor = 3;                 // where the server writes its number

/// In the child, between fork and exec: only what is safe there, nothing that allocates.
[[noreturn]] void become_server(int number_pipe, pid_t parent) {
  for (int signal : {SIGTERM, SIGINT, SIGHUP, SIGPIPE, SIGUSR1}) ::signal(signal, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::setsid();
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(127);  // it ended before we asked to be told
  const int nothing = ::open("/dev/null", O_RDWR);
  for (int standard : {0, 1, 2}) ::dup2(nothing, standard);
  if (::dup2(number_pipe, number_descriptor) != number_descriptor) ::_exit(127);
  if (number_pipe == number_descriptor) ::fcntl(number_descriptor, F_SETFD, 0);
  ::close_range(number_descriptor + 1, ~0U, 0);
  ::execlp("Xvfb", "Xvfb", "-displayfd", "3", "-screen", "0", "1280x1024x24", "-nolisten", "tcp", "-noreset", nullptr);
  ::_exit(127);
}

/// "7\n" from the pipe; nothing if the server ended or took too long.
std::optional<int> read_number(int pipe) {
  const auto end = Clock::now() + patience;
  std::string text;
  while (text.find('\n') == std::string::npos) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd waiting{pipe, POLLIN, 0};
    const int ready = left > 0 ? ::poll(&waiting, 1, static_cast<int>(left)) : 0;
    if (ready < 0 && errno == EINTR) continue;
    char c = 0;
    if (ready <= 0 || ::read(pipe, &c, 1) != 1) return {};
    text += c;
  }
  return std::atoi(text.c_str());
}

/// What a killed server could not remove itself, unless another one has taken its number: then the lock names that one.
void tidy_up_after(pid_t server, int number) {
  const std::string lock = core::format("/tmp/.X%d-lock", number);
  pid_t owner = 0;
  if (!(std::ifstream(lock) >> owner) || owner != server) return;
  ::unlink(core::format("/tmp/.X11-unix/X%d", number).c_str());
  ::unlink(lock.c_str());
}

}  // namespace

XServer::XServer() {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw core::InputError("pictures", "no pipe to a virtual display");
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) become_server(ends[1], parent);
  ::close(ends[1]);
  const std::optional<int> number = process_ > 0 ? read_number(ends[0]) : std::nullopt;
  ::close(ends[0]);
  if (!number) {
    end();
    throw core::InputError("pictures",
                           "no display: set DISPLAY, or install a virtual one (Debian: apt-get install xvfb)");
  }
  number_ = *number;
}

XServer::~XServer() { end(); }

void XServer::end() {
  if (process_ <= 0) return;
  ::kill(process_, SIGTERM);
  bool killed = false;
  for (const auto start = Clock::now(); ::waitpid(process_, nullptr, WNOHANG) == 0;
       std::this_thread::sleep_for(std::chrono::milliseconds(5)))
    if (!killed && Clock::now() - start > std::chrono::seconds(10)) {
      ::kill(process_, SIGKILL);
      killed = true;
    }
  if (killed && number_ >= 0) tidy_up_after(process_, number_);
  process_ = -1;
}

}  // namespace interflect::visual
