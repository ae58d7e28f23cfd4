// Reads a recorded drive cycle by cycle. Traces do not contain the car, so it is simulated again alongside.
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
  static constexpr std::uint64_t kMaxCycles = 4'000'000;  // an hour at 1 kHz; even a file of 1 MB can claim this many

  // Reads the intact part of a damaged trace, at most `max_cycles` cycles. Like next(), throws FileError if the file is
  // missing or damaged, if its car or gate is rejected, if its lever load is unknown, if it was recorded from the
  // middle of a run, or if it contains an implausible number.
  explicit DriveReader(const std::filesystem::path& file, std::uint64_t max_cycles = kMaxCycles);

  const haptics::TraceHeader& header() const noexcept { return reader_.header(); }
  const haptics::Gate& gate() const noexcept { return gate_; }
  const vehicle::CarSpec* car() const noexcept { return car_ ? &car_->spec() : nullptr; }    // null: no car
  std::uint64_t cycles() const noexcept { return std::min(reader_.cycles(), max_cycles_); }  // upper limit of next()

  // Lever and controls are as recorded; the car is simulated. Without a car, or from the cycle on in which the
  // simulation diverges from the recording, pedals, gear and road speed are the recorded ones and all else keeps its
  // last value. Times increase strictly: a cycle whose time is not after the previous one is skipped.
  bool next(vehicle::DriveSample& sample);
  bool has_diverged() const noexcept { return has_diverged_; }  // true if any cycle read so far diverged

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
