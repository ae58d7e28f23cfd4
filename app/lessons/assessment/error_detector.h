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
  double from = 0.0, to = 1e9;  // [rad/s] engine speeds for upshifts
};

// Highest engine speed for which a downshift is appropriate [rad/s]: the upper end of the lesson's band, if it has one,
// because above this a driver would shift up again; else 1.2 times the upper end of the car's band. In the hatchback
// that is 3000 rpm, the most that unhurried drivers use (UDRIVE: advised 2000 to 2500, actual 1400 to 3000).
double max_downshift_speed(const vehicle::CarSpec& car, const ShiftBand& band) noexcept;

// Reports causes, not their consequences; comments in error_detector.cpp explain which consequences are left out.
class ErrorDetector {
 public:
  // reading: time that it takes to read the prompts during a shift [s].
  ErrorDetector(const vehicle::CarSpec& car, const haptics::Gate& gate, ShiftBand band = {}, double reading = 0.0);

  // Call every cycle, in order. wanted_gear: gear that the lesson asks for now; kNeutralGear: none. shifting: result of
  // ShiftMeter::is_open(). at: road speed at which wanted_gear should be engaged [m/s]; 0: any.
  void add(const vehicle::DriveSample& sample, int wanted_gear, bool shifting, double at = 0.0);

  // Judges the shift whose record ShiftMeter returned for the last sample. Call after add().
  void judge(const ShiftRecord& record);

  // End of the drive: reports conditions that still last.
  void finish();

  // Errors since the last call.
  std::vector<DrivingError> drain_errors();

 private:
  enum class Measure { length, peak, sum };
  struct WatchedEpisode {
    ErrorKind kind;
    Measure measure;  // property of the episode that becomes the error's value
    Episode episode;
  };

  // Time that the car rolled faster than kMinDrivingSpeed during a shift.
  struct RollingTime {
    double all = 0.0;                  // [s]
    double left = 0.0, in = 0.0;       // [s] `all` when the old gear was left, and when the last gear was engaged
    bool is_braked_to_stop = false;    // the car was braked below kMinDrivingSpeed with the clutch down
    bool is_engine_not_ready = false;  // engine off or just started: its speed says nothing about the driver
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
  // Reports an error if the value reaches the threshold of its kind.
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
  bool has_run_ = false;         // the engine has run by itself since it was last off
  bool has_stalled_ = false;     // the engine has stalled and not yet run in a requested gear again
  double runs_since_ = -1e9;     // [s]
  bool shift_moved_ = false;     // the gear has changed during the current shift
  double shift_moved_at_ = 0.0;  // [s]
  bool shifting_ = false;
  double shift_began_ = 0.0;                 // [s]
  double slow_from_ = 0.0, slow_to_ = -1.0;  // [s] begin and end of the last shift reported as too slow
  double coasted_at_ = -1.0;                 // [s] begin of the last coasting that was reported
  std::vector<DrivingError> coasted_;        // coasting errors held back while an open shift may be the cause
  RollingTime rolling_, rolling_before_;     // for the current or last shift; for the shift before that
  bool wrong_way_ = false;                   // wrong direction already reported for this visit to the slot
  int last_gear_ = haptics::kNeutralGear;    // last gear that was engaged
  int driven_gear_ = haptics::kNeutralGear;  // last gear with the clutch locked
  std::vector<int> tried_;       // gears that the lever was pushed towards since the last record, newest last
  std::vector<int> engaged_;     // gears that were engaged since the last record
  bool reported_speed_ = false;  // a gear engaged at the wrong road speed was reported
  double demanded_speed_ = 0.0;  // [rad/s] engine speed that the last gear required when it was engaged
  int wanted_gear_ = haptics::kNeutralGear;
  bool touching_ = false;
  double touch_error_ = 0.0;  // [rad/s] engine minus gear speed at the worst touch of ring or dogs with the clutch up
  double highest_ = 0.0;      // [m] distance at which the car last stood or rolled forward
  std::vector<DrivingError> errors_;
};

}  // namespace gearshift::lessons
