// Habits of real firmware: deviations from PID 1.0, one switch each. A comment names the firmware that has the habit and
// the source that it was read in. Signs of forces are in EmulatedStickConfig.
//
//   [adapt]    tloimu/adapt-ffb-joy 845266a, ffb-pro.c and main.c; [adapt 0.4] a85f4b8
//   [affb]     vsulako/AFFBWheel 706e188
//   [board]    Ultrawipf/OpenFFBoard 160af910 (1.17.1), HidFFB.cpp and EffectsCalculator.cpp; [board 1.16] 445ee456
//   [br]       ranenbg/Arduino-FFB-wheel 463a080
//   [fino]     jmriego/Fino b686bc6
//   [library]  YukMingLaw/ArduinoJoystickWithFFBLibrary ed86e27 (1.0.0)
//   [moza]     measured on MOZA wheel bases (one axis): JacKeTUs/universal-pidff issue 1
//   [pico]     nobonobo/pico-ffb-steering-wheel 6e08bff
//   [saitek]   zanppa/hid-pidff 37709a8, a driver tried on the Cyborg Evo Force
//   [stm]      billydragon/STM32_FFBJoystick 586a7c5
//   [sun]      sunwj/SunFFBJoystick b5a6f09
//   [vjoy]     njz3/vJoy 02a337b
//
// Not modelled, because no report of our driver reaches it: what a duration of 0 or 7FFFh means (ours are 300 ms, or all
// ones for a stick that refuses a duration); that freeing a block mutes the others until the next start [br] (blocks are
// freed only before a reset); effects that sum beyond 8 bits [library] (the wrap is in the sketch, not the library).
#pragma once

#include <cstdint>

namespace gearshift::test {

// Direction in which a constant force pushes. a0, a1: the angles in the two direction fields.
enum class ConstantLaw : std::uint8_t {
  pid,           // by a0 if the direction bit is set, otherwise by the axis bits and Cartesian components
  first_angle,   // by a0, whatever the axes byte says [adapt, fino]
  equal_to_4,    // by a0 if the axes byte is 4, otherwise X by a0 and Y by a1 [library, stm]
  x_only,        // X, whatever the direction [affb, pico]
  rotates_sum,   // each directed force rotates the sum of those before it; Y is reversed [br, two motors]
  no_bit_alone,  // by a0, but only on axes whose bit is set [JakaSimonic/ForceFeedback-core-library 0bb2cee]
};

// Which condition acts on which axis. A condition was set for one axis or for both.
enum class ConditionLaw : std::uint8_t {
  per_axis,          // PID 1.0 with axis bits; the direction bit enables both axes
  board,             // condition 0 on both axes until condition 1 can make a force; times a factor from the direction,
                     // unless both can make a force when the effect is set [board]
  counted,           // axes byte 4: condition 0 on both axes, rotated, until two reports have arrived; the 8-bit count
                     // wraps [library, stm]
  exactly_4,         // axes byte 4: per axis; otherwise condition 0 on both axes, times the direction [fino]
  x_only,            // condition 1 is not used [affb]
  along_direction,   // direction bit: condition 0 along the direction; otherwise per axis [saitek]
  times_direction,   // without the direction bit, times the components of the direction [sun]
  direction_scales,  // always times the components of the direction, sign included [moza]
  both_axes,         // a condition without a direction acts on both axes [fino, by ../facts: one-condition effects]
  last_set,          // only the axis whose condition was set last makes a force
  never,             // conditions make no force [pico]
};

enum class DeadBandLaw : std::uint8_t {
  honoured,
  ignored,        // [adapt, br, Asetek by the quirks of Linux' hid-pidff]
  raw_counts,     // centre and dead band in counts are compared with a deflection of -1 to 1 [library, fino]
  narrow,         // 0.6 times as wide as commanded
  wide,           // 1.6 times as wide
  shifts_centre,  // the centre moves to the upper end of the dead band, and there is no dead band [stm]
};

// The part of a constant force that the firmware still changes after the effect was first set.
enum class ConstantUpdate : std::uint8_t {
  all,
  strength,  // the sign stays positive; the strength is followed [adapt 0.4, if the stick obeys the parameter that is
             // written to it]
  nothing    // strength and sign stay as they were first told [adapt 0.4, if it does not]
};

enum class AutoCentre : std::uint8_t {
  none,
  after_reset,   // on at power-on and after a reset, until stop-all [adapt]
  always,        // [FFBeast: its manual]
  until_spring,  // unless a spring of the host plays [VPforce Rhino: its manual]
  while_on,      // while the actuators are on
  when_off       // while the actuators are off [board]: slope 1.77, limit 0.136
};

enum class StateSent : std::uint8_t {
  at_changes,
  never,      // [adapt, library, fino, affb, br, pico, vjoy]
  at_setting  // when an effect is created or set [board]
};

// [1] fraction of the force along one axis that also acts along the other.
struct CrossTalk {
  double constant = 0.0, spring = 0.0, damper = 0.0;
};

enum class DamperLaw : std::uint8_t {
  brakes,
  nothing,   // the highest speed that a sketch leaves at 0 gives NaN [library]
  full,      // it gives infinity, so that any motion meets the full force [library]
  is_spring  // the speed is the position over the time step [stm]
};

struct StickHabits {
  // Forces
  ConstantLaw constant = ConstantLaw::pid;
  ConditionLaw condition = ConditionLaw::per_axis;
  DeadBandLaw dead_band = DeadBandLaw::honoured;
  DamperLaw damper = DamperLaw::brakes;
  bool ignores_saturation = false;  // of conditions [br, adapt]
  AutoCentre auto_centre = AutoCentre::none;
  double centring_slope = 0.4;  // [1] of `auto_centre`: force at full deflection; limited to 0.3 of the full force
  ConstantUpdate constant_update = ConstantUpdate::all;
  // Strength in 7 bits from a product in 16 bits that overflows at half force: 128 of 255 gives 31 of 127, but 129 gives
  // 96 [adapt 0.4, CalcGain]
  bool jumps_at_half = false;
  bool drops_sign = false;  // setting an effect reverses a negative constant force until it is sent again [adapt]
  bool constant_ignores_gain = false;  // [library, fino]
  bool ignores_device_gain = false;    // [library, fino, br, pico, stm]
  CrossTalk cross_talk;                // of each family of effects
  bool only_y_pushes = false;          // X has no motor
  int motors = 2;                      // 1: Y makes no force [affb, pico, wheels on boards]

