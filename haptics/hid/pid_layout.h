// Finds the reports of the Physical Interface Device (PID) usage page and the positions of their fields. Everything is
// derived from the report descriptor; nothing is assumed.
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

namespace gearshift::haptics {

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
const char* to_string(PidEffect effect) noexcept;

enum class PidControl : std::uint8_t { enable_actuators, disable_actuators, stop_all, reset, pause, resume };
inline constexpr std::size_t kPidControls = 6;

enum class PidOperation : std::uint8_t { start, start_solo, stop };
inline constexpr std::size_t kPidOperations = 3;

struct PidReport {
  std::uint8_t id = 0;
  std::size_t size = 0;  // [bytes] ID included; 0: no such report
  bool exists() const noexcept { return size > 0; }
};

// A choice among N options: either one field that holds the option's number, or one bit per option.
template <std::size_t N>
struct PidChoice {
  BitField field;                        // holds the option's number; empty if there is one bit per option
  std::array<std::int64_t, N> number{};  // number of each supported option
  std::array<BitField, N> bit{};         // bit of each option, if there is one bit per option
  std::array<bool, N> supported{};
  bool supports(std::size_t which) const noexcept { return supported[which]; }
};

struct PidSetEffect : PidReport {
  BitField block, duration, trigger_repeat, sample_period, gain, trigger_button, direction_enable, start_delay;
  PidChoice<kPidEffects> type;
  std::array<BitField, 2> axis_enable;  // X, Y
  std::array<BitField, 2> direction;    // 8 or 16 bits; both hold the angle
  std::array<BitField, 2> place;        // places of the effect's parameters, if the driver manages the pool
  double duration_unit = 1e-3;          // [s] per count
  double full_turn = 0.0;               // [counts] of direction per 360 degrees
};
struct PidSetConstant : PidReport {
  BitField block, place, magnitude;
};
struct PidSetCondition : PidReport {
  BitField block, parameter_block;  // without a block, `parameter_block` is the place in the pool
  BitField centre, positive_coefficient, negative_coefficient, positive_saturation, negative_saturation, dead_band;
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

// Forces need only set_effect, set_constant and operate; all other reports are optional.
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

  // The driver, not the device, places effects and their parameters in the device's memory (PID 1.0 section 5.11.1).
  bool is_pool_ours() const noexcept { return set_constant.place.exists(); }
  bool has_effect(PidEffect effect) const noexcept {
    return create.type.supports(static_cast<std::size_t>(effect)) ||
           set_effect.type.supports(static_cast<std::size_t>(effect));
  }
};

// Empty if the device is not a PID device, or uses the PID page only for rumble.
std::optional<PidLayout> find_pid(const ReportDescriptor& descriptor);

}  // namespace gearshift::haptics
