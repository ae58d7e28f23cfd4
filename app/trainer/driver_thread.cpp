#include "app/trainer/driver_thread.h"

#include <chrono>
#include <stop_token>
#include <utility>

namespace gearshift {
namespace {

// For the next cycle: the haptic thread cannot wake anybody, that would be a system call.
constexpr std::chrono::microseconds kDriveEvery{250};

}  // namespace

DriverThread::DriverThread(std::function<void(const DriveSample&)> act, SpscQueue<DriveSample>& cycles)
    : thread_([act = std::move(act), &cycles](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
          DriveSample cycle;
          if (cycles.pop(cycle))
            act(cycle);
          else
            std::this_thread::sleep_for(kDriveEvery);
        }
      }) {}

}  // namespace gearshift
