#include "haptics/rt/realtime_thread.h"

#include <fcntl.h>
#include <linux/capability.h>
#include <malloc.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <future>
#include <stdexcept>
#include <utility>

#include "haptics/rt/monotonic_clock.h"
#include "haptics/rt/realtime_scope.h"

namespace gearshift::haptics {
namespace {

constexpr std::size_t kStackBytes = std::size_t{256} * 1024;  // [bytes] stack that is prefaulted before the first cycle
constexpr std::size_t kPageBytes = 4096;

void sleep_until(std::int64_t wake_ns) noexcept {
  const timespec wake{wake_ns / kSecondNs, wake_ns % kSecondNs};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, nullptr) == EINTR) continue;
}

void cpu_relax() noexcept {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

// Touches the stack pages below this frame, so that no cycle causes a page fault.
[[gnu::noinline]] void prefault_stack() noexcept {
  unsigned char stack[kStackBytes];
  volatile unsigned char* page = stack;
  for (std::size_t at = 0; at < kStackBytes; at += kPageBytes) page[at] = 1;
}

bool may_lock_any_amount() noexcept {
  rlimit limit{};
  if (getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY) return true;
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct capabilities[_LINUX_CAPABILITY_U32S_3]{};
  if (syscall(SYS_capget, &header, capabilities) != 0) return false;
  return (capabilities[0].effective & (1u << CAP_IPC_LOCK)) != 0;
}

// Locked memory stays resident after free() unless malloc returns it to the kernel. By default malloc raises its mmap
// threshold over time and keeps large blocks, such as a cabin's textures, in fragmented heaps: memory grew by 65 MB
// with each change of the gate (tests/flow/soak.sh). A fixed threshold prevents this growth.
constexpr int kMmapThreshold = 1 << 20;  // [bytes] larger blocks get their own pages, which free() returns

// lock_memory() and pin_to() return an error message, or an empty string.
std::string lock_memory() {
  mallopt(M_MMAP_THRESHOLD, kMmapThreshold);
  // With a finite memlock limit, locking may succeed now, but a later allocation would then fail. This is worse than no
  // lock.
  if (!may_lock_any_amount()) return "the memory lock was refused (allow it with 'memlock unlimited')";
  if (mlockall(MCL_CURRENT | MCL_FUTURE) == 0) return {};
  return std::string("the memory lock was refused (") + std::strerror(errno) + "; allow it with 'memlock unlimited')";
}

std::string pin_to(int core) {
  if (core < 0) return {};
  cpu_set_t set;
  CPU_ZERO(&set);
  if (core < CPU_SETSIZE) CPU_SET(static_cast<std::size_t>(core), &set);
  if (sched_setaffinity(0, sizeof set, &set) == 0) return {};
  return "core " + std::to_string(core) + " was refused (" + std::strerror(errno) + ")";
}

// Keeps all cores out of deep idle states, from which they wake late, by holding /dev/cpu_dma_latency open with a value
// of 0, as cyclictest does. Without permission the class does nothing, and wake-ups are later.
class AwakeCores {
 public:
  AwakeCores() noexcept : file_(open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC)) {
    const std::int32_t max_us = 0;
    if (file_ >= 0 && write(file_, &max_us, sizeof max_us) != sizeof max_us) release();
  }
  ~AwakeCores() { release(); }
  AwakeCores(const AwakeCores&) = delete;
  AwakeCores& operator=(const AwakeCores&) = delete;

 private:
  void release() noexcept {
    if (file_ >= 0) close(file_);
    file_ = -1;
  }
  int file_;
};

void append(std::string& sentence, const std::string& part) {
  if (part.empty()) return;
  sentence += sentence.empty() ? "not real-time, because " : ", and ";
  sentence += part;
}

// Returns the newest deadline that has passed, after a wake-up that is late by whole periods. Earlier deadlines are
// skipped.
CycleCall skip_to_newest(const CycleCall& call, std::int64_t woke, std::int64_t period) noexcept {
  const std::int64_t missed = (woke - call.deadline_ns) / period;
  return {call.deadline_ns + missed * period, call.skipped + missed, woke - call.deadline_ns};
}

