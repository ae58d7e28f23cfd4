// One letting up of the clutch in gear, from its bite point until it holds: was it dumped, did it burn, did it jerk?
#pragma once

#include <optional>

#include "app/training/drive_fault.h"
#include "app/training/drive_sample.h"
#include "app/training/jerk_filter.h"
#include "app/training/pedal_edge.h"
#include "app/vehicle/car_spec.h"

namespace gearshift {

inline constexpr double kLeastJerk = 110.0;  // [m/s^3] less is none in any gear: as measured, see README.md
inline constexpr double kJerkShare = 0.5;    // [1] of what that clutch gives at once [engineering value]

// From what jerk on letting the clutch up in that gear is a fault [m/s^3]: half of the jerk that the whole clutch taking
// hold at once gives, C i eta / m behind the filter, but at least kLeastJerk. A launch has a jerk however well it is
// done, and the more the stronger clutch and gear are; a shift need have none.
double jerk_limit(const CarSpec& car, int gear) noexcept;

// From what heat on letting the clutch up in that gear is a fault [J]: what a launch on the flat burns with the engine
// held at shift_high, from which on one shifts up and which no launch needs. An engine held at w brings a car that weighs
// J at the clutch from a stand up to w; of the work that it does for that, J w^2, half is the car's speed and half is
// heat, however long it takes. On a slope [rad] the clutch carries the hill's torque besides, T, as long as it slips: w
// T times half of the time that the car takes to come up to w, and the whole of the time that it is held there before.
double burn_limit(const CarSpec& car, int gear, double slope = 0.0) noexcept;

class ClutchRelease {
 public:
  explicit ClutchRelease(const CarSpec& car);

  // Every cycle. The fault of the release that is over, if there is one: a dump, or else a burn, or else a jerk; no burn
  // and no jerk beside a stall.
  std::optional<DriveFault> add(const DriveSample& sample, double dt);
  std::optional<DriveFault> finish() noexcept;  // the drive ends: what the release in progress has shown so far

 private:
  bool is_over(const DriveSample& sample) noexcept;
  std::optional<DriveFault> judge() const noexcept;

  CarSpec car_;
  PedalEdge pedal_;
  JerkFilter filter_;
  bool open_ = false;
  bool stalled_ = false;
  int gear_ = kNeutralGear;  // as it began
  double slope_ = 0.0;       // [rad] the same
  double begin_ = 0.0;       // [s]
  double closed_at_ = 0.0;   // [s]; 0: not yet
  double locked_at_ = 0.0;   // [s]; 0: not yet
  double slip_peak_ = 0.0;   // [W]
  double heat_ = 0.0;        // [J]
  double jerk_peak_ = 0.0;   // [m/s^3]
};

}  // namespace gearshift
