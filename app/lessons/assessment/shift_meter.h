// Computes shift records from samples during a drive.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <glm/vec2.hpp>

#include "app/lessons/assessment/jerk_filter.h"
#include "app/lessons/assessment/pedal_edge.h"
#include "app/lessons/assessment/recent_peak.h"
#include "app/lessons/assessment/shift_record.h"
#include "app/vehicle/car_spec.h"
#include "app/vehicle/drive_sample.h"
#include "haptics/gate/gate.h"

namespace gearshift::lessons {

// Detects and measures the shifts of a drive. Integrals use the trapezoidal rule; times are accurate to one period.
// README.md defines details that shift_record.h leaves open. Do not use on the haptic thread, because records allocate
// memory.
class ShiftMeter {
 public:
  ShiftMeter(const vehicle::CarSpec& car, const haptics::Gate& gate);

  // Call every cycle, in order. Returns a shift's record kJerkSettlingTime after the shift has ended, or earlier if the
  // next shift begins. An abandoned shift has a record only if the old gear was left or a different gear was tried.
  std::optional<ShiftRecord> add(const vehicle::DriveSample& sample);

  // Call at the end of the drive. Returns the record of a pending shift, or of the shift in progress if the old gear
  // was left or a different gear was tried. Steps missing because the drive ended do not count as out of place.
  std::optional<ShiftRecord> finish();

  bool is_open() const noexcept { return stage_ == Stage::open; }  // a shift has begun and not ended
  // a shift has ended; its record is not returned yet
  bool is_pending() const noexcept { return stage_ == Stage::settling; }
  double jerk() const noexcept { return filter_.jerk(); }  // [m/s^3] in the newest cycle, filtered

 private:
  enum class Stage { idle, open, settling };
  // `coupled`: gear in and clutch up. `given_up`: clutch up without a new gear, and no further attempt.
  enum class Rest { busy, coupled, given_up };

  struct LeverPath {         // path of the lever as a sum of chords
    glm::dvec2 begin{0.0};   // [m] first position of the proxy
    glm::dvec2 anchor{0.0};  // [m] end of the last chord
    double length = 0.0;     // [m] length up to the anchor
  };

  struct OpenShift {  // state of the current shift
    ShiftRecord record;
    double torque_before = 0.0;   // [N m]
    double slip_before = 0.0;     // [J]
    double flare_base = 0.0;      // [rad/s]
    double clutch_down_at = 0.0;  // [s]
    double throttle_on_at = 0.0;  // [s] last time the throttle was pressed
    double early_up_at = 0.0;     // [s] first time the clutch came up while the lever pressed on ring or dogs; 0: never
    double left_at = 0.0;         // [s]
    double gear_in_at = 0.0;      // [s]
    double rest_since = 0.0;      // [s]
    Rest rest = Rest::busy;
    bool left = false;      // the lever has left the old gear's rest position, or has left neutral
    bool dogs_out = false;  // the old gear was disengaged
    bool tried = false;     // a gear other than the old one was tried
    bool gear_in = false;   // a gear has been engaged since the old one was left
    bool coupled = false;   // gear_in is true and the clutch is up
    bool clutch_used = false;
    bool clutch_is_down = false;
    bool has_rev_error = false;
    int tried_gear = haptics::kNeutralGear;
    std::array<bool, haptics::kMaxSlots> engaged{};  // gears engaged during the shift
    int last_slot = haptics::kNoSlot;                // slot of the last sample; kNoSlot if not past the mouth
    std::array<int, haptics::kMaxSlots> entered{};
    LeverPath lever_path;
  };

  bool begins(const vehicle::DriveSample& now) const noexcept;
  void begin(const vehicle::DriveSample& now, bool throttle_was_on);
  void follow(const vehicle::DriveSample& now, double dt, bool throttle_was_on);
  void follow_steps(const vehicle::DriveSample& now, bool throttle_was_on);
  void follow_clutch(const vehicle::DriveSample& now);
  void follow_lever(const vehicle::DriveSample& now);
  void follow_gear(const vehicle::DriveSample& now);
  void measure_rev_error(const vehicle::DriveSample& now);
  void integrate(const vehicle::DriveSample& now, double dt);
  void measure_jerk();
  void integrate_path(const vehicle::DriveSample& now);
  void end_path(const vehicle::DriveSample& now);
  bool is_cancelled() const noexcept;
  void update_rest(const vehicle::DriveSample& now);
  bool has_ended(const vehicle::DriveSample& now) const noexcept;
  bool is_shift() const noexcept;
  bool begins_next(const vehicle::DriveSample& now) const noexcept;
  void end(const vehicle::DriveSample& at, bool is_complete = true);
  ShiftRecord close();

  bool rests_in(const vehicle::DriveSample& now, int gear) const noexcept;
  int slot_to(int gear) const noexcept;
  int slot_past_mouth(const vehicle::DriveSample& now) const noexcept;
  bool is_trying_another(const vehicle::DriveSample& now) const noexcept;
  bool is_pushing(const vehicle::DriveSample& now) const noexcept;
  bool is_where_abandoned(const vehicle::DriveSample& now) const noexcept;

  vehicle::CarSpec car_;
  haptics::Gate gate_;
  PedalEdge pedal_;
  RecentPeak torque_;
  JerkFilter filter_;
  Stage stage_ = Stage::idle;
  OpenShift open_;
  vehicle::DriveSample last_;
  bool first_ = true;
  bool throttle_on_ = false;
  int gear_ = haptics::kNeutralGear;  // gear at the end of the last shift
  int left_slot_ = haptics::kNoSlot;  // slot where the lever stayed when the last shift was abandoned
  double left_depth_ = 0.0;           // [m]
  double guided_at_ = -1e9;           // [s] time of the last request for guidance
  std::int64_t number_ = 0;
};

}  // namespace gearshift::lessons
