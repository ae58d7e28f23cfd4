// Measures how long the lever had no forces during a trial, because of STOP, forces off, a fault, or not being armed.
#pragma once

#include <optional>

#include "app/vehicle/drive_sample.h"

namespace gearshift::lessons {

class ForceGap {
 public:
  void add(const vehicle::DriveSample& sample, bool in_shift) noexcept;  // call in order

  // True if forces were missing for too long to judge the drive: more than 1 s within shifts or 3 s in all.
  bool is_long() const noexcept;

 private:
  double in_all_ = 0.0, in_shifts_ = 0.0;  // [s]
  std::optional<double> time_;             // [s] time of the last sample
};

}  // namespace gearshift::lessons
