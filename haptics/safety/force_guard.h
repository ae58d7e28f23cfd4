// The final check of every force. Steps, in order: finiteness check, passivity control (if enabled), slew limit, energy
// bounding (if enabled), clamp, ramp. The guard also runs this state machine:
//
//   idle -> armed -> ramping -> running      only at the user's request; a simulated lever arms itself
//   damped    stale reading, too many overruns in a row, or chatter that continues although the wall was softened: the
//             force fades out and only damping remains
//   released  limit exceeded, stop or device lost, force not finite, or a real device without commands for 0.1 s:
//             motors off
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/vec2.hpp>

#include "haptics/device/haptic_device.h"
#include "haptics/files/parameter.h"
#include "haptics/safety/energy_control.h"

namespace gearshift::haptics {

enum class GuardState : std::uint8_t { idle, armed, ramping, running, damped, released };
const char* to_string(GuardState state) noexcept;
const char* describe(GuardState state) noexcept;  // text for the user, such as "forces on"

enum class GuardFault : std::uint8_t { none, stale_reading, overruns, not_finite, limit_broken, stopped, chatter };
const char* to_string(GuardFault fault) noexcept;

// At a slew limit of 1 N the wall force rises so slowly that an arm moves by 80 mm.
inline constexpr double kMinSlew = 2.0;  // [N/cycle]

// True if a lever in the state `damped` may re-arm itself after this fault: a simulated lever that did not chatter. After
// every other fault, and on every real device, only the user arms the lever.
constexpr bool rearms_itself(const DeviceSpec& spec, GuardFault fault) noexcept {
  return spec.simulated && fault != GuardFault::chatter;
}

struct GuardConfig {
  double slew = 25.0;             // [N/cycle] largest change per axis; an impact needs 16 at 1 kHz
  double ramp_time = 0.5;         // [s] from armed to full force
  double stale_time = 0.020;      // [s] time without a fresh reading before state damped
  double fade_time = 0.020;       // [s] time in which the force fades out in state damped
  int overruns_in_row = 8;        // [cycles] consecutive overruns before state damped
  double damped_damping = 5.0;    // [N s/m] applied in state damped while readings are fresh
  double position_margin = 0.02;  // [m] a position further outside the workspace is a fault
  bool operator==(const GuardConfig&) const = default;
};

template <>
inline constexpr Parameter<GuardConfig> kParameters<GuardConfig>[] = {
    {&GuardConfig::slew, "slew", "slew_n_per_cycle", FileRange{kMinSlew, 100.0},
     "Largest change of the force on an axis from one cycle to the next.", "Slew limit", "walls are soft on impact",
     "the lever kicks", Display{"N/cycle", 1}},
    {&GuardConfig::ramp_time, "ramp_time", "ramp_time_s", FileRange{0.001, 60.0}, "Time from arming to the full force.",
     "Ramp to full force", "a jolt on arming", "forces start late", Display{"s", 3, 1.0, true}},
    {&GuardConfig::stale_time, "stale_time", "stale_time_s", FileRange{0.001, 1.0},
     "Time without a new reading before the forces fade out.", "Stale after", "forces end on a busy machine",
     "a dead sensor pushes longer", Display{"ms", 0, 1e3, true}},
    {&GuardConfig::fade_time, "fade_time", "fade_time_s", FileRange{0.001, 1.0},
     "Time in which the forces fade out after a fault.", "Fade-out", "a jolt when forces end", "they last longer",
     Display{"ms", 0, 1e3, true}},
    {&GuardConfig::overruns_in_row, "overruns_in_row", "overruns_in_row", FileRange{1.0, 1000.0},
     "Late cycles in a row before the forces fade out.", "Overruns in a row", "forces end on a busy machine",
     "a late loop pushes longer", Display{"cycles", 0, 1.0, true}},
    {&GuardConfig::damped_damping, "damped_damping", "damped_damping_n_s_per_m", FileRange{0.0, 50.0},
     "Damping that remains after the forces faded out.", "Fallback damping", "the damped lever swings",
     "it feels viscous", Display{"N s/m", 1}},
    {&GuardConfig::position_margin, "position_margin", "position_margin_m", FileRange{0.0, 1.0},
     "The motors go off if the lever is this far outside its workspace.", "Travel margin",
     "motors go off at the end of travel", "the lever runs away further", Display{"mm", 0, 1e3}},
};
static_assert(DescribesAll<GuardConfig>);

struct GuardInput {
  glm::dvec2 force{0.0};     // [N] wanted
  glm::dvec2 beside{0.0};    // [N] wanted of the device's own springs, which the same motors render
  glm::dvec2 position{0.0};  // [m] newest accepted
  glm::dvec2 velocity{0.0};  // [m/s] smoothed
  bool fresh = false;        // this cycle's reading is fresh
  bool in_contact = false;   // the lever is pressed into a wall
  std::int64_t skipped = 0;  // [cycles] deadlines missed before this cycle
};

struct GuardOutput {
  glm::dvec2 force{0.0};   // [N] commanded
  bool saturated = false;  // the wanted force, alone or with the device's springs, exceeded the maximum on an axis
  double ramp = 0.0;       // [1] 0 to 1, fraction of the force that is output; 0 in states without force
};

class ForceGuard {
 public:
  // period [s]
  ForceGuard(const GuardConfig& config, const DeviceSpec& spec, double period,
             EnergyControl energy_control = EnergyControl::none) noexcept;

