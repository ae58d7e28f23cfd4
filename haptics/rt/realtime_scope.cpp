#include "haptics/rt/realtime_scope.h"

#include <sched.h>

#include <cerrno>
#include <cstring>

namespace gearshift::haptics {

std::string schedule_fifo(int priority) {
  sched_param wanted{};
  wanted.sched_priority = priority;
  if (sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &wanted) == 0) return {};
  const std::string level = std::to_string(priority);
  return "SCHED_FIFO at priority " + level + " was refused (" + std::strerror(errno) + "; allow it with 'rtprio " +
         level + "')";
}

RealtimeScope::RealtimeScope(int priority) : policy_(sched_getscheduler(0)) {
  sched_param before{};
  if (policy_ < 0 || sched_getparam(0, &before) != 0) return;
  priority_ = before.sched_priority;
  raised_ = schedule_fifo(priority).empty();
}

RealtimeScope::~RealtimeScope() {
  if (!raised_) return;
  sched_param before{};
  before.sched_priority = priority_;
  sched_setscheduler(0, policy_ | SCHED_RESET_ON_FORK,
                     &before);  // keeps the reset-on-fork flag, because clearing it needs a privilege
}

}  // namespace gearshift::haptics
