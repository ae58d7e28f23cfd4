// Injects system faults into a program: a preloaded library that overrides functions of the C library, OpenAL and
// Vulkan. Files in the folder $INJECTED_FAULTS select the faults: `clock` contains the error of the wall clock [s];
// `write` contains the errno with which every write to a file fails; while `sound` exists, there is no sound card;
// `gpu` contains 1 to lose the GPU device once, or a larger number to lose it at every submission. Each loss appends a
// byte to the file `gpu_lost` in that folder.
#include <AL/alc.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/uio.h>
#include <unistd.h>
#include <vulkan/vulkan.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

namespace {

template <typename Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

std::string path_of(const char* fault) {
  const char* folder = std::getenv("INJECTED_FAULTS");
  return folder != nullptr ? std::string(folder) + "/" + fault : std::string();
}

bool is_injected(const char* fault) {
  return access(path_of(fault).c_str(), F_OK) == 0;
}

// Returns the number in the fault's file, 0 if there is no such file.
long read_fault(const char* fault) {
  const int file = open(path_of(fault).c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  char text[32] = {};
  const ssize_t count = read(file, text, sizeof text - 1);
  close(file);
  return count > 0 ? std::strtol(text, nullptr, 10) : 0;
}

void count_loss() {
  const int file = open(path_of("gpu_lost").c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  if (file < 0) return;
  (void)!next<ssize_t (*)(int, const void*, size_t)>("write")(file, "x", 1);
  close(file);
}

bool fails_write(int file) {
  struct stat status {};
  if (fstat(file, &status) != 0 || !S_ISREG(status.st_mode) || file <= STDERR_FILENO) return false;
  const long error = read_fault("write");
  if (error != 0) errno = static_cast<int>(error);
  return error != 0;
}

}  // namespace

extern "C" {

int clock_gettime(clockid_t clock, timespec* now) noexcept {
  static const auto real = next<int (*)(clockid_t, timespec*)>("clock_gettime");
  const int result = real(clock, now);
  if (clock == CLOCK_REALTIME) now->tv_sec += read_fault("clock");
  return result;
}

time_t time(time_t* seconds) noexcept {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  if (seconds != nullptr) *seconds = now.tv_sec;
  return now.tv_sec;
}

int gettimeofday(timeval* now, void* zone) noexcept {
  static const auto real = next<int (*)(timeval*, void*)>("gettimeofday");
  const int result = real(now, zone);
  now->tv_sec += read_fault("clock");
  return result;
}

ssize_t write(int file, const void* bytes, size_t count) {
  static const auto real = next<ssize_t (*)(int, const void*, size_t)>("write");
  return fails_write(file) ? -1 : real(file, bytes, count);
}

ssize_t writev(int file, const iovec* parts, int count) {
  static const auto real = next<ssize_t (*)(int, const iovec*, int)>("writev");
  return fails_write(file) ? -1 : real(file, parts, count);
}

ssize_t pwrite64(int file, const void* bytes, size_t count, off64_t offset) {
  static const auto real = next<ssize_t (*)(int, const void*, size_t, off64_t)>("pwrite64");
  return fails_write(file) ? -1 : real(file, bytes, count, offset);
}

// The C library's fwrite() does not call the write() defined above, so it needs its own override.
size_t fwrite(const void* bytes, size_t size, size_t count, FILE* file) {
  static const auto real = next<size_t (*)(const void*, size_t, size_t, FILE*)>("fwrite");
  return fails_write(fileno(file)) ? 0 : real(bytes, size, count, file);
}

ALCdevice* alcOpenDevice(const ALCchar* name) {
  static const auto real = next<ALCdevice* (*)(const ALCchar*)>("alcOpenDevice");
  return is_injected("sound") ? nullptr : real(name);
}

void alcGetIntegerv(ALCdevice* device, ALCenum parameter, ALCsizei count, ALCint* values) {
  constexpr ALCenum kConnected = 0x313;  // ALC_EXT_disconnect
  static const auto real = next<void (*)(ALCdevice*, ALCenum, ALCsizei, ALCint*)>("alcGetIntegerv");
  real(device, parameter, count, values);
  if (parameter == kConnected && is_injected("sound")) *values = 0;
}

VkResult vkQueueSubmit2(VkQueue queue, uint32_t count, const VkSubmitInfo2* submits, VkFence fence) {
  static const auto real = next<PFN_vkQueueSubmit2>("vkQueueSubmit2");
  const long losses = read_fault("gpu");
  if (losses == 0) return real(queue, count, submits, fence);
  count_loss();
  if (losses == 1) unlink(path_of("gpu").c_str());
  return VK_ERROR_DEVICE_LOST;
}

}  // extern "C"
