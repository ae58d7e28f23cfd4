// A thread that calls a function for each cycle of a lever that runs in real time, some milliseconds late: the scripted
// driver's thread, and the recorder's.
#pragma once

#include <chrono>
#include <functional>
#include <thread>

#include "app/runtime/cycle_runner.h"

namespace gearshift::runtime {

class StreamThread {
 public:
  enum class AtEnd {
    stop,   // the destructor waits only for the current call
    finish  // the destructor returns after all cycles that have been published
  };

  // Begins with the next cycle. Polls at the interval `every`, because the haptic thread cannot wake this thread: that
  // would take a system call, which the haptic thread must not make. The stream must outlive this object.
  StreamThread(const CycleStream& stream, std::chrono::microseconds every, AtEnd at_end,
               std::function<void(const CycleRecord&)> use);

 private:
  std::jthread thread_;
};

}  // namespace gearshift::runtime
