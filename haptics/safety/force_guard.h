// The last word on every force: finite, passivity control where it is asked for, slew, energy bounding where it is, clamp,
// ramp; and the state ladder.
//
//   idle -> armed -> ramping -> running      up: by a person only, or by itself on a simulated lever
//   damped    reading stale, too many overruns in a row, or a chatter that softening the wall did not calm: the force
//             dies away, damping alone is left
//   released  a limit broken, device lost, force not finite, or a real device left alone for 0.1 s in a row: motors off
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/vec2.hpp>

#include "haptics/device/haptic_device.h"
#include "haptics/safety/energy_control.h"

namespace gearshift {

enum class GuardState : std::uint8_t { idle, armed, ramping, running, damped, released };
const char* guard_state_name(GuardState state) noexcept;

enum class GuardFault : std::uint8_t { none, stale_reading, overruns, not_finite, limit_broken, stopped, chatter };
const char* guard_fault_name(GuardFault fault) noexcept;

struct GuardConfig {
  double slew = 25.0;             // [N/cycle] 2 to 100, largest change per axis; an impact needs 16 at 1 kHz
  double ramp_time = 0.5;         // [s] 0.001 to 60, from armed to full force
  double stale_time = 0.020;      // [s] 0.001 to 1, without a fresh reading before damped
  double fade_time = 0.020;       // [s] 0.001 to 1, in which the force dies away after that
  int overruns_in_row = 8;        // [cycles] 1 to 1000, before damped
  double damped_damping = 5.0;    // [N s/m] 0 to 50, in the state damped, while readings are fresh
  double position_margin = 0.02;  // [m] 0 to 1, beyond the device's workspace counts as a broken limit
};

struct GuardInput {
  glm::dvec2 force{0.0};     // [N] wanted
  glm::dvec2 position{0.0};  // [m] trusted
  glm::dvec2 velocity{0.0};  // [m/s] smoothed
  bool fresh = false;        // reading fresh this cycle
  bool touches = false;      // the lever is pressed into a wall
  std::int64_t skipped = 0;  // [cycles] that had no turn before this one, which came late
};

struct GuardOutput {
  glm::dvec2 force{0.0};   // [N] commanded
  bool saturated = false;  // the wanted force was beyond the device on some axis
  double share = 0.0;      // [1] 0 to 1, of the force that is let through: the ramp; 0 in every state without force
};

class ForceGuard {
 public:
  // period [s]
  ForceGuard(const GuardConfig& config, const DeviceSpec& spec, double period,
             EnergyControl energy_control = EnergyControl::none) noexcept;

  GuardOutput guard(const GuardInput& in) noexcept;  // once per cycle. Real-time safe

  // Steps of the ladder, on the haptic thread between cycles.
  bool arm() noexcept;     // idle, damped or released -> armed (then ramping as soon as readings are fresh); else false
  void refuse() noexcept;  // to be armed: stopped, still
  void disarm() noexcept;  // any -> idle, force 0
  void stop() noexcept;    // armed or higher -> released: the large red button
  void damp() noexcept;    // armed or higher -> damped: the lever chatters whatever the wall does

  GuardState state() const noexcept { return state_; }
  GuardFault fault() const noexcept { return fault_; }  // why it last went down, or was not armed

 private:
  void fall(GuardState state, GuardFault fault) noexcept;
  void watch(const GuardInput& in) noexcept;
  glm::dvec2 damped_force(const GuardInput& in) noexcept;
  GuardOutput allowed(const GuardInput& in, glm::dvec2 travel) noexcept;
  glm::dvec2 controlled(const GuardInput& in, glm::dvec2 travel) noexcept;
  glm::dvec2 bounded(glm::dvec2 force, glm::dvec2 travel) const noexcept;
  double ramp_gain() noexcept;

  GuardConfig config_;
  glm::dvec2 max_force_;
  glm::dvec2 position_limit_;
  double period_;
  EnergyControl energy_control_;
  std::array<EnergyBounder, 2> bounder_;              // per axis
  std::array<PassivityController, 2> controller_;     // per axis
  glm::dvec2 position_{0.0};                          // [m] in the cycle before
  std::array<glm::dvec2, kMostDelay + 1> applied_{};  // [N] the last commands, as they went out
  std::size_t newest_ = 0;                            // of them
  std::size_t delay_;
  GuardState state_ = GuardState::idle;
  GuardFault fault_ = GuardFault::none;
  glm::dvec2 last_{0.0};       // [N] commanded before the ramp
  double ramp_ = 0.0;          // [1] 0 to 1
  glm::dvec2 fade_from_{0.0};  // [N] commanded when it fell to damped
  double fade_ = 0.0;          // [1] 1 to 0 of that
  std::int64_t stale_limit_;   // [cycles] without a fresh reading
  std::int64_t late_limit_;    // [cycles] skipped in a row
  std::int64_t stale_ = 0;     // [cycles] since the last fresh reading
  std::int64_t late_ = 0;      // [cycles] skipped by the overruns in a row
  int overruns_ = 0;           // in a row
};

}  // namespace gearshift
