// The calling thread at a real-time priority for a while: for work that waits for a device, not for a deadline.
#pragma once

#include <string>

namespace gearshift {

// SCHED_FIFO at that priority, 1 to 99, not handed on to threads that this one starts. Returns what was refused, or
// nothing.
std::string schedule_fifo(int priority);

// SCHED_FIFO while it stands, where that is allowed, and then as the thread was scheduled before.
class RealtimeScope {
 public:
  explicit RealtimeScope(int priority);
  ~RealtimeScope();
  RealtimeScope(const RealtimeScope&) = delete;
  RealtimeScope& operator=(const RealtimeScope&) = delete;

 private:
  int policy_ = 0, priority_ = 0;  // before
  bool raised_ = false;
};

}  // namespace gearshift
