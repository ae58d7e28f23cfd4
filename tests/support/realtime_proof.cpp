#include "tests/support/realtime_proof.h"

#include <dlfcn.h>
#include <errno.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <stddef.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <new>

namespace gearshift::test {

std::string RealtimeProof::verdict() const {
  if (!ran) return "did not run: " + problem;
  if (clean()) return "clean";
  std::string first_call = system_call < 0 ? "no system call" : "system call " + std::to_string(system_call);
  return std::to_string(allocations) + " allocations or frees, " + std::to_string(locks) + " locks, " + first_call;
}

}  // namespace gearshift::test

namespace {

// Result of the child process, in memory shared with the parent process.
struct Report {
  bool filtered = false;
  bool finished = false;
  long system_call = -1;
  std::uint64_t allocations = 0;
  std::uint64_t locks = 0;
};

// Set only in the proof's child process, on the thread that runs the work.
constinit thread_local Report* active_report = nullptr;

void count_allocation() noexcept {
  if (active_report != nullptr) ++active_report->allocations;
}
void count_lock() noexcept {
  if (active_report != nullptr) ++active_report->locks;
}

// Finds the C library's function that an override replaces. Condition variables have an old and a new version of some
// functions; GLIBC_2.3.2 is the new one.
template <class F>
F next(const char* name) noexcept {
  void* found = dlvsym(RTLD_NEXT, name, "GLIBC_2.3.2");
  if (found == nullptr) found = dlsym(RTLD_NEXT, name);
  return reinterpret_cast<F>(found);
}

}  // namespace

extern "C" {

// The C library's internal names of malloc and related functions.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
void* __libc_malloc(size_t) noexcept;
void* __libc_calloc(size_t, size_t) noexcept;
void* __libc_realloc(void*, size_t) noexcept;
void* __libc_memalign(size_t, size_t) noexcept;
void __libc_free(void*) noexcept;
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

void* malloc(size_t size) noexcept {
  count_allocation();
  return __libc_malloc(size);
}
void* calloc(size_t count, size_t size) noexcept {
  count_allocation();
  return __libc_calloc(count, size);
}
void* realloc(void* old, size_t size) noexcept {
  count_allocation();
  return __libc_realloc(old, size);
}
void* memalign(size_t alignment, size_t size) noexcept {
  count_allocation();
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(size_t alignment, size_t size) noexcept {
  return memalign(alignment, size);
}
int posix_memalign(void** out, size_t alignment, size_t size) noexcept {
  *out = memalign(alignment, size);
  return *out == nullptr ? ENOMEM : 0;
}
void free(void* old) noexcept {
  count_allocation();
  __libc_free(old);
}

// Defines an override that counts the call and then forwards it. The macro's arguments are parameter lists and
// specifiers, which must not be put in parentheses.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define GEARSHIFT_COUNT_LOCK(name, parameters, arguments, specifier) \
  int name parameters specifier {                                    \
    static const auto real = next<int(*) parameters>(#name);         \
    count_lock();                                                    \
    return real arguments;                                           \
  }

GEARSHIFT_COUNT_LOCK(pthread_mutex_lock, (pthread_mutex_t * m), (m), noexcept)
GEARSHIFT_COUNT_LOCK(pthread_mutex_trylock, (pthread_mutex_t * m), (m), noexcept)
GEARSHIFT_COUNT_LOCK(pthread_mutex_timedlock, (pthread_mutex_t * m, const timespec* t), (m, t), noexcept)
GEARSHIFT_COUNT_LOCK(pthread_rwlock_rdlock, (pthread_rwlock_t * l), (l), noexcept)
GEARSHIFT_COUNT_LOCK(pthread_rwlock_wrlock, (pthread_rwlock_t * l), (l), noexcept)
GEARSHIFT_COUNT_LOCK(pthread_rwlock_tryrdlock, (pthread_rwlock_t * l), (l), noexcept)
GEARSHIFT_COUNT_LOCK(pthread_rwlock_trywrlock, (pthread_rwlock_t * l), (l), noexcept)
GEARSHIFT_COUNT_LOCK(pthread_spin_lock, (pthread_spinlock_t * l), (l), noexcept)
GEARSHIFT_COUNT_LOCK(pthread_cond_wait, (pthread_cond_t * c, pthread_mutex_t* m), (c, m), )
GEARSHIFT_COUNT_LOCK(pthread_cond_signal, (pthread_cond_t * c), (c), noexcept)
GEARSHIFT_COUNT_LOCK(pthread_cond_broadcast, (pthread_cond_t * c), (c), noexcept)
GEARSHIFT_COUNT_LOCK(sem_wait, (sem_t * s), (s), )
GEARSHIFT_COUNT_LOCK(sem_trywait, (sem_t * s), (s), noexcept)
GEARSHIFT_COUNT_LOCK(sem_post, (sem_t * s), (s), noexcept)

#undef GEARSHIFT_COUNT_LOCK
// NOLINTEND(bugprone-macro-parentheses)
}

namespace gearshift::test {
namespace {

void note_system_call(int, siginfo_t* info, void*) {
  if (active_report != nullptr) active_report->system_call = info->si_syscall;
  syscall(SYS_exit, 0);
}

// After this call, every system call of this thread raises SIGSYS, except exit and write() to the given descriptor.
bool forbid_system_calls(int writable_fd) {
  const auto descriptor =
      static_cast<std::uint32_t>(writable_fd);  // -1: only a write to -1 is allowed, which fails harmlessly
  sock_filter rules[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_exit, 4, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_write, 0, 2),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, args[0])),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, descriptor, 1, 0),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  const sock_fprog program{sizeof rules / sizeof rules[0], rules};
  struct sigaction action {};
  action.sa_sigaction = note_system_call;
  action.sa_flags = SA_SIGINFO;
  if (sigaction(SIGSYS, &action, nullptr) != 0) return false;
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return false;
  return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

[[noreturn]] void run_child(Report* report, const std::function<void()>& work, int writable_fd) {
  // A test framework's crash handlers would make system calls, and the proof would report these instead of the crash.
  for (const int crash : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGTRAP}) signal(crash, SIG_DFL);
  active_report = report;
  report->filtered = forbid_system_calls(writable_fd);
  if (report->filtered) work();
  report->finished = report->filtered;
  while (true) syscall(SYS_exit, 0);
}

RealtimeProof judge(const Report& report, int status) {
  RealtimeProof proof;
  if (!report.filtered)
    proof.problem = "this machine has no seccomp filter";
  else if (WIFSIGNALED(status))
    proof.problem = std::string("it crashed: ") + strsignal(WTERMSIG(status));
  proof.ran = proof.problem.empty() && (report.finished || report.system_call >= 0);
  proof.allocations = report.allocations;
  proof.locks = report.locks;
  proof.system_call = report.system_call;
  return proof;
}

}  // namespace

RealtimeProof prove_realtime(const std::function<void()>& work, int writable_fd) {
  void* page = mmap(nullptr, sizeof(Report), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  RealtimeProof proof;
  proof.problem = "no memory or no process for it";
  if (page == MAP_FAILED) return proof;
  Report* report = new (page) Report;
  const pid_t child = fork();
  if (child == 0) run_child(report, work, writable_fd);
  int status = 0;
  if (child > 0 && waitpid(child, &status, 0) == child) proof = judge(*report, status);
  munmap(page, sizeof(Report));
  return proof;
}

}  // namespace gearshift::test
