// Detects driving errors in samples and shift records. Each mistake is reported once, as soon as it is known.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "app/lessons/assessment/clutch_release.h"
#include "app/lessons/assessment/driving_error.h"
#include "app/lessons/assessment/episode.h"
#include "app/lessons/assessment/recent_peak.h"
#include "app/lessons/assessment/shift_record.h"
#include "app/vehicle/car_spec.h"
#include "app/vehicle/drive_sample.h"
#include "haptics/gate/gate.h"

namespace gearshift::lessons {

struct ShiftBand {
  double from = 0.0, to = 1e9;  // [rad/s] engine speed band for upshifts
};

// Highest engine speed that the lower gear of a downshift may require [rad/s]. If the lesson has an upshift band, this
// is the band's upper end, because above it a driver would shift up again. Otherwise it is 1.2 times the upper end of
// the car's band. In the hatchback this is 3000 rpm, the most that unhurried drivers use (UDRIVE study: 2000 to 2500
// rpm advised, 1400 to 3000 rpm driven).
double max_downshift_speed(const vehicle::CarSpec& car, const ShiftBand& band) noexcept;

// Reports the cause of a mistake, but not the errors that follow from this cause. error_detector.cpp states which
// errors are left out.
class ErrorDetector {
 public:
  // `reading` [s]: time to read the prompts during a shift. It is added to the time allowed for a shift.
  ErrorDetector(const vehicle::CarSpec& car, const haptics::Gate& gate, ShiftBand band = {}, double reading = 0.0);

  // Call every cycle, in order. `wanted_gear`: gear that the lesson asks for now; kNeutralGear for none. `shifting`:
  // result of ShiftMeter::is_open(). `at`: road speed [m/s] at which `wanted_gear` should be engaged; 0 for any speed.
  void add(const vehicle::DriveSample& sample, int wanted_gear, bool shifting, double at = 0.0);

  // Judges a shift. Call after add(), with the record that ShiftMeter returned for the same sample.
  void check_shift(const ShiftRecord& record);

  // Call at the end of the drive: reports errors that are still in progress.
  void finish();

  // Returns the errors found since the last call.
  std::vector<DrivingError> drain_errors();

 private:
  enum class Measure { length, peak, sum };
  struct WatchedEpisode {
    ErrorKind kind;
    Measure measure;  // property of the episode that becomes the error's value
    Episode episode;
  };

  // Time during a shift in which the car rolled faster than kMinDrivingSpeed.
  struct RollingTime {
    double all = 0.0;  // [s]
    // [s] Value of `all` when the old gear was left (`left`), and when a gear was last engaged (`in`).
    double left = 0.0, in = 0.0;
    bool is_braked_to_stop = false;    // the car was braked below kMinDrivingSpeed with the clutch down
    bool is_engine_not_ready = false;  // engine off or just started, so engine speed is not judged
    double relevant_time() const noexcept { return is_braked_to_stop ? in - left : all; }
  };

  void watch_engine(const vehicle::DriveSample& now, double dt);
  void watch_feet(const vehicle::DriveSample& now, double dt);
  void watch_hand(const vehicle::DriveSample& now, bool shifting, double dt);
  void watch_dogs(const vehicle::DriveSample& now, double dt);
  void watch_direction(const vehicle::DriveSample& now);
  void watch_gear(const vehicle::DriveSample& now, int wanted_gear, double at);
  void judge_speed(const vehicle::DriveSample& now, double at);
  bool is_moving_off_again(int gear, int wanted_gear) const noexcept;
  void watch_drive(const vehicle::DriveSample& now, double dt);
  bool is_stopping(const vehicle::DriveSample& now) const noexcept;
  void follow_shift(const vehicle::DriveSample& now, bool shifting, double dt) noexcept;
  void update_rolling_time(const vehicle::DriveSample& now, bool moves, double dt) noexcept;
  void watch_rollback(const vehicle::DriveSample& now);
  void report_rollback(double time);
  void update_episode(WatchedEpisode& watched, bool on, double value, double time, double dt);
  void report_episode(const WatchedEpisode& watched);
  void report_coasting();
  void judge_order(const ShiftRecord& record, std::size_t errors_before);
  void judge_engine(const ShiftRecord& record);
  void judge_time(const ShiftRecord& record, const RollingTime& rolled);
  const RollingTime& rolling_time_in(const ShiftRecord& record) const noexcept;
  void judge_revs(const ShiftRecord& record);
  void judge_gear(const ShiftRecord& record);
  bool judge_clutch(const ShiftRecord& record);
  double flare_needed(const ShiftRecord& record) const noexcept;
  int missed_gear(const ShiftRecord& record) const noexcept;
  // Reports an error if `value` reaches the threshold of `kind`. Returns true if an error was reported.
  bool report_if(ErrorKind kind, double time, double value, std::int64_t shift = -1);
  int gear_reached_for(const vehicle::DriveSample& now) const noexcept;

  vehicle::CarSpec car_;
  haptics::Gate gate_;
  ShiftBand band_;
  double reading_;
  ClutchRelease release_;
  RecentPeak engine_;
  WatchedEpisode over_rev_, lugging_, riding_clutch_, riding_lever_, over_push_, grind_, block_, coasting_;
  vehicle::DriveSample last_;
  bool first_ = true;
  bool has_run_ = false;         // the engine has run without the starter since it was last off
  bool has_stalled_ = false;     // the engine stalled and has not run in a requested gear since
  double runs_since_ = -1e9;     // [s]
  bool shift_moved_ = false;     // the gear has changed during the current shift
  double shift_moved_at_ = 0.0;  // [s]
  bool shifting_ = false;
  double shift_began_ = 0.0;                 // [s]
  double slow_from_ = 0.0, slow_to_ = -1.0;  // [s] begin and end of the last shift reported as too slow
  double coasted_at_ = -1.0;                 // [s] begin of the last coasting that was reported as an error
  std::vector<DrivingError> coasted_;        // coasting errors held back until the current shift is judged
  // Rolling times in the current or most recent shift (`rolling_`), and in the shift before that (`rolling_before_`).
  RollingTime rolling_, rolling_before_;
  bool wrong_way_ = false;                   // wrong_direction already reported for this visit to the slot
  int last_gear_ = haptics::kNeutralGear;    // last gear that was engaged
  int driven_gear_ = haptics::kNeutralGear;  // last gear that was engaged with the clutch locked
  std::vector<int> tried_;       // gears that the lever was pushed towards since the last shift record, newest last
  std::vector<int> engaged_;     // gears that were engaged since the last shift record
  bool reported_speed_ = false;  // a wrong road speed was already reported for the current shift
  double demanded_speed_ = 0.0;  // [rad/s] engine speed that the last engaged gear required when engaged
  int wanted_gear_ = haptics::kNeutralGear;
  bool touching_ = false;
  // [rad/s] Largest difference between engine speed and gear speed when the lever began to touch the ring or dogs with
  // the clutch up.
  double touch_error_ = 0.0;
  double highest_ = 0.0;  // [m] value of `distance` when the car last stood or rolled forward
  std::vector<DrivingError> errors_;
};

}  // namespace gearshift::lessons
