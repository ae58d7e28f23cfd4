// Places the headset's user in the cabin: after sitting down, after changes of the tracking space, and by touching the
// lever. Holds the calibration in use and saves it for later sessions.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/cabin/headset/headset_report.h"
#include "app/cabin/headset/seat.h"
#include "app/cabin/headset/seat_file.h"
#include "engine/xr/headset_session.h"

namespace gearshift::cabin {

class SeatCalibration {
 public:
  // `file`: where the settings are saved; if empty, they are not saved. `driver_eye`: in cabin axes.
  SeatCalibration(const SeatSettings& settings, std::filesystem::path file, glm::dvec3 driver_eye);

  const engine::EyePose& cabin_from_room() const noexcept { return cabin_from_room_; }
  const SeatSettings& settings() const noexcept { return settings_; }
  void save_settings();

  // Call for each displayed frame. If the user is not seated yet, places the head at the driver's eyes, or relative to
  // the lever if the lever's position is known. `is_room_persistent`: true if the tracking space stays the same in the
  // next session.
  void seat_if_needed(const engine::EyePose& head, glm::dvec3 knob_at_rest, bool is_room_persistent);
  void recentre() noexcept { is_seated_ = false; }
  void on_headset_removed() noexcept;  // call when the headset is taken off: the next user is seated again
  void on_headset_lost() noexcept;     // call when the connection is lost: only the saved settings remain
  void follow(const engine::SpaceChange& change, bool is_room_persistent);

  bool is_touching() const noexcept { return touching_; }
  void touch(const engine::EyePose& tip, glm::dvec3 knob_top);  // tip: pose in the room; knob_top: in the cabin
  void start_touching() noexcept;
  // Ends the touch calibration, if enough was touched. `bound` [m]: maximum allowed distance between real and drawn
  // lever.
  void save_touches(double bound, bool is_room_persistent);
  void forget_touches();           // cancels a running touch calibration, or else discards the saved one
  void set_height(double height);  // [m] SeatSettings::height
  void set_knob(const std::optional<KnobDistance>& knob);  // SeatSettings::knob

  double touch_error() const noexcept { return touched_ ? touch_error_ : 0.0; }  // [m] between real and drawn lever
  void report(HeadsetReport& report) const;
  std::string take_message();  // one sentence, returned only once; empty: no message

 private:
  void restore_touch(const engine::EyePose& head);
  void stop_touching() noexcept;

  SeatSettings settings_;
  std::filesystem::path file_;
  SeatPlaces places_;
  engine::EyePose cabin_from_room_;
  bool is_seated_ = false;
  std::optional<engine::EyePose> touched_;  // active touch calibration: pose of the room in the cabin
  double touch_error_ = 0.0;                // [m] error of touched_
  bool touching_ = false;
  engine::EyePose before_touching_;
  LeverTouches touches_;
  LeverTouches::Fit fit_;
  std::string message_;
};

}  // namespace gearshift::cabin
