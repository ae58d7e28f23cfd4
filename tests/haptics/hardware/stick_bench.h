// An emulated stick with its driver, on a virtual clock.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "haptics/hardware/device_calibration.h"
#include "haptics/hardware/pid_driver.h"
#include "haptics/hid/hid_error.h"
#include "tests/support/stick/stick_port.h"

namespace gearshift::test {

inline constexpr StickFamily kStickFamilies[] = {StickFamily::sidewinder, StickFamily::openffboard, StickFamily::vjoy};

inline std::string name_of(StickFamily family) {
  return to_string(family);
}

class StickBench {
 public:
  explicit StickBench(const EmulatedStickConfig& config, haptics::HandDriver& hand)
      : stick(config, hand), port(stick, mutex, plugged), driver(stick.report_descriptor()) {}

  void prepare() {
    stick.advance(now_ns);
    ability = driver.prepare(port);
    stream = driver.stream_config(period_ns);
    stick.log.clear();
  }

  // Runs one period, 1 ms by default.
  void tick() {
    now_ns += period_ns;
    tick_stick(stick, stream, driver, now_ns);
  }
  void tick(const haptics::StickCommand& command) {
    driver.state();
    driver.command(command);
    tick();
  }
  void tick_for(double seconds, const haptics::StickCommand& command) {
    for (const std::int64_t end = now_ns + static_cast<std::int64_t>(1e9 * seconds); now_ns < end;) tick(command);
  }
  double time() const { return 1e-9 * static_cast<double>(now_ns); }

  std::vector<std::string> lines() const {
    std::vector<std::string> all;
    for (const StickMessage& message : stick.log) all.push_back(message_line(message));
    return all;
  }
  std::vector<std::string> problems() {
    std::vector<std::string> all;
    while (const auto problem = driver.take_problem()) all.push_back(*problem);
    return all;
  }

  std::int64_t now_ns = 0, period_ns = 1'000'000;
  std::mutex mutex;
  std::atomic<bool> plugged{true};
  EmulatedStick stick;
  StickPort port;
  haptics::PidDriver driver;
  haptics::PidAbility ability;
  haptics::StreamConfig stream;
};

inline haptics::StickCommand pushing(double x, double y) {
  haptics::StickCommand command;
  command.enabled = true;
  command.constant = {x, y};
  return command;
}

}  // namespace gearshift::test
