// Differences between the families of sticks: USB descriptors and the bytes of reports. Derived by hand from the
// devices' report descriptors (tests/data/hid), so that our parser and these tables check each other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tests/support/stick/emulated_stick.h"

namespace gearshift::test {

using StickReport = std::vector<std::uint8_t>;  // the ID is the first byte

// A number in a report, little-endian.
struct StickNumber {
  std::size_t at = 0;  // [bytes] offset from the report's ID
  int bytes = 0;       // 0: the report has no such number
  bool is_signed = false;
};
std::int64_t read_number(std::span<const std::uint8_t> report, StickNumber number) noexcept;
void write_number(std::span<std::uint8_t> report, StickNumber number, std::int64_t value) noexcept;

// A number in a report, read as a fraction: divided by `max` if positive, by `-min` if negative.
struct StickFraction {
  StickNumber number;
  double max = 1.0, min = 0.0;
};
double read_fraction(std::span<const std::uint8_t> report, const StickFraction& fraction) noexcept;

struct ReportShape {
  std::uint8_t id = 0;
  std::size_t size = 0;  // [bytes] including the ID; 0: no such report
};

struct LeverBytes : ReportShape {
  StickNumber x, y;
  double low = 0.0, high = 0.0;  // [counts] range of the axes
  int bits = 16;                 // bits per axis; higher bits are padding
  std::size_t buttons_at = 0;    // button 1 is the lowest bit of this byte
  std::size_t hat_at = 0;        // byte of the hat, which reports 8 (not pressed); 0: no hat
};
struct SetEffectBytes : ReportShape {
  StickNumber duration, start_delay;  // [ms]
  StickFraction gain;
  std::size_t trigger_at = 0;
  std::size_t axes_at = 0;
  std::uint8_t x_bit = 1, y_bit = 2, direction_bit = 4;  // masks of the axes byte
  StickNumber direction_x{}, direction_y{};              // `direction_y` may be missing
  double full_turn = 0.0;                                // [counts] per full turn of a direction
  std::array<StickNumber, 2> places{};                   // of the effect's parameters, if the driver manages the pool
};
// A missing negative field has the value of the positive one, a missing saturation is 1, a missing dead band 0.
struct ConditionBytes : ReportShape {
  StickFraction centre, positive, negative, positive_saturation, negative_saturation, dead_band;
  StickNumber place;  // if the driver manages the pool
};
struct ConstantBytes : ReportShape {
  StickFraction magnitude;
  StickNumber place;  // if the driver manages the pool
};
// Bits of the state report's first byte after its ID.
struct StateBytes : ReportShape {
  int paused = 0, actuators = 1, safety_switch = 2, power = 4;
  // Without a block: `playing` is a bit of the same byte. With a block: the second byte holds it, after the playing bit,
  // unless `playing` is a bit of the first byte.
  int playing = -1;
  bool playing_is_top = false;  // the playing bit is the highest of the second byte, not the lowest
};

// Choices that PID 1.0 leaves open, and deviations from PID 1.0.
struct StickQuirks {
  int first_block = 1;  // lower blocks are built in: block 1 of the SideWinder is its centring spring
  int last_block = 40;
  int more_announced = 0;       // blocks that the pool report announces in excess
  bool driver_managed = false;  // the driver places effects and their parameters in the stick's memory
  bool control_bits = false;    // device control has one bit per command instead of a number from 1 to 6
  bool board_control = false;   // OpenFFBoard: one switch for actuators, pause and stop all; a reset turns it off, and
                                // setting an effect turns it on
};

struct StickFamilyTable {
  const char *name, *descriptor;  // `descriptor`: file name in tests/data/hid
  std::uint16_t vendor, product, usb_version, device_version;
  const char *maker, *product_name, *serial;  // serial "": none
  std::uint8_t endpoint_in, endpoint_out;     // if `endpoint_out` is 0, outputs use the control pipe
  LeverBytes lever;
  StateBytes state;  // size: 2 without the effect's block; 0: no state report
  SetEffectBytes set_effect;
  ConditionBytes condition;
  ConstantBytes constant;
  ReportShape operation, block_free, control;
  ReportShape gain;
  double gain_max = 255.0;                                 // [counts] full device gain
  std::vector<ReportShape> other_outputs;                  // accepted, but ignored
  ReportShape create, block_load, pool;                    // features
  ReportShape block_state;                                 // feature report, only on vJoy
  std::uint8_t last_type;                                  // highest effect type
  std::array<std::uint8_t, 3> types{1, 8, 9};              // constant, spring, damper
  std::array<std::uint8_t, 3> operations{1, 2, 3};         // start, start solo, stop
  std::array<std::uint8_t, 6> controls{1, 2, 3, 4, 5, 6};  // enable, disable, stop all, reset, pause, continue
  StickQuirks quirks;
};

const StickFamilyTable& stick_family(StickFamily family) noexcept;

// The family's report descriptor, from tests/data/hid. Throws std::runtime_error if the file cannot be read.
std::vector<std::uint8_t> stick_report_descriptor(StickFamily family);

}  // namespace gearshift::test
