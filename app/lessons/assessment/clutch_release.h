// Follows each release of the clutch in gear, from the bite point until it locks: detects a dump, a burn or a jerk.
#pragma once

#include <optional>

#include "app/lessons/assessment/driving_error.h"
#include "app/lessons/assessment/jerk_filter.h"
#include "app/lessons/assessment/pedal_edge.h"
#include "app/vehicle/car_spec.h"
#include "app/vehicle/drive_sample.h"

namespace gearshift::lessons {

inline constexpr double kMinJerkLimit = 110.0;  // [m/s^3] smallest limit in any gear, from measurements (README.md)
// [1] jerk_limit() as a fraction of the jerk of a clutch that grips at once. Engineering value.
inline constexpr double kJerkFraction = 0.5;

// Jerk at which a release of the clutch in this gear becomes an error [m/s^3]: half of the filtered jerk of a clutch
// that grips at once (the acceleration then steps by C i eta / m), but at least kMinJerkLimit. Even a perfect launch
// has some jerk, more with a stronger clutch and a lower gear; a shift need not have any.
double jerk_limit(const vehicle::CarSpec& car, int gear) noexcept;

// Heat at which a release of the clutch in this gear becomes an error [J]: the heat of a launch on the flat with the
// engine held at shift_high, the speed for upshifts, which no launch needs. An engine held at speed w that accelerates
// a car of inertia J (reduced to the clutch) from rest to w does the work J w^2. Half of this work becomes kinetic
// energy and half becomes heat, however long the launch takes. On a slope [rad] the slipping clutch also carries the
// hill's torque T, which adds w T times (half the launch time plus the whole time the car is held before the launch).
double burn_limit(const vehicle::CarSpec& car, int gear, double slope = 0.0) noexcept;

class ClutchRelease {
 public:
  explicit ClutchRelease(const vehicle::CarSpec& car);

  // Call every cycle. Returns the error of a release that has just ended, if any: a dump, else a burn, else a jerk.
  // If the engine stalled, neither burn nor jerk is reported.
  std::optional<DrivingError> add(const vehicle::DriveSample& sample, double dt);
  std::optional<DrivingError> finish() noexcept;  // call at the end of the drive: judges a release in progress

 private:
  bool is_over(const vehicle::DriveSample& sample) noexcept;
  std::optional<DrivingError> judge() const noexcept;

  vehicle::CarSpec car_;
  PedalEdge pedal_;
  JerkFilter filter_;
  bool open_ = false;
  bool stalled_ = false;
  int gear_ = haptics::kNeutralGear;  // gear at the start of the release
  double slope_ = 0.0;                // [rad] slope at the start of the release
  double begin_ = 0.0;                // [s]
  double closed_at_ = 0.0;            // [s] time at which the pedal was up; 0: not yet
  double locked_at_ = 0.0;            // [s] time at which the clutch locked; 0: not yet
  double slip_peak_ = 0.0;            // [W]
  double heat_ = 0.0;                 // [J]
  double jerk_peak_ = 0.0;            // [m/s^3]
};

}  // namespace gearshift::lessons
