// Emulates /dev/uinput below the C library: a preloaded library that lets a program open it and writes what the program
// does with it to the file $UINPUT_LOG, one line each: "ioctl REQUEST ARGUMENT", "setup NAME", "abs CODE MIN MAX",
// "event SECONDS TYPE CODE VALUE". While the file $UINPUT_LOG.errno exists, opening fails with the number in it. Where
// there is a kernel with uinput, tests/guest tests the same.
#include <dlfcn.h>
#include <fcntl.h>
#include <linux/uinput.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>

namespace {

int device = -1;  // the descriptor of the emulated device

template <typename Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

std::FILE* log_file() {
  static std::FILE* const file = std::fopen(std::getenv("UINPUT_LOG"), "a");
  return file;
}

int open_device() {
  if (std::FILE* error = std::fopen((std::string(std::getenv("UINPUT_LOG")) + ".errno").c_str(), "r")) {
    if (std::fscanf(error, "%d", &errno) != 1) errno = EIO;
    std::fclose(error);
    return -1;
  }
  return device = next<int (*)(const char*, int, ...)>("open")("/dev/null", O_WRONLY | O_CLOEXEC);
}

int open_any(const char* name, const char* path, int flags, mode_t mode) {
  if (std::strcmp(path, "/dev/uinput") == 0 && std::getenv("UINPUT_LOG") != nullptr) return open_device();
  return next<int (*)(const char*, int, mode_t)>(name)(path, flags, mode);
}

mode_t mode_of(int flags, va_list arguments) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : 0;
}

int log_request(unsigned long request, void* argument) {
  if (request == UI_DEV_SETUP) {
    const auto& setup = *static_cast<const uinput_setup*>(argument);
    std::fprintf(log_file(), "setup %u %s\n", setup.id.bustype, setup.name);
  } else if (request == UI_ABS_SETUP) {
    const auto& setup = *static_cast<const uinput_abs_setup*>(argument);
    std::fprintf(log_file(), "abs %u %d %d\n", setup.code, setup.absinfo.minimum, setup.absinfo.maximum);
  } else {
    const char* name = request == UI_SET_EVBIT     ? "UI_SET_EVBIT"
                       : request == UI_SET_KEYBIT  ? "UI_SET_KEYBIT"
                       : request == UI_DEV_CREATE  ? "UI_DEV_CREATE"
                       : request == UI_DEV_DESTROY ? "UI_DEV_DESTROY"
                                                   : nullptr;
    if (name == nullptr) return errno = EINVAL, -1;
    const bool sets_bit = request == UI_SET_EVBIT || request == UI_SET_KEYBIT;  // the others have no argument
    std::fprintf(log_file(), "ioctl %s %ld\n", name, sets_bit ? reinterpret_cast<long>(argument) : 0);
  }
  std::fflush(log_file());
  return 0;
}

}  // namespace

extern "C" int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_of(flags, arguments);
  va_end(arguments);
  return open_any("open", path, flags, mode);
}

extern "C" int open64(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_of(flags, arguments);
  va_end(arguments);
  return open_any("open64", path, flags, mode);
}

extern "C" int ioctl(int file, unsigned long request, ...) noexcept {
  va_list arguments;
  va_start(arguments, request);
  void* const argument = va_arg(arguments, void*);
  va_end(arguments);
  if (file == device && device >= 0) return log_request(request, argument);
  return next<int (*)(int, unsigned long, void*)>("ioctl")(file, request, argument);
}

extern "C" ssize_t write(int file, const void* bytes, size_t count) {
  if (file != device || device < 0) return next<ssize_t (*)(int, const void*, size_t)>("write")(file, bytes, count);
  if (count != sizeof(input_event)) return errno = EINVAL, -1;
  const auto& event = *static_cast<const input_event*>(bytes);
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  std::fprintf(log_file(), "event %.6f %u %u %d\n",
               static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec), event.type, event.code,
               event.value);
  std::fflush(log_file());
  return static_cast<ssize_t>(count);
}
