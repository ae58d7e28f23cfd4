#include "app/headset/seating.h"

#include <utility>

#include <fmt/core.h>

#include "haptics/files/file_error.h"

namespace gearshift {
namespace {

constexpr std::size_t kLeastTouches = 3;
constexpr double kLeastShare = 0.15;  // [1] of a tip's error must be seen: 45 degrees about two axes show 0.26
constexpr double kFarOff = 0.6;       // [m] from the driver's eyes: nobody who sits there has his head

}  // namespace

Seating::Seating(const SeatSettings& settings, std::filesystem::path file, glm::dvec3 driver_eye)
    : settings_(settings),
      file_(std::move(file)),
      places_{driver_eye, {}},
      cabin_from_room_{driver_eye, {1, 0, 0, 0}} {}

void Seating::keep() {
  if (file_.empty()) return;
  try {
    write_seat(settings_, file_);
  } catch (const FileError& error) {
    news_ = error.what();
  }
}

void Seating::sit(const EyePose& head, glm::dvec3 knob_at_rest, bool keeps_room) {
  if (sits_) return;
  sits_ = true;
  places_.knob = knob_at_rest;
  if (!touched_ && settings_.touched && keeps_room) take_kept_touch(head);
  if (touched_)
    cabin_from_room_ = *touched_;
  else if (settings_.knob)
    cabin_from_room_ = seat_at_lever(head, places_, *settings_.knob);
  else
    cabin_from_room_ = seat_at_eyes(head, places_, settings_.height);
}

// A room that was set up anew while we did not run tells nothing of it: the lever is somewhere else in it.
void Seating::take_kept_touch(const EyePose& head) {
  if (glm::distance(*settings_.touched * head.position, places_.eye) > kFarOff) {
    news_ =
        "by the lever that was touched your head is far from the wheel: sit down and recentre, or touch the knob again";
    return;
  }
  touched_ = settings_.touched;
  touch_error_ = settings_.touch_error;
}

void Seating::stop_touching() noexcept {
  if (touching_) cabin_from_room_ = before_touching_;
  touching_ = false;
  touches_.forget();
}

void Seating::stand_up() noexcept {
  stop_touching();
  sits_ = false;
}

void Seating::leave() noexcept {
  stand_up();
  touched_.reset();
}

// What stands in the room stays where it is in it when its origin moves; a person who recentres wants to sit, which a lever
// that was touched does not let him.
void Seating::follow(const SpaceChange& change, bool keeps_room) {
  if (!change.ours) {
    recentre();
    return;
  }
  stop_touching();
  if (!keeps_room && !touched_) recentre();
  if (change.new_from_old) {
    const EyePose old_from_new = inverse(*change.new_from_old);
    cabin_from_room_ = cabin_from_room_ * old_from_new;
    if (touched_) touched_ = cabin_from_room_;
    if (settings_.touched && keeps_room) {
      settings_.touched = *settings_.touched * old_from_new;
      keep();
    }
    return;
  }
  if (touched_ || (settings_.touched && keeps_room)) news_ = "the room was set up anew: touch the knob again";
  touched_.reset();
  recentre();
  if (!settings_.touched || !keeps_room) return;
  settings_.touched.reset();
  keep();
}

void Seating::touch(const EyePose& tip, glm::dvec3 knob_top) {
  touches_.add(tip, knob_top);
  fit_ = *touches_.fit(cabin_from_room_);
  cabin_from_room_ = fit_.cabin_from_room;
}

void Seating::keep_touched(double bound, bool keeps_room) {
  if (touches_.count() < kLeastTouches || !fit_.turned) {
    news_ = "touch the knob in three gears or more that lie apart";
    return;
  }
  const double share = touches_.tip_share();
  if (share < kLeastShare) {
    news_ = "turn the controller to the side at one touch and tilt it at another, by 45 degrees: touch on";
    return;
  }
  const double error = fit_.worst / share;  // [m] of the tip, of which no more than that share may be seen
  if (error > bound) {
    news_ = fmt::format("the lever may be up to {:.0f} mm from where it is seen, and {:.0f} are allowed: touch again",
                        1e3 * error, 1e3 * bound);
    stop_touching();
    return;
  }
  touching_ = false;
  touched_ = cabin_from_room_;
  touch_error_ = error;
  touches_.forget();
  if (!keeps_room) {
    news_ = "the lever is seen where it was touched, for today: the runtime does not know the room tomorrow";
    return;
  }
  settings_.touched = touched_;
  settings_.touch_error = touch_error_;
  keep();
}

void Seating::obey(const HeadsetRequests& requests, double bound, bool keeps_room) {
  if (requests.touch && !touching_) {
    touching_ = true;
    before_touching_ = cabin_from_room_;
  }
  if (requests.touched && touching_) keep_touched(bound, keeps_room);
  if (requests.forget_touches && touching_) {
    stop_touching();
  } else if (requests.forget_touches) {
    touched_.reset();
    settings_.touched.reset();
    recentre();
    keep();
  }
  if (requests.height) {
    if (sits_ && !touched_ && !settings_.knob) cabin_from_room_.position.y += *requests.height - settings_.height;
    settings_.height = *requests.height;
    keep();
  }
  if (requests.knob || requests.forget_knob) {
    settings_.knob = requests.knob;
    recentre();
    keep();
  }
  if (requests.recentre) recentre();
}

void Seating::report(HeadsetReport& report) const {
  report.seat = settings_;
  report.is_touched = touched_.has_value();
  report.touch_error = touch_error();
  report.touching = touching_;
  report.touches = touches_.count();
  report.worst_touch = touches_.count() > 0 ? fit_.worst : 0.0;
}

std::string Seating::take_news() {
  return std::exchange(news_, {});
}

}  // namespace gearshift
