// Monitors each clutch release in gear until the clutch has locked. Detects a clutch dump, excess clutch heat and jerk,
// and a clutch that begins to smell.
#pragma once

#include <optional>

#include "app/lessons/assessment/driving_error.h"
#include "app/lessons/assessment/jerk_filter.h"
#include "app/lessons/assessment/pedal_edge.h"
#include "app/vehicle/car_spec.h"
#include "app/vehicle/drive_sample.h"

namespace gearshift::lessons {

inline constexpr double kMinJerkLimit = 110.0;  // [m/s^3] smallest jerk limit in any gear; measured, see README.md
// [1] jerk limit divided by the jerk of a clutch that engages instantly. Engineering value.
inline constexpr double kJerkFraction = 0.5;

// Jerk above which a clutch release in this gear is an error [m/s^3]: half of the filtered jerk of a clutch that
// engages instantly, but at least kMinJerkLimit. Even a perfect launch causes some jerk, which grows with a stronger
// clutch and in a lower gear.
double jerk_limit(const vehicle::CarSpec& car, int gear) noexcept;

// Clutch torque that the car's weight needs on a slope [rad] in this gear, negative if the weight drives [N m].
double hill_torque(const vehicle::CarSpec& car, int gear, double slope) noexcept;

// Clutch heat above which a clutch release in this gear is an error [J]: the heat of a launch with the engine held at
// the car's `shift_high`, the engine speed for upshifts. No launch needs such a high engine speed.
//
// On the flat, an engine held at speed w that accelerates a car of inertia J (seen at the clutch) from rest to w does
// the work J w^2. Half of this work becomes kinetic energy and half becomes heat, however long the launch takes. On a
// slope [rad], the slipping clutch also carries the torque T of the car's weight. This adds the heat w T (t / 2 + h),
// where t is the launch time and h is the time for which the clutch holds the car before the launch.
double burn_limit(const vehicle::CarSpec& car, int gear, double slope = 0.0) noexcept;

class ClutchRelease {
 public:
  explicit ClutchRelease(const vehicle::CarSpec& car);

  // Call every cycle. When a clutch release ends, returns its most serious error, if any: a clutch dump before a clutch
  // burn, and a clutch burn before a jerk. If the engine stalled, only a dump is returned. A clutch that begins to smell
  // is a clutch burn at once, unless the release, however long the clutch slips after it, has already had one.
  std::optional<DrivingError> add(const vehicle::DriveSample& sample, double dt);
  std::optional<DrivingError> finish() noexcept;  // call at the end of the drive; judges a release in progress

 private:
  bool is_over(const vehicle::DriveSample& sample) noexcept;
  bool begins_to_smell(const vehicle::DriveSample& sample) noexcept;
  std::optional<DrivingError> judge() noexcept;
  DrivingError burn_error(double time) noexcept;

  vehicle::CarSpec car_;
  PedalEdge pedal_;
  JerkFilter filter_;
  bool open_ = false;
  bool stalled_ = false;
  bool burnt_ = false;  // a clutch burn was reported since the last release began
  bool smells_ = false;
  int gear_ = haptics::kNeutralGear;  // gear at the start of the release
  double slope_ = 0.0;                // [rad] slope at the start of the release
  double begin_ = 0.0;                // [s]
  double closed_at_ = 0.0;            // [s] time at which the pedal was up; 0: not yet
  double locked_at_ = 0.0;            // [s] time at which the clutch locked; 0: not yet
  double slip_peak_ = 0.0;            // [W]
  double heat_ = 0.0;                 // [J] since the release began
  double jerk_peak_ = 0.0;            // [m/s^3]
};

}  // namespace gearshift::lessons
