// Encodes and decodes PID reports: pure functions of a layout, real-time safe. Fields that the device lacks are
// skipped. A report that the device lacks is encoded as an empty report (size 0).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "haptics/hid/hid_bytes.h"
#include "haptics/hid/pid_layout.h"

namespace gearshift::haptics {

inline constexpr int kNoBlock = 0;  // effect blocks count from 1

struct PidEffectSettings {
  int block = kNoBlock;
  PidEffect effect = PidEffect::constant;
  double duration = 0.3;  // [s] > 0; kForever: endless, or as long as possible
  double gain = 1.0;      // [1] 0 to 1
  // Axis on which the effect acts: 0 X, 1 Y, -1 both (for conditions). The axis is encoded in the axis enable bits and,
  // if the device has a direction field, as a direction: X 90 degrees, Y 180 degrees (PID 1.0 section 4.2: 0 degrees is
  // a force from the far side, angles increase clockwise).
  int axis = 0;
};
inline constexpr double kForever = 1e9;  // [s]

struct PidCondition {  // for one axis; fractions of full deflection (-1 to 1) or full force (0 to 1)
  double centre = 0.0;
  double dead_band = 0.0;    // half width of the zone without force
  double coefficient = 0.0;  // force per deflection; 1: the device's maximum
  double saturation = 1.0;
};

HidBytes encode_set_effect(const PidLayout& pid, const PidEffectSettings& settings) noexcept;
HidBytes encode_constant(const PidLayout& pid, int block, double magnitude) noexcept;  // -1 to 1
HidBytes encode_condition(const PidLayout& pid, int block, int axis, const PidCondition& condition) noexcept;
HidBytes encode_operation(const PidLayout& pid, int block, PidOperation operation, int loops) noexcept;
HidBytes encode_control(const PidLayout& pid, PidControl control) noexcept;
HidBytes encode_gain(const PidLayout& pid, double gain) noexcept;  // 0 to 1
HidBytes encode_block_free(const PidLayout& pid, int block) noexcept;
HidBytes encode_create(const PidLayout& pid, PidEffect effect) noexcept;

struct BlockLoad {
  enum class Status : std::uint8_t { pending, success, full, error };
  int block = kNoBlock;
  Status status = Status::pending;
};
struct PoolInfo {
  std::int64_t ram = 0, simultaneous = 0;  // 0: not reported
  bool device_managed = false;
};
struct PidStatus {
  // The initial values apply to fields that the device does not report.
  bool actuators_enabled = false, actuator_power = true, safety_switch = true, paused = false;
  bool playing = false;
  int block = kNoBlock;
};
// Empty if the report ID or length is wrong.
std::optional<BlockLoad> decode_block_load(const PidLayout& pid, std::span<const std::uint8_t> report) noexcept;
std::optional<PoolInfo> decode_pool(const PidLayout& pid, std::span<const std::uint8_t> report) noexcept;
std::optional<PidStatus> decode_state(const PidLayout& pid, std::span<const std::uint8_t> report) noexcept;

}  // namespace gearshift::haptics
