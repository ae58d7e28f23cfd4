#include "app/cabin/headset/seat_calibration.h"

#include <utility>

#include <fmt/core.h>

#include "haptics/files/file_error.h"

namespace gearshift::cabin {
namespace {

constexpr std::size_t kMinTouches = 3;
constexpr double kMinErrorFraction = 0.15;  // [1] minimum tip_error_fraction(); 45 deg turns about two axes give 0.26
constexpr double kMaxEyeOffset = 0.6;       // [m] maximum distance of a seated driver's head from the eye point

}  // namespace

SeatCalibration::SeatCalibration(const SeatSettings& settings, std::filesystem::path file, glm::dvec3 driver_eye)
    : settings_(settings),
      file_(std::move(file)),
      places_{driver_eye, {}},
      cabin_from_room_{driver_eye, {1, 0, 0, 0}} {}

void SeatCalibration::save_settings() {
  if (file_.empty()) return;
  try {
    write_seat(settings_, file_);
  } catch (const haptics::FileError& error) {
    message_ = error.what();
  }
}

void SeatCalibration::seat_if_needed(const engine::EyePose& head, glm::dvec3 knob_at_rest, bool is_room_persistent) {
  if (is_seated_) return;
  is_seated_ = true;
  places_.knob = knob_at_rest;
  if (!touched_ && settings_.touched && is_room_persistent) restore_touch(head);
  if (touched_)
    cabin_from_room_ = *touched_;
  else if (settings_.knob)
    cabin_from_room_ = seat_at_lever(head, places_, *settings_.knob);
  else
    cabin_from_room_ = seat_at_eyes(head, places_, settings_.height);
}

// Restores the saved touch calibration. If the user set up the room again while this program was not running, the
// calibration is wrong. The program detects this only if the calibration places the head far from the driver's eye
// point.
void SeatCalibration::restore_touch(const engine::EyePose& head) {
  if (glm::distance(*settings_.touched * head.position, places_.eye) > kMaxEyeOffset) {
    message_ =
        "the saved touch points place your head far from the steering wheel. Sit down and recentre, or touch the knob "
        "again.";
    return;
  }
  touched_ = settings_.touched;
  touch_error_ = settings_.touch_error;
}

void SeatCalibration::start_touching() noexcept {
  if (touching_) return;
  touching_ = true;
  before_touching_ = cabin_from_room_;
}

void SeatCalibration::stop_touching() noexcept {
  if (touching_) cabin_from_room_ = before_touching_;
  touching_ = false;
  touches_.forget();
}

void SeatCalibration::on_headset_removed() noexcept {
  stop_touching();
  is_seated_ = false;
}

void SeatCalibration::on_headset_lost() noexcept {
  on_headset_removed();
  touched_.reset();
}

// Adapts to a change of the tracking space. If the user has recentred, seats the user again; the position still comes
// from the touch calibration if there is one. If the space's origin has moved, transforms the calibration, because the
// real lever has not moved. If the origin's new place is unknown, drops the touch calibration.
void SeatCalibration::follow(const engine::SpaceChange& change, bool is_room_persistent) {
  if (!change.is_session_space) {
    recentre();
    return;
  }
  stop_touching();
  if (!is_room_persistent && !touched_) recentre();
  if (change.new_from_old) {
    const engine::EyePose old_from_new = engine::inverse(*change.new_from_old);
    cabin_from_room_ = cabin_from_room_ * old_from_new;
    if (touched_) touched_ = cabin_from_room_;
    if (settings_.touched && is_room_persistent) {
      settings_.touched = *settings_.touched * old_from_new;
      save_settings();
    }
    return;
  }
  if (touched_ || (settings_.touched && is_room_persistent))
    message_ = "the headset's room setup has changed, so the touch points no longer apply. Touch the knob again.";
  touched_.reset();
  recentre();
  if (!settings_.touched || !is_room_persistent) return;
  settings_.touched.reset();
  save_settings();
}

void SeatCalibration::touch(const engine::EyePose& tip, glm::dvec3 knob_top) {
  touches_.add(tip, knob_top);
  fit_ = *touches_.fit(cabin_from_room_);
  cabin_from_room_ = fit_.cabin_from_room;
}

void SeatCalibration::save_touches(double bound, bool is_room_persistent) {
  if (!touching_) return;
  if (touches_.count() < kMinTouches || !fit_.turned) {
    message_ = "touch the knob in at least three positions that are far apart, then save again";
    return;
  }
  const double fraction = touches_.tip_error_fraction();
  if (fraction < kMinErrorFraction) {
    message_ =
        "turn the controller sideways by 45 degrees for one touch and tilt it by 45 degrees for another, then save "
        "again";
    return;
  }
  const double error = fit_.worst / fraction;  // [m] largest possible tip error; `worst` is only `fraction` of it
  if (error > bound) {
    message_ = fmt::format(
        "the drawn lever could be as much as {:.0f} mm away from the real one, but only {:.0f} mm is allowed. Touch "
        "the "
        "knob again.",
        1e3 * error, 1e3 * bound);
    stop_touching();
    return;
  }
  touching_ = false;
  touched_ = cabin_from_room_;
  touch_error_ = error;
  touches_.forget();
  if (!is_room_persistent) {
    message_ =
        "the touch points apply to this session only, because the headset's runtime cannot recognise the room next "
        "time";
    return;
  }
  settings_.touched = touched_;
  settings_.touch_error = touch_error_;
  save_settings();
}

void SeatCalibration::forget_touches() {
  if (touching_) {
    stop_touching();
    return;
  }
  touched_.reset();
  settings_.touched.reset();
  recentre();
  save_settings();
}

void SeatCalibration::set_height(double height) {
  if (is_seated_ && !touched_ && !settings_.knob) cabin_from_room_.position.y += height - settings_.height;
  settings_.height = height;
  save_settings();
}

void SeatCalibration::set_knob(const std::optional<KnobDistance>& knob) {
  settings_.knob = knob;
  recentre();
  save_settings();
}

void SeatCalibration::report(HeadsetReport& report) const {
  report.seat = settings_;
  report.is_touched = touched_.has_value();
  report.touch_error = touch_error();
  report.touching = touching_;
  report.touches = touches_.count();
  report.worst_touch = touches_.count() > 0 ? fit_.worst : 0.0;
}

std::string SeatCalibration::take_message() {
  return std::exchange(message_, {});
}

}  // namespace gearshift::cabin
