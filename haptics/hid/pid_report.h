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

// How Set Effect names the axis. Firmware differs in what it understands, so the calibration finds out.
enum class AxisStyle : std::uint8_t {
  direction,  // direction enable bit alone, as Windows sends it
  both,       // direction enable bit and axis bits
  bits        // axis bits alone
};
const char* file_key(AxisStyle style) noexcept;
constexpr AxisStyle last_value(AxisStyle) {
  return AxisStyle::bits;
}

struct PidEffectSettings {
  int block = kNoBlock;
  PidEffect effect = PidEffect::constant;
  double duration = 0.3;  // [s] > 0; kForever: endless, or as long as possible
  double gain = 1.0;      // [1] 0 to 1
  // Axis on which the effect acts: 0 X, 1 Y, -1 both (for conditions). As a direction, X is 90 degrees and Y 180 degrees
  // (PID 1.0 section 4.2: 0 degrees is a force from the far side, angles increase clockwise); both axes have 90 degrees.
  // A device without a direction gets axis bits.
  int axis = 0;
  bool is_reversed = false;  // half a turn is added to the direction
  AxisStyle style = AxisStyle::direction;
  std::array<int, 2> place{-1, -1};  // of the effect's parameters, if the driver manages the pool; -1: none
};
inline constexpr double kForever = 1e9;  // [s]

struct PidCondition {  // for one axis; fractions of full deflection (-1 to 1) or full force (0 to 1)
  double centre = 0.0;
  double dead_band = 0.0;    // half width of the zone without force
  double coefficient = 0.0;  // force per deflection; 1: the device's maximum
  double saturation = 1.0;
};

HidBytes encode_set_effect(const PidLayout& pid, const PidEffectSettings& settings) noexcept;
// `block` is the effect's block, or the place of the parameters if the driver manages the pool.
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
struct PidStatus {
  // The initial values apply to fields that the device does not report.
  bool actuators_enabled = false, actuator_power = true, safety_switch = true, paused = false;
  bool playing = false;
  int block = kNoBlock;
};
// Empty if the report ID is wrong or the report ends before its last needed field. Longer reports are accepted, as in
// Linux.
std::optional<BlockLoad> decode_block_load(const PidLayout& pid, std::span<const std::uint8_t> report) noexcept;
std::optional<PidStatus> decode_state(const PidLayout& pid, std::span<const std::uint8_t> report) noexcept;

}  // namespace gearshift::haptics
