// The sources are named in stick_habits.h.
#include "tests/support/stick/stick_profiles.h"

#include <vector>

namespace gearshift::test {
namespace {

// An effect that Windows and Linux know as the block below the first that they are given.
StickProfile sidewinder_ff2_stick() {
  StickProfile profile{"SideWinder FF2", StickFamily::sidewinder, {}};
  profile.habits.auto_centre = AutoCentre::after_reset;
  return profile;
}

// Its own descriptor is not known.
StickProfile rhino_like_stick() {
  StickProfile profile{"PID 1.0, centres itself", StickFamily::sidewinder, {}};
  profile.habits.auto_centre = AutoCentre::until_spring;
  return profile;
}

StickProfile openffboard_stick(const char* name, StickFamily family) {
  StickProfile profile{name, family, {}};
  profile.habits.condition = ConditionLaw::board;
  profile.habits.auto_centre = AutoCentre::when_off;
  profile.habits.state_sent = StateSent::at_setting;
  profile.habits.says_no_safety_switch = true;
  return profile;
}

StickProfile openffboard_wheel_stick() {
  StickProfile profile = openffboard_stick("OpenFFBoard, one motor", StickFamily::openffboard);
  profile.habits.motors = 1;
  return profile;
}

// The relatives of the Arduino library share its handling of effect blocks.
StickProfile arduino_like_stick(const char* name, StickFamily family) {
  StickProfile profile{name, family, {}};
  profile.habits.ignores_device_gain = true;
  profile.habits.ignores_actuators = true;
  profile.habits.stopped_is_free = true;
  profile.habits.state_sent = StateSent::never;
  return profile;
}

StickProfile arduino_stick(const char* name, StickFamily family) {
  StickProfile profile = arduino_like_stick(name, family);
  profile.constant_sign = {-1, -1};
  profile.habits.constant = ConstantLaw::equal_to_4;
  profile.habits.condition = ConditionLaw::counted;
  profile.habits.dead_band = DeadBandLaw::raw_counts;
  profile.habits.damper = DamperLaw::nothing;
  profile.habits.constant_ignores_gain = true;
  return profile;
}

// Fino's own descriptor is not known; it differs from the library's by a start delay.
StickProfile fino_stick() {
  StickProfile profile = arduino_like_stick("Fino", StickFamily::arduino);
  profile.habits.constant = ConstantLaw::first_angle;
  profile.habits.condition = ConditionLaw::exactly_4;
  profile.habits.dead_band = DeadBandLaw::raw_counts;
  profile.habits.mute_until_stop_all = true;
  profile.habits.constant_ignores_gain = true;
  return profile;
}

StickProfile adapt_ffb_joy_stick(const char* name) {
  StickProfile profile{name, StickFamily::adapt_ffb_joy, {}};
  profile.habits.constant = ConstantLaw::first_angle;
  profile.habits.dead_band = DeadBandLaw::ignored;
  profile.habits.pool_read_frees_all = true;
  profile.habits.load_answers_once = true;
  profile.habits.short_features = 1;
  profile.habits.state_sent = StateSent::never;
  return profile;
}

StickProfile adapt_ffb_joy_0_5_stick() {
  StickProfile profile = adapt_ffb_joy_stick("adapt-ffb-joy 0.5");
  profile.habits.trigger_none_is_ff = true;
  profile.habits.drops_sign = true;
  profile.habits.auto_centre = AutoCentre::after_reset;
  return profile;
}

// The firmware writes the strength of a constant force that plays to the stick's parameter 74h, never to the magnitude at
// 68h, and its sign to 7Ch. Whether the stick obeys 74h is not known.
StickProfile adapt_ffb_joy_0_4_stick(const char* name, ConstantUpdate update) {
  StickProfile profile = adapt_ffb_joy_stick(name);
  profile.habits.constant_update = update;
  profile.habits.jumps_at_half = true;
  profile.habits.stop_all_erases = true;
  profile.habits.ignores_device_gain = true;
  profile.habits.ignores_actuators = true;
  return profile;
}

StickProfile sunffb_stick() {
  StickProfile profile{"SunFFB", StickFamily::sunffb, {}};
  profile.habits.condition = ConditionLaw::times_direction;
  profile.habits.trigger_none_is_ff = true;
  profile.habits.off_until_enabled = true;
  profile.habits.says_actuators = true;
  return profile;
}

StickProfile affbwheel_stick() {
  StickProfile profile{"AFFBWheel", StickFamily::affbwheel, {}};
  profile.habits.constant = ConstantLaw::x_only;
  profile.habits.condition = ConditionLaw::x_only;
  profile.habits.stopped_is_free = true;
  profile.habits.motors = 1;
  profile.habits.state_sent = StateSent::never;
  return profile;
}

StickProfile brwheel_stick(const char* name, int motors) {
  StickProfile profile = arduino_like_stick(name, StickFamily::brwheel);
  profile.habits.constant = ConstantLaw::rotates_sum;
  profile.habits.dead_band = DeadBandLaw::ignored;
  profile.habits.stopped_is_free = false;
  profile.habits.ignores_stop_all = true;
  profile.habits.ignores_saturation = true;
  profile.habits.motors = motors;
  return profile;
}

StickProfile stm32_stick() {
  StickProfile profile = arduino_like_stick("STM32_FFBJoystick", StickFamily::stm32);
  profile.habits.constant = ConstantLaw::equal_to_4;
  profile.habits.condition = ConditionLaw::counted;
  profile.habits.dead_band = DeadBandLaw::shifts_centre;
  profile.habits.damper = DamperLaw::is_spring;
  profile.habits.control_tests_bits = true;
  profile.habits.state_sent = StateSent::at_changes;
  return profile;
}

StickProfile saitek_stick() {
  StickProfile profile{"Cyborg Evo Force", StickFamily::saitek, {}};
  profile.habits.condition = ConditionLaw::along_direction;
  profile.habits.says_no_safety_switch = true;
  return profile;
}

StickProfile vjoy_stick() {
  StickProfile profile{"vJoy", StickFamily::vjoy, {}};
  profile.habits.pool_by_driver_flag = true;
  return profile;
}

}  // namespace

std::span<const StickProfile> stick_profiles() {
  static const std::vector<StickProfile> profiles{
      {"PID 1.0", StickFamily::sidewinder, {}},
      sidewinder_ff2_stick(),
      rhino_like_stick(),
      openffboard_stick("OpenFFBoard", StickFamily::openffboard),
      openffboard_stick("OpenFFBoard, 32-bit", StickFamily::openffboard_32bit),
      openffboard_wheel_stick(),
      arduino_stick("Arduino library", StickFamily::arduino),
      arduino_stick("Arduino library, hat", StickFamily::arduino_hat),
      fino_stick(),
      adapt_ffb_joy_0_5_stick(),
      adapt_ffb_joy_0_4_stick("adapt-ffb-joy 0.4", ConstantUpdate::strength),
      adapt_ffb_joy_0_4_stick("adapt-ffb-joy 0.4, fixed", ConstantUpdate::nothing),
      sunffb_stick(),
      affbwheel_stick(),
      brwheel_stick("Arduino-FFB-wheel, one motor", 1),
      brwheel_stick("Arduino-FFB-wheel, two motors", 2),
      stm32_stick(),
      saitek_stick(),
      vjoy_stick(),
  };
  return profiles;
}

EmulatedStickConfig config_of(const StickProfile& profile) {
  EmulatedStickConfig config;
  config.family = profile.family;
  config.habits = profile.habits;
  config.constant_sign = profile.constant_sign;
  return config;
}

}  // namespace gearshift::test
