// A recorded drive, whole: the trace, and by running it again what no trace holds, the car and its shifts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stop_token>
#include <vector>

#include <glm/vec2.hpp>

#include "app/training/drive_sample.h"
#include "app/training/shift_record.h"
#include "haptics/gate/gate.h"
#include "haptics/loop/trace_reader.h"

namespace gearshift {

struct RecordedShift {
  ShiftRecord record;
  std::vector<glm::dvec2> driven;  // [m] the drawn lever's way, from the gear that was left to the one that came
  std::vector<glm::dvec2> ideal;   // [m] the shortest way between these, see shortest_path(); a point a corner
};

class RecordedDrive {
 public:
  // What is whole of a torn trace is taken. Samples 4 ms apart, or as far as kMostSamples need; the last cycle is
  // always one. Throws FileError: not there, damaged, of a car or gate that is refused. Where the second run differs from the
  // recording, differs() says so, the recording's own values stand, and there are no shifts from there on. FileError too
  // where it is stopped.
  explicit RecordedDrive(const std::filesystem::path& file, const std::stop_token& stop = {});

  const TraceHeader& header() const noexcept { return header_; }
  const Gate& gate() const noexcept { return gate_; }
  bool has_car() const noexcept { return has_car_; }
  const std::string& car_name() const noexcept { return car_name_; }  // CarSpec::name; empty: none
  bool differs() const noexcept { return differs_; }
  double begin() const noexcept { return samples_.front().time(); }           // [s] on the loop's clock
  double end() const noexcept { return samples_.back().time(); }              // [s]
  std::span<const DriveSample> samples() const noexcept { return samples_; }  // at least one, their times rise
  const DriveSample& at(double time) const noexcept;  // the last one not after it; the first one before all
  std::span<const DriveSample> between(double from, double to) const noexcept;   // from < time <= to
  const std::vector<RecordedShift>& shifts() const noexcept { return shifts_; }  // in order; of a drive with a car

  static constexpr std::size_t kMostSamples = 150'000;
  // One cycle of so many is kept, of a drive of so many cycles at that rate [Hz].
  static std::uint64_t stride(double rate, std::uint64_t cycles) noexcept;

 private:
  TraceHeader header_;
  Gate gate_;
  std::vector<DriveSample> samples_;
  std::vector<RecordedShift> shifts_;
  std::string car_name_;
  bool has_car_ = false;
  bool differs_ = false;
};

}  // namespace gearshift
