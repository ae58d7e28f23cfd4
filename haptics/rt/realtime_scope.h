// Temporarily gives the calling thread a real-time priority, for work that waits for a device rather than a deadline.
#pragma once

#include <string>

namespace gearshift::haptics {

// Sets SCHED_FIFO with priority 1 to 99; threads that this thread starts do not inherit it. Returns an error message,
// or an empty string.
std::string schedule_fifo(int priority);

// SCHED_FIFO while the object lives, if permitted; the destructor restores the previous scheduling.
class RealtimeScope {
 public:
  explicit RealtimeScope(int priority);
  ~RealtimeScope();
  RealtimeScope(const RealtimeScope&) = delete;
  RealtimeScope& operator=(const RealtimeScope&) = delete;

 private:
  int policy_ = 0, priority_ = 0;  // previous scheduling
  bool raised_ = false;
};

}  // namespace gearshift::haptics
