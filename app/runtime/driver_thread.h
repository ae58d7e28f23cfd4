// Runs a driver, or a person's pedals, beside a real-time lever: processes every cycle, some milliseconds late.
#pragma once

#include <functional>
#include <thread>

#include "app/vehicle/drive_sample.h"
#include "haptics/rt/spsc_queue.h"

namespace gearshift::runtime {

class DriverThread {
 public:
  // Pops the cycles from the queue as its only reader. The queue must outlive this object. The destructor waits for the
  // current action.
  DriverThread(std::function<void(const vehicle::DriveSample&)> act, haptics::SpscQueue<vehicle::DriveSample>& cycles);

 private:
  std::jthread thread_;
};

}  // namespace gearshift::runtime
