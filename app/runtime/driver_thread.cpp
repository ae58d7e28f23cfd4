#include "app/runtime/driver_thread.h"

#include <chrono>
#include <stop_token>
#include <utility>

namespace gearshift::runtime {
namespace {

// Interval at which the thread polls for the next cycle. The haptic thread cannot wake this thread, because that would
// take a system call, and the haptic thread must not make one.
constexpr std::chrono::microseconds kDriveEvery{250};

}  // namespace

DriverThread::DriverThread(std::function<void(const vehicle::DriveSample&)> act,
                           haptics::SpscQueue<vehicle::DriveSample>& cycles)
    : thread_([act = std::move(act), &cycles](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
          vehicle::DriveSample cycle;
          if (cycles.pop(cycle))
            act(cycle);
          else
            std::this_thread::sleep_for(kDriveEvery);
        }
      }) {}

}  // namespace gearshift::runtime
