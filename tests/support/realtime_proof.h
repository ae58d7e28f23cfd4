// Proves that a piece of code allocates nothing, takes no lock and makes no system call.
//
// The code runs once, in a forked child, so that the test's own state stays as it was. There
//   allocations   are counted by standing in for malloc, free and their kin, where operator new ends, too
//   locks         by standing in for the pthread and semaphore calls where std::mutex and its kin end
//   system calls  are trapped by a seccomp filter that lets nothing through but the exit, and writes to the one
//                 descriptor that is named: a device's own
// Reading the clock through the vDSO is no system call. (Seccomp's strict mode would not do: it forbids the
// time stamp counter that the vDSO reads.)
//
// Link it only to test programs that use it: the stand-ins serve the whole program. Not built under
// sanitizers, which stand in for the same functions.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace gearshift {

struct RealtimeProof {
  bool ran = false;               // to its end, or up to its first system call
  std::uint64_t allocations = 0;  // calls of malloc, free and their kin
  std::uint64_t locks = 0;        // calls that take, try, wait for or wake
  long system_call = -1;          // number of the first one, -1 = none
  std::string problem;            // why it did not run: a crash, no seccomp on this machine

  bool clean() const { return ran && allocations == 0 && locks == 0 && system_call < 0; }
  std::string verdict() const;  // one sentence
};

// `work` must not throw. Must not be called from inside itself. written: a descriptor that it may write to; -1: none.
RealtimeProof prove_realtime(const std::function<void()>& work, int written = -1);

}  // namespace gearshift
