// Which reports of a device are those of the Physical Interface Device page, and where their fields lie. Derived from its
// descriptor, never assumed.
//
// This work is based on:
// USB Implementers' Forum. Device Class Definition for Physical Interface Devices (PID), version 1.0. 1999
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "haptics/hid/lever_report.h"
#include "haptics/hid/report_descriptor.h"

namespace gearshift {

enum class PidEffect : std::uint8_t {
  constant,
  ramp,
  square,
  sine,
  triangle,
  saw_up,
  saw_down,
  spring,
  damper,
  inertia,
  friction
};
inline constexpr std::size_t kPidEffects = 11;
const char* pid_effect_name(PidEffect effect) noexcept;

enum class PidControl : std::uint8_t { enable_actuators, disable_actuators, stop_all, reset, pause, resume };
inline constexpr std::size_t kPidControls = 6;

enum class PidOperation : std::uint8_t { start, start_solo, stop };
inline constexpr std::size_t kPidOperations = 3;

// A report by which something is told. size 0: the device has none.
struct PidReport {
  std::uint8_t id = 0;
  std::size_t size = 0;  // [bytes] ID included
  bool exists() const noexcept { return size > 0; }
};

// A choice among named things: one field that holds its number, or one bit each.
template <std::size_t N>
struct PidChoice {
  BitField field;                        // holds the number; nothing where they are bits
  std::array<std::int64_t, N> number{};  // of each that the device knows
  std::array<BitField, N> bit{};         // of each, where they are bits
  std::array<bool, N> known{};
  bool knows(std::size_t which) const noexcept { return known[which]; }
};

struct PidSetEffect : PidReport {
  BitField block, duration, trigger_repeat, sample_period, gain, trigger_button, direction_enable, start_delay;
  PidChoice<kPidEffects> type;
  std::array<BitField, 2> axis_enable;  // X, Y
  std::array<BitField, 2> direction;    // 8 or 16 bits. In a plane the first alone is used: an angle; the second is 0
  double duration_unit = 1e-3;          // [s] a count, of the field's unit
  double full_turn = 0.0;               // [counts] of a direction that are 360 degrees
};
struct PidSetConstant : PidReport {
  BitField block, magnitude;
};
struct PidSetCondition : PidReport {
  BitField block, parameter_block, centre, positive_coefficient, negative_coefficient, positive_saturation,
      negative_saturation, dead_band;
};
struct PidOperate : PidReport {
  BitField block, loops;
  PidChoice<kPidOperations> operation;
};
struct PidDeviceControl : PidReport {
  PidChoice<kPidControls> control;
};
struct PidGain : PidReport {
  BitField gain;
};
struct PidBlockFree : PidReport {
  BitField block;
};
struct PidCreate : PidReport {  // feature
  PidChoice<kPidEffects> type;
  BitField byte_count;
};
struct PidBlockLoad : PidReport {  // feature
  BitField block, ram_available;
  PidChoice<3> status;  // success, full, error
};
struct PidPool : PidReport {  // feature
  BitField ram_size, simultaneous, device_managed, shared_parameters;
};
struct PidState : PidReport {  // input
  BitField block, playing, actuators_enabled, safety_switch, actuator_power, override_switch, paused;
};

// What may be missing of a stick that still pushes: everything but set_effect, set_constant, operate.
struct PidLayout {
  PidSetEffect set_effect;
  PidSetConstant set_constant;
  PidSetCondition set_condition;
  PidOperate operate;
  PidDeviceControl device_control;
  PidGain gain;
  PidBlockFree block_free;
  PidCreate create;
  PidBlockLoad block_load;
  PidPool pool;
  PidState state;

  bool makes(PidEffect effect) const noexcept {
    return create.type.knows(static_cast<std::size_t>(effect)) ||
           set_effect.type.knows(static_cast<std::size_t>(effect));
  }
};

// Nothing: no PID device, or one that uses the page for rumble alone.
std::optional<PidLayout> find_pid(const ReportDescriptor& descriptor);

}  // namespace gearshift
