// Limits the size of files, as on a full disk.
#pragma once

#include <signal.h>
#include <sys/resource.h>

namespace gearshift::test {

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

}  // namespace gearshift::test
