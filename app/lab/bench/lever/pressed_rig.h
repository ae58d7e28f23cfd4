// A lever pressed against a wall through a device with injected faults, to test how the loop reacts.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>

#include "haptics/device/pushing_hand.h"
#include "haptics/device/simulated_lever.h"
#include "haptics/loop/haptic_loop.h"

namespace gearshift::lab {

inline constexpr std::int64_t kPeriodNs = 1'000'000;
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInf = std::numeric_limits<double>::infinity();

// A simulated lever whose readings are falsified by the function `sabotage`. Its spec is that of a real device, so the
// loop does not re-arm it automatically.
class SabotagedLever final : public haptics::HapticDevice {
 public:
  SabotagedLever(haptics::HandDriver& hand, glm::dvec2 start) : lever_({}, kPeriodNs, hand), spec_(lever_.spec()) {
    spec_.simulated = false;
    lever_.place(start);
  }
  const haptics::DeviceSpec& spec() const noexcept override { return spec_; }
  haptics::LeverReading read(std::int64_t now_ns) noexcept override {
    haptics::LeverReading reading = lever_.read(now_ns);
    if (sabotage) sabotage(reading);
    return reading;
  }
  void write(glm::dvec2 force) noexcept override {
    written = force;
    lever_.write(force);
  }
  void release() noexcept override {
    ++releases;
    lever_.release();
  }

  std::function<void(haptics::LeverReading&)> sabotage;
  glm::dvec2 written{0.0};
  int releases = 0;

 private:
  haptics::SimulatedLever lever_;
  haptics::DeviceSpec spec_;
};

// A hand presses the lever against the upper wall of the neutral aisle with 15 N.
struct PressedRig {
  explicit PressedRig(const haptics::Gate& at)
      : gate(at),
        hand([](double, glm::dvec2) {
          return glm::dvec2{0.0, 15.0};
        }),
        lever(hand, {0.5 * (gate.column[0].center + gate.column[1].center), 0.0}),
        loop(haptics::HapticConfig{}, gate, lever, load, inputs) {
    loop.arm();
    run(1500);
  }
  void run(int cycles, std::int64_t skipped = 0) {
    for (int i = 0; i < cycles; ++i) {
      now += kPeriodNs * (1 + skipped);
      loop.cycle(now, skipped);
      finite = finite && std::isfinite(lever.written.x) && std::isfinite(lever.written.y);
      strongest = std::max(strongest, glm::length(lever.written));
    }
  }
  // Runs cycles until the commanded force is zero, at most 1000. Returns the number of cycles.
  int cycles_to_zero() {
    for (int i = 1; i <= 1000; ++i) {
      run(1);
      if (lever.written == glm::dvec2{0.0, 0.0}) return i;
    }
    return 1000;
  }

  haptics::Gate gate;
  haptics::PushingHand hand;
  SabotagedLever lever;
  haptics::NoLoad load;
  haptics::LoopInputs inputs;
  haptics::HapticLoop loop;
  std::int64_t now = 0;
  bool finite = true;
  double strongest = 0.0;
};

// A fault of the device's readings.
struct Fault {
  const char* name;
  std::function<std::function<void(haptics::LeverReading&)>()> sabotage;  // creates a new SabotagedLever::sabotage
  // [cycles of 1 ms] guaranteed maximum time to zero force
  int within;
};

inline std::vector<Fault> reading_faults() {
  using Saboteur = std::function<void(haptics::LeverReading&)>;
  return {
      {"frozen",
       [] {
         return Saboteur([frozen = haptics::LeverReading{}, has = false](haptics::LeverReading& r) mutable {
           if (!has) frozen = r;
           has = true;
           r = frozen;
         });
       },
       42},
      {"with a NaN position", [] { return Saboteur([](haptics::LeverReading& r) { r.position.x = kNan; }); }, 42},
      {"with an infinite position", [] { return Saboteur([](haptics::LeverReading& r) { r.position.y = kInf; }); }, 42},
      {"with a frozen sequence number", [] { return Saboteur([](haptics::LeverReading& r) { r.sequence = 7; }); }, 42},
      {"with time running backward", [] { return Saboteur([](haptics::LeverReading& r) { r.time_ns = -r.time_ns; }); },
       42},
      {"jumps at random",
       [] {
         return Saboteur([n = 0](haptics::LeverReading& r) mutable {
           ++n;
           r.position = {n % 2 ? 0.05 : -0.05, n % 3 ? 0.04 : -0.04};
         });
       },
       42},
      {"drifts out of the workspace",
       [] { return Saboteur([far = 0.0](haptics::LeverReading& r) mutable { r.position.y += far += 0.004; }); }, 42},
      {"far outside the workspace", [] { return Saboteur([](haptics::LeverReading& r) {
                                           r.position = {0.5, 0.5};
                                         }); },
       60},
  };
}

}  // namespace gearshift::lab
