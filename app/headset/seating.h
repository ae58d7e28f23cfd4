// Who wears a headset sits down in the cabin, is moved with his room, and touches the lever: what of it is in use, and what
// is kept for tomorrow.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/headset/headset_report.h"
#include "app/headset/seat.h"
#include "app/headset/seat_file.h"
#include "engine/xr/headset_session.h"

namespace gearshift {

class Seating {
 public:
  // file: where it is kept; empty: nowhere. driver_eye: in the cabin.
  Seating(const SeatSettings& settings, std::filesystem::path file, glm::dvec3 driver_eye);

  const EyePose& cabin_from_room() const noexcept { return cabin_from_room_; }
  const SeatSettings& settings() const noexcept { return settings_; }
  void keep();  // the settings, in the file

  // A frame that is seen, the head where it is: who has not sat down yet does. keeps_room: the room is the same tomorrow.
  void sit(const EyePose& head, glm::dvec3 knob_at_rest, bool keeps_room);
  void recentre() noexcept { sits_ = false; }
  void stand_up() noexcept;  // the headset was put down: who puts it on sits down anew
  void leave() noexcept;     // it was lost: of its room nothing is known but what was kept
  void follow(const SpaceChange& change, bool keeps_room);

  bool touches() const noexcept { return touching_; }
  void touch(const EyePose& tip, glm::dvec3 knob_top);  // in the room, in the cabin
  // bound [m]: how far felt and seen lever may be apart.
  void obey(const HeadsetRequests& requests, double bound, bool keeps_room);

  double touch_error() const noexcept { return touched_ ? touch_error_ : 0.0; }  // [m] between felt and seen lever
  void report(HeadsetReport& report) const;
  std::string take_news();  // one sentence, once; empty: none

 private:
  void take_kept_touch(const EyePose& head);
  void keep_touched(double bound, bool keeps_room);
  void stop_touching() noexcept;

  SeatSettings settings_;
  std::filesystem::path file_;
  SeatPlaces places_;
  EyePose cabin_from_room_;
  bool sits_ = false;
  std::optional<EyePose> touched_;  // in use
  double touch_error_ = 0.0;        // [m] of it
  bool touching_ = false;
  EyePose before_touching_;
  LeverTouches touches_;
  LeverTouches::Fit fit_;
  std::string news_;
};

}  // namespace gearshift