  GuardOutput guard(const GuardInput& in) noexcept;  // call once per cycle. Real-time safe

  // State changes; call on the haptic thread between cycles.
  bool arm() noexcept;            // idle, damped or released -> armed; returns false in all other states
  void reject_arming() noexcept;  // keeps the state and reports the fault `stopped`
  void disarm() noexcept;         // any -> idle, force 0
  void stop() noexcept;           // armed, ramping, running or damped -> released: the panic button
  void damp() noexcept;           // armed, ramping or running -> damped: softening the wall did not end the chatter

  GuardState state() const noexcept { return state_; }
  GuardFault fault() const noexcept { return fault_; }  // reason for the last fault state or rejected arming

 private:
  void enter_fault(GuardState state, GuardFault fault) noexcept;
  void check_faults(const GuardInput& in) noexcept;
  glm::dvec2 damped_force(const GuardInput& in) noexcept;
  GuardOutput compute_output(const GuardInput& in, glm::dvec2 travel) noexcept;
  glm::dvec2 apply_passivity_control(const GuardInput& in, glm::dvec2 travel) noexcept;
  glm::dvec2 apply_energy_bounding(glm::dvec2 force, glm::dvec2 travel) const noexcept;
  double advance_ramp() noexcept;

  GuardConfig config_;
  glm::dvec2 max_force_;
  glm::dvec2 position_limit_;
  double period_;
  EnergyControl energy_control_;
  std::array<EnergyBounder, 2> bounder_;                 // per axis
  std::array<PassivityController, 2> controller_;        // per axis
  glm::dvec2 position_{0.0};                             // [m] position in the previous cycle
  std::array<glm::dvec2, kMaxLoopDelay + 1> applied_{};  // [N] ring buffer of the last commands
  std::size_t newest_ = 0;                               // index of the newest command
  std::size_t delay_;
  GuardState state_ = GuardState::idle;
  GuardFault fault_ = GuardFault::none;
  glm::dvec2 last_force_{0.0};     // [N] last command, before the ramp factor
  double ramp_ = 0.0;              // [1] 0 to 1
  glm::dvec2 fade_from_{0.0};      // [N] command when the state damped was entered
  double fade_ = 0.0;              // [1] remaining fraction of fade_from_, 1 to 0
  std::int64_t stale_limit_;       // [cycles] longest time without a fresh reading
  std::int64_t late_limit_;        // [cycles] limit for late_cycles_
  std::int64_t stale_cycles_ = 0;  // [cycles] time since the last fresh reading
  std::int64_t late_cycles_ = 0;   // [cycles] skipped in the current run of overruns
  int overruns_ = 0;               // consecutive
};

}  // namespace gearshift::haptics
