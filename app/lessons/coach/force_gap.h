// Measures how long the lever had no forces during a trial, for example after STOP or a fault.
#pragma once

#include <optional>

#include "app/vehicle/drive_sample.h"

namespace gearshift::lessons {

class ForceGap {
 public:
  void add(const vehicle::DriveSample& sample, bool in_shift) noexcept;  // call in order

  // True if the lever had no forces for too long to judge the drive: for more than 1 s within shifts, or more than 3 s
  // in total.
  bool is_long() const noexcept;

 private:
  double in_all_ = 0.0, in_shifts_ = 0.0;  // [s]
  std::optional<double> time_;             // [s] time of the last sample
};

}  // namespace gearshift::lessons
