// Reads a recorded drive cycle by cycle. Traces do not contain the state of the car, so the car is simulated again
// during reading.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "app/vehicle/car_load.h"
#include "app/vehicle/drive_sample.h"
#include "haptics/gate/gate.h"
#include "haptics/loop/replay.h"
#include "haptics/loop/trace_reader.h"

namespace gearshift::lessons {

class DriveReader {
 public:
  static constexpr std::uint64_t kMaxCycles = 4'000'000;  // an hour at 1 kHz; even a 1 MB file can claim this many

  // Reads at most `max_cycles` cycles. If the trace is damaged, reads only its intact part. Like next(), throws
  // FileError if the file is missing or has no intact part, if its car or gate is rejected, if its lever load is
  // unknown, if it was recorded from the middle of a run, or if it contains an implausible number.
  explicit DriveReader(const std::filesystem::path& file, std::uint64_t max_cycles = kMaxCycles);

  const haptics::TraceHeader& header() const noexcept { return reader_.header(); }
  const haptics::Gate& gate() const noexcept { return gate_; }
  const vehicle::CarSpec* car() const noexcept { return car_ ? &car_->spec() : nullptr; }  // null: no car
  // Upper limit of the number of cycles that next() returns.
  std::uint64_t cycles() const noexcept { return std::min(reader_.cycles(), max_cycles_); }

  // Returns the next cycle; false at the end. Lever and controls come from the recording; the car is simulated. Without
  // a car, or once the simulation diverges from the recording, pedals, gear and road speed come from the recording and
  // all other values of the car stay unchanged. Skips a cycle whose time is not after the previous cycle's time.
  bool next(vehicle::DriveSample& sample);
  bool has_diverged() const noexcept { return has_diverged_; }  // true once any cycle has diverged

 private:
  std::unique_ptr<haptics::LeverLoad> make_load(const std::string& name, const haptics::Gate& gate);
  void check(const haptics::TraceSample& sample) const;

  std::string name_;
  haptics::TraceReader reader_;
  std::uint64_t max_cycles_, cycles_read_ = 0;  // [cycles]
  haptics::Gate gate_;
  const vehicle::CarLoad* car_ = nullptr;  // owned by the replayer's lever load
  haptics::Replayer replayer_;
  vehicle::VehicleState state_;
  std::optional<std::int64_t> last_ns_;  // [ns] time of the last returned cycle
  bool has_diverged_ = false;
};

}  // namespace gearshift::lessons
