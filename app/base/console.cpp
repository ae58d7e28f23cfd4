#include "app/base/console.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>

namespace gearshift::base {
namespace {

std::atomic<bool> is_quiet{false};

// A second stream to what standard error was at the first call; never closed, because any thread may be using it.
std::FILE* own_stream() {
  static std::FILE* const stream = [] {
    const int own = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    std::FILE* const opened = own >= 0 ? fdopen(own, "w") : nullptr;
    if (opened != nullptr) std::setvbuf(opened, nullptr, _IONBF, 0);
    return opened;
  }();
  return stream;
}

}  // namespace

QuietLibraries::QuietLibraries() : saved_(-1) {
  if (own_stream() == nullptr) return;
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  saved_ = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  is_quiet = saved_ >= 0;
  if (is_quiet) dup2(nowhere, STDERR_FILENO);
  close(nowhere);
}

QuietLibraries::~QuietLibraries() {
  if (saved_ < 0) return;
  dup2(saved_, STDERR_FILENO);
  close(saved_);
  is_quiet = false;
}

std::FILE* message_output() noexcept {
  return is_quiet ? own_stream() : stderr;
}

}  // namespace gearshift::base
