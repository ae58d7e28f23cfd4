// A thread that runs a DriverFunction or a PedalSource while the lever runs in real time. It processes every cycle, up
// to some milliseconds late.
#pragma once

#include <functional>
#include <thread>

#include "app/vehicle/drive_sample.h"
#include "haptics/rt/spsc_queue.h"

namespace gearshift::runtime {

class DriverThread {
 public:
  // Calls `act` for each cycle from the queue. No other thread may read from the queue, which must outlive this object.
  // The destructor waits until the current call of `act` returns.
  DriverThread(std::function<void(const vehicle::DriveSample&)> act, haptics::SpscQueue<vehicle::DriveSample>& cycles);

 private:
  std::jthread thread_;
};

}  // namespace gearshift::runtime