// Returns the first deadline after the end of a cycle; deadlines that have passed are skipped.
CycleCall next_deadline(const CycleCall& call, std::int64_t done, std::int64_t period) noexcept {
  const std::int64_t next = call.deadline_ns + period;
  const std::int64_t missed = done > next ? (done - next + period - 1) / period : 0;
  return {next + missed * period, missed};
}

void check(const RealtimeConfig& config) {
  if (config.period_ns <= 0) throw std::invalid_argument("the period of a real-time thread must be above 0 ns");
  if (config.spin_ns < 0) throw std::invalid_argument("the spin time of a real-time thread must not be below 0 ns");
  if (config.priority < 1 || config.priority > 99)
    throw std::invalid_argument("the priority of a real-time thread must be 1 to 99");
}

}  // namespace

void RealtimeThread::start(const RealtimeConfig& config, std::function<void(const CycleCall&)> cycle) {
  if (thread_.joinable()) throw std::logic_error("the real-time thread is already running");
  check(config);
  config_ = config;
  cycle_ = std::move(cycle);
  stop_.store(false, std::memory_order_relaxed);
  statistics_ = CycleStatistics{};

  std::promise<bool> prepared;
  std::future<bool> may_start = prepared.get_future();
  thread_ = std::thread([this, ready = std::move(prepared)]() mutable {
    prepare();
    const bool may_run = not_realtime_reason_.empty() || config_.policy == RealtimePolicy::best_effort;
    ready.set_value(may_run);
    if (may_run) run();
  });
  if (may_start.get()) return;
  thread_.join();
  throw std::runtime_error(not_realtime_reason_);
}

void RealtimeThread::stop() noexcept {
  stop_.store(true, std::memory_order_relaxed);
  if (thread_.joinable()) thread_.join();
}

// Locks memory before switching to real-time scheduling, because locking may wait for the pages of the whole process.
void RealtimeThread::prepare() {
  not_realtime_reason_.clear();
  const std::string memory = lock_memory();
  const std::string scheduling = schedule_fifo(config_.priority);
  realtime_ = scheduling.empty();
  append(not_realtime_reason_, scheduling);
  append(not_realtime_reason_, memory);
  append(not_realtime_reason_, pin_to(config_.core));
  if (!scheduling.empty() || !memory.empty()) not_realtime_reason_ += "; set these limits in /etc/security/limits.conf";
  prctl(PR_SET_TIMERSLACK, 1UL);  // [ns] timer slack; the default for a normal thread is 50 us
  prefault_stack();
}

// Sleeps until spin_ns before the deadline, then spins, so that the spin absorbs the scheduler's wake-up latency.
std::int64_t RealtimeThread::wait_until(std::int64_t deadline) const noexcept {
  std::int64_t now = monotonic_ns();
  if (deadline - now > config_.spin_ns) {
    sleep_until(deadline - config_.spin_ns);
    now = monotonic_ns();
  }
  for (; now < deadline; now = monotonic_ns()) cpu_relax();
  return now;
}

void RealtimeThread::run() noexcept {
  const AwakeCores awake;
  const std::int64_t period = config_.period_ns;
  CycleCall next{monotonic_ns() + period, 0};
  while (true) {
    const std::int64_t woke = wait_until(next.deadline_ns);
    if (stop_.load(std::memory_order_relaxed)) return;
    next = skip_to_newest(next, woke, period);
    statistics_.wake_lateness.add(next.late_ns);
    statistics_.skipped += static_cast<std::uint64_t>(next.skipped);

    cycle_(next);
    const std::int64_t done = monotonic_ns();
    statistics_.duration.add(done - woke);
    ++statistics_.cycles;
    next = next_deadline(next, done, period);
    statistics_.overruns += next.skipped > 0 ? 1 : 0;
  }
}

}  // namespace gearshift::haptics