  // Effects
  bool trigger_none_is_ff = false;   // trigger button 0 is the first button, FFh is none [adapt, sun]
  bool ones_are_finite = false;      // a duration of all ones ends after 65.535 s [AccuForce, T150: Linux' hid-pidff]
  int effects_at_once = 0;           // starting one more stops that which was started first; 0: no limit [../facts]
  double restart_gap = 0.0;          // [s] silence after each start
  bool stopped_is_free = false;      // a stopped block may be given to another effect [library, fino, affb]
  bool mute_until_stop_all = false;  // after power-on and reset [fino]
  bool off_until_enabled = false;    // actuators are off after a reset, although the state says on [sun]
  bool ignores_actuators = false;  // enabling and disabling them has no effect on forces [library, fino, br, pico, stm]
  bool stop_all_erases = false;    // stop-all also frees all effects, in secret [adapt 0.4]
  bool ignores_stop_all = false;   // [br]
  bool control_tests_bits = false;  // control numbers are tested bit by bit: pause and continue free all effects [stm]

  // Answers
  int late_loads = 0;               // reads of the block load report that answer "pending" before the block [../facts]
  int short_features = 0;           // [bytes] missing at the end of feature reports [adapt]
  bool load_answers_once = false;   // a second read answers the lever's report [adapt]
  bool first_create_fails = false;  // after power-on [pico]
  // Each family of effects has its own room, and that of springs is full [adapt, of the third]; no firmware is known that
  // has dampers and never springs, which PID 1.0 allows.
  bool springs_full = false;
  bool pool_by_driver_flag = false;  // the pool report says that the driver manages the pool; not true [vjoy]
  bool pool_read_frees_all = false;  // [adapt]
  StateSent state_sent = StateSent::at_changes;
  bool says_no_safety_switch = false;  // the bit is never set [board]
  bool says_no_power = false;          // the bit is never set
  bool says_no_actuators = false;      // the bit is never set
  bool says_actuators = false;         // the bit is always set [sun, after a reset]
  int longer_input = 0;                // [bytes] lever reports are longer (or shorter) than declared
};

}  // namespace gearshift::test
