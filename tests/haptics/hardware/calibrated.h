// The calibration that a perfect measurement of an emulated stick would give.
#pragma once

#include "haptics/hardware/device_calibration.h"
#include "tests/support/stick/emulated_stick.h"

namespace gearshift::test {

// Forward means away from the user; a stick's counts decrease in this direction. A positive constant force pushes left
// and forward (PID 1.0 section 4.2), unless the stick's polarity is inverted.
inline haptics::DeviceCalibration calibration_of(const EmulatedStickConfig& stick) {
  struct Range {
    double low, high;
  };
  const Range range = stick.family == StickFamily::sidewinder    ? Range{-512.0, 511.0}
                      : stick.family == StickFamily::openffboard ? Range{-32767.0, 32767.0}
                                                                 : Range{0.0, 32767.0};
  const double centre = 0.5 * (range.low + range.high), travel = 2.0 * stick.half_travel;
  haptics::DeviceCalibration known;
  known.select = {0x30,
                  range.low,
                  centre,
                  range.high,
                  travel,
                  stick.full_force,
                  -stick.constant_sign.x,
                  stick.spring_sign.x,
                  stick.spring_stiffness,
                  stick.lever.axis_x,
                  stick.damper_sign.x,
                  stick.full_force,  // at 1 m/s
                  1.0};
  known.shift = {0x31,
                 range.high,
                 centre,
                 range.low,
                 travel,
                 stick.full_force,
                 stick.constant_sign.y,
                 stick.spring_sign.y,
                 stick.spring_stiffness,
                 stick.lever.axis_y,
                 stick.damper_sign.y,
                 stick.full_force,
                 1.0};
  for (haptics::LeverAxisCalibration* axis : {&known.select, &known.shift}) {
    axis->constant_limit = 1.0;
    axis->constant_cross_talk = axis->spring_cross_talk = axis->damper_cross_talk = 0.0;
  }
  known.effects_at_once = 4;
  known.timing = {stick.input_interval, 0.001, stick.delay, 0.0};
  known.buttons.press = 1;
  known.buttons.lift = 2;
  known.buttons.stop = 3;
  return known;
}

}  // namespace gearshift::test
