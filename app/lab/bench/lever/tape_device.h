// A device that plays back recorded readings, so that only the cost of the cycle is measured.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "haptics/device/haptic_device.h"

namespace gearshift::lab {

class TapeDevice final : public haptics::HapticDevice {
 public:
  TapeDevice(const haptics::DeviceSpec& spec, std::vector<haptics::LeverReading> tape)
      : spec_(spec), tape_(std::move(tape)) {}

  const haptics::DeviceSpec& spec() const noexcept override { return spec_; }
  haptics::LeverReading read(std::int64_t) noexcept override {
    const haptics::LeverReading& reading = tape_[next_];
    next_ = next_ + 1 < tape_.size() ? next_ + 1 : next_;
    return reading;
  }
  void write(glm::dvec2 force) noexcept override { written_ = force; }
  void release() noexcept override { written_ = {0.0, 0.0}; }

  glm::dvec2 written() const noexcept { return written_; }
  void rewind() noexcept { next_ = 0; }

 private:
  haptics::DeviceSpec spec_;
  std::vector<haptics::LeverReading> tape_;
  std::size_t next_ = 0;
  glm::dvec2 written_{0.0};
};

}  // namespace gearshift::lab
