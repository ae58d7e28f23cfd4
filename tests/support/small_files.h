// Limits the size of files during its lifetime: writing beyond the limit fails, as on a full disk.
#pragma once

#include <signal.h>
#include <sys/resource.h>

namespace gearshift::test {

class SmallFiles {
 public:
  explicit SmallFiles(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &old_limit_);
    handler_ = signal(SIGXFSZ, SIG_IGN);
    const rlimit small{bytes, old_limit_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallFiles() {
    setrlimit(RLIMIT_FSIZE, &old_limit_);
    signal(SIGXFSZ, handler_);
  }
  SmallFiles(const SmallFiles&) = delete;
  SmallFiles& operator=(const SmallFiles&) = delete;

 private:
  rlimit old_limit_{};
  void (*handler_)(int) = nullptr;
};

}  // namespace gearshift::test
