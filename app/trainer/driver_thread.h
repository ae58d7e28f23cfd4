// A driver, or a person's feet, beside a lever that runs in real time: sees every cycle, some milliseconds late, and acts.
#pragma once

#include <functional>
#include <thread>

#include "app/training/drive_sample.h"
#include "haptics/rt/spsc_queue.h"

namespace gearshift {

class DriverThread {
 public:
  // Takes the cycles from the queue, as its only reader. The queue must outlive it. It ends after the action that it is
  // at.
  DriverThread(std::function<void(const DriveSample&)> act, SpscQueue<DriveSample>& cycles);

 private:
  std::jthread thread_;
};

}  // namespace gearshift
