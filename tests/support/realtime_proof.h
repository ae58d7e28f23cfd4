// Proves that a piece of code does not allocate, lock or make system calls.
//
// The code runs once in a forked child, so that the state of the test does not change. In the child
//   allocations   are counted by overriding malloc, free and related functions, which operator new uses, too
//   locks         are counted by overriding the pthread and semaphore functions that std::mutex and others use
//   system calls  are trapped by a seccomp filter that allows only exit, and writes to one given descriptor, such as
//                 a device's
// Reading the clock through the vDSO is not a system call. (Seccomp's strict mode does not work here: it forbids the
// time stamp counter that the vDSO reads.)
//
// Link this library only to test programs that use it, because the overrides affect the whole program. It is not built
// with sanitizers, which override the same functions.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace gearshift::test {

struct RealtimeProof {
  bool ran = false;               // the work ran, completely or up to its first system call
  std::uint64_t allocations = 0;  // calls of malloc, free and related functions
  std::uint64_t locks = 0;        // calls that lock, try to lock, wait, or wake a waiter
  long system_call = -1;          // number of the first system call; -1: none
  std::string problem;            // why the work did not run: a crash, or no seccomp on this machine

  bool clean() const { return ran && allocations == 0 && locks == 0 && system_call < 0; }
  std::string verdict() const;  // one sentence
};

// `work` must not throw. Not reentrant. `writable_fd`: a descriptor that `work` may write to; -1: none.
RealtimeProof prove_realtime(const std::function<void()>& work, int writable_fd = -1);

}  // namespace gearshift::test
