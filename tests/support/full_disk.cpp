#include "tests/support/full_disk.h"

#include <dlfcn.h>
#include <sys/types.h>

#include <cerrno>
#include <cstddef>

bool gearshift::test::disk_is_full = false;

extern "C" ssize_t pwrite64(int file, const void* bytes, std::size_t count, off64_t offset) {
  if (gearshift::test::disk_is_full) {
    errno = ENOSPC;
    return -1;
  }
  using Write = ssize_t (*)(int, const void*, std::size_t, off64_t);
  static const auto real = reinterpret_cast<Write>(dlsym(RTLD_NEXT, "pwrite64"));
  return real(file, bytes, count, offset);
}
