// No file may grow beyond that, as on a disk that is full.
#pragma once

#include <signal.h>
#include <sys/resource.h>

namespace gearshift {

class SmallFiles {
 public:
  explicit SmallFiles(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &was_);
    handler_ = signal(SIGXFSZ, SIG_IGN);
    const rlimit small{bytes, was_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallFiles() {
    setrlimit(RLIMIT_FSIZE, &was_);
    signal(SIGXFSZ, handler_);
  }
  SmallFiles(const SmallFiles&) = delete;
  SmallFiles& operator=(const SmallFiles&) = delete;

 private:
  rlimit was_{};
  void (*handler_)(int) = nullptr;
};

}  // namespace gearshift
