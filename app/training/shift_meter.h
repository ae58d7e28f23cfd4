// Samples to shift records: every number of ShiftRecord, as the drive goes on.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <glm/vec2.hpp>

#include "app/training/drive_sample.h"
#include "app/training/jerk_filter.h"
#include "app/training/pedal_edge.h"
#include "app/training/recent_peak.h"
#include "app/training/shift_record.h"
#include "app/vehicle/car_spec.h"
#include "haptics/gate/gate.h"

namespace gearshift {

// Integrals are trapezoids over the samples, times are good to one period. README.md beside this file has the
// definitions that shift_record.h leaves open. Not for the haptic thread: a record allocates.
class ShiftMeter {
 public:
  ShiftMeter(const CarSpec& car, const Gate& gate);

  // Every cycle, in order. The record of the shift that has ended, kJerkSettles after its end or as the next one
  // begins. What was begun and taken back before the gear was left is no shift and leaves no record.
  std::optional<ShiftRecord> add(const DriveSample& sample);

  // The drive is over: the shift that is in progress or still settles, if it is one (a gear was lost or another one
  // tried). What was still to come does not count against it.
  std::optional<ShiftRecord> finish();

  bool is_open() const noexcept { return stage_ == Stage::open; }         // a shift has begun and not ended
  bool is_pending() const noexcept { return stage_ == Stage::settling; }  // ended, its record is still to come

 private:
  enum class Stage { idle, open, settling };
  enum class Rest { busy, coupled, given_up };  // gear and clutch in; clutch in, no new gear, and nothing done about it

  struct Way {               // of the lever, by chords
    glm::dvec2 begin{0.0};   // [m] of the drawn lever
    glm::dvec2 anchor{0.0};  // [m]
    double length = 0.0;     // [m] up to the anchor
  };

  struct Open {  // what a record needs while it is open
    ShiftRecord record;
    double torque_before = 0.0;   // [N m]
    double slip_before = 0.0;     // [J]
    double flare_base = 0.0;      // [rad/s]
    double clutch_down_at = 0.0;  // [s]
    double throttle_on_at = 0.0;  // [s] the last time
    double early_up_at = 0.0;     // [s] the clutch came up against ring or dogs, the first time; 0: it did not
    double left_at = 0.0;         // [s]
    double gear_in_at = 0.0;      // [s]
    double rest_since = 0.0;      // [s]
    double fourth_power = 0.0;    // [m^4/s^7] of the acceleration
    Rest rest = Rest::busy;
    bool left = false;      // the lever is out of the gear's rest, or out of neutral
    bool dogs_out = false;  // the gear was lost
    bool tried = false;     // another one was
    bool gear_in = false;   // a gear is in since the old one was left
    bool coupled = false;   // and the clutch was up since
    bool clutch_used = false;
    bool clutch_is_down = false;
    bool took_torque = false;
    int tried_gear = kNeutralGear;
    std::array<bool, kMaxSlots> engaged{};  // gears that were in on the way
    int last_slot = kNoSlot;                // that the lever is properly in
    std::array<int, kMaxSlots> entered{};
    Way way;
  };

  bool begins(const DriveSample& now) const noexcept;
  void begin(const DriveSample& now, bool throttle_was_on);
  void follow(const DriveSample& now, double dt, bool throttle_was_on);
  void follow_steps(const DriveSample& now, bool throttle_was_on);
  void follow_clutch(const DriveSample& now);
  void follow_lever(const DriveSample& now);
  void follow_gear(const DriveSample& now);
  void take_torque(const DriveSample& now);
  void integrate(const DriveSample& now, double dt);
  void feel(const DriveSample& now, double dt);
  void walk(const DriveSample& now);
  void arrive(const DriveSample& now);
  bool is_taken_back() const noexcept;
  void follow_rest(const DriveSample& now);
  bool has_ended(const DriveSample& now) const noexcept;
  bool is_shift() const noexcept;
  bool begins_anew(const DriveSample& now) const noexcept;
  void end(const DriveSample& at, bool whole = true);
  ShiftRecord close();

  bool rests_in(const DriveSample& now, int gear) const noexcept;
  int slot_proper(const DriveSample& now) const noexcept;
  bool tries_another(const DriveSample& now) const noexcept;
  bool pushes_on(const DriveSample& now) const noexcept;
  bool stays(const DriveSample& now) const noexcept;

  CarSpec car_;
  Gate gate_;
  PedalEdge pedal_;
  RecentPeak torque_;
  JerkFilter filter_;
  Stage stage_ = Stage::idle;
  Open open_;
  DriveSample last_;
  bool first_ = true;
  bool throttle_on_ = false;
  int gear_ = kNeutralGear;  // the last that was at rest
  int left_slot_ = kNoSlot;  // where the lever was left when the last shift was given up
  double left_depth_ = 0.0;  // [m]
  double guided_at_ = -1e9;  // [s] guidance was asked for, the last time
  std::int64_t number_ = 0;
};

}  // namespace gearshift
