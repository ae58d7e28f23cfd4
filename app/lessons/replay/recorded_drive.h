// A complete recorded drive: its trace, car and shifts. Car and shifts are simulated again, because no trace contains
// them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stop_token>
#include <vector>

#include <glm/vec2.hpp>

#include "app/lessons/assessment/shift_record.h"
#include "app/vehicle/drive_sample.h"
#include "haptics/gate/gate.h"
#include "haptics/loop/trace_reader.h"

namespace gearshift::lessons {

struct RecordedShift {
  ShiftRecord record;
  std::vector<glm::dvec2> driven;  // [m] path of the displayed lever, from the old gear to the new one
  std::vector<glm::dvec2> ideal;   // [m] shortest path between the ends of `driven`; one point per corner
};

class RecordedDrive {
 public:
  // Reads the intact part of a damaged trace. Stores samples 4 ms apart, or further apart if kMaxSamples requires it,
  // and always the last cycle. Throws FileError if the file is missing or has no intact part, if its car or gate is
  // rejected, or on a stop request. If the simulated car diverges from the recording, has_diverged() is true; from that
  // cycle on, recorded values are used and no shifts are found.
  explicit RecordedDrive(const std::filesystem::path& file, const std::stop_token& stop = {});

  const haptics::TraceHeader& header() const noexcept { return header_; }
  const haptics::Gate& gate() const noexcept { return gate_; }
  bool has_car() const noexcept { return has_car_; }
  const std::string& car_name() const noexcept { return car_name_; }  // CarSpec::name; empty: no car
  bool has_diverged() const noexcept { return has_diverged_; }
  double begin() const noexcept { return samples_.front().time(); }                    // [s] on the haptic loop's clock
  double end() const noexcept { return samples_.back().time(); }                       // [s]
  std::span<const vehicle::DriveSample> samples() const noexcept { return samples_; }  // never empty; in order of time
  // Returns the last sample that is not after `time`; if `time` is before the drive, the first sample.
  const vehicle::DriveSample& at(double time) const noexcept;
  std::span<const vehicle::DriveSample> between(double from, double to) const noexcept;  // samples: from < time <= to
  const std::vector<RecordedShift>& shifts() const noexcept { return shifts_; }  // in order of time; empty: no car

  static constexpr std::size_t kMaxSamples = 150'000;
  // Number of cycles per stored sample, for a drive of `cycles` cycles at `rate` [Hz].
  static std::uint64_t stride(double rate, std::uint64_t cycles) noexcept;

 private:
  haptics::TraceHeader header_;
  haptics::Gate gate_;
  std::vector<vehicle::DriveSample> samples_;
  std::vector<RecordedShift> shifts_;
  std::string car_name_;
  bool has_car_ = false;
  bool has_diverged_ = false;
};

}  // namespace gearshift::lessons
