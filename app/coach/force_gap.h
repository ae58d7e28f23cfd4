// For how long the lever was without forces in a trial: STOP, Release, a fault, or never armed.
#pragma once

#include <optional>

#include "app/training/drive_sample.h"

namespace gearshift {

class ForceGap {
 public:
  void add(const DriveSample& sample, bool in_shift) noexcept;  // in order

  // So long that the drive cannot be judged: 1 s in all within shifts, or 3 s.
  bool is_long() const noexcept;

 private:
  double in_all_ = 0.0, in_shifts_ = 0.0;  // [s]
  std::optional<double> time_;             // [s] of the last sample
};

}  // namespace gearshift
