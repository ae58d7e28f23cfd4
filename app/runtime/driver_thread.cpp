#include "app/runtime/driver_thread.h"

#include <chrono>
#include <stop_token>
#include <utility>

namespace gearshift::runtime {
namespace {

// Polling interval for the next cycle: waking a thread would be a system call, which the haptic thread must not make.
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
