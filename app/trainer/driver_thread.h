// A driver beside a lever that runs in real time: sees every cycle, some milliseconds late, and acts.
#pragma once

#include <thread>

#include "app/trainer/driver_seat.h"
#include "app/trainer/trainer.h"
#include "haptics/rt/spsc_queue.h"

namespace gearshift {

class DriverThread {
 public:
  // Takes the cycles from the queue, as its only reader. Queue and seat must outlive it. It ends after the action that
  // it is at.
  DriverThread(SelfDriver driver, SpscQueue<DriveSample>& cycles, DriverSeat& seat);

 private:
  std::jthread thread_;
};

}  // namespace gearshift
