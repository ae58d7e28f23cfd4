// A device that hands out readings recorded before: the cycle's cost without a device's.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "haptics/device/haptic_device.h"

namespace gearshift {

class TapeDevice final : public HapticDevice {
 public:
  TapeDevice(const DeviceSpec& spec, std::vector<LeverReading> tape) : spec_(spec), tape_(std::move(tape)) {}

  const DeviceSpec& spec() const noexcept override { return spec_; }
  LeverReading read(std::int64_t) noexcept override {
    const LeverReading& reading = tape_[next_];
    next_ = next_ + 1 < tape_.size() ? next_ + 1 : next_;
    return reading;
  }
  void write(glm::dvec2 force) noexcept override { written_ = force; }
  void release() noexcept override { written_ = {0.0, 0.0}; }

  glm::dvec2 written() const noexcept { return written_; }
  void rewind() noexcept { next_ = 0; }

 private:
  DeviceSpec spec_;
  std::vector<LeverReading> tape_;
  std::size_t next_ = 0;
  glm::dvec2 written_{0.0};
};

}  // namespace gearshift
