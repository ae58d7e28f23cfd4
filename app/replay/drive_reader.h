// A recorded drive, cycle by cycle, with the car that no trace holds: it is run again beside the reading.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "app/training/drive_sample.h"
#include "app/vehicle/car_world.h"
#include "haptics/gate/gate.h"
#include "haptics/loop/replay.h"
#include "haptics/loop/trace_reader.h"

namespace gearshift {

class DriveReader {
 public:
  static constexpr std::uint64_t kMostCycles = 4'000'000;  // an hour at 1 kHz; a file of 1 MB can claim as many

  // What is whole of a torn trace is taken. Throws FileError, as next() does: not there, damaged, of a car or gate that
  // is refused, of a world that is not known, recorded from the middle of a run on, with a number that cannot be.
  // Of more cycles than `most` the rest is not seen.
  explicit DriveReader(const std::filesystem::path& file, std::uint64_t most = kMostCycles);

  const TraceHeader& header() const noexcept { return reader_.header(); }
  const Gate& gate() const noexcept { return gate_; }
  const CarSpec* car() const noexcept { return car_ ? &car_->spec() : nullptr; }       // null: none
  std::uint64_t cycles() const noexcept { return std::min(reader_.cycles(), most_); }  // at most

  // Lever and controls as they were recorded. The car as it came out again; where there is none, or from the cycle on
  // where the second run came out differently, pedals, gear and road speed are the recording's and the rest stays.
  // Times rise: a cycle that a file claims to be no later than the one before is left out.
  bool next(DriveSample& sample);
  bool differs() const noexcept { return differs_; }  // in a cycle up to now

 private:
  std::unique_ptr<LeverWorld> make_world(const std::string& name, const Gate& gate);
  void check(const TraceSample& sample) const;

  std::string name_;
  TraceReader reader_;
  std::uint64_t most_, taken_ = 0;  // [cycles]
  Gate gate_;
  const CarWorld* car_ = nullptr;  // behind the replayer's lever
  Replayer replayer_;
  VehicleState state_;
  std::optional<std::int64_t> last_ns_;  // [ns] of the last cycle that was given
  bool differs_ = false;
};

}  // namespace gearshift
