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

  bool is_open() const noexcept { return stage_ == Stage::open; }         // a shift has begun and not ended
  bool is_pending() const noexcept { return stage_ == Stage::settling; }  // ended, its record is still to come

 private:
  enum class Stage { idle, open, settling };
  enum class Rest { busy, coupled, neutral };  // gear and clutch in; no gear, clutch in and the lever in the aisle

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
    int last_slot = kNoSlot;  // that the lever is properly in
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
  bool has_ended(const DriveSample& now);
  bool begins_anew(const DriveSample& now) const noexcept;
  void end(const DriveSample& at);
  ShiftRecord close();

  bool rests_in(const DriveSample& now, int gear) const noexcept;
  int slot_proper(const DriveSample& now) const noexcept;

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
  std::int64_t number_ = 0;
};

}  // namespace gearshift
