#include "app/replay/recorded_drive.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "app/replay/drive_reader.h"
#include "app/replay/shift_way.h"
#include "app/training/shift_meter.h"
#include "haptics/files/file_error.h"

namespace gearshift {
namespace {

constexpr double kApart = 0.004;    // [s] between samples that are kept
constexpr double kRounding = 1e-9;  // [1] of a cycle

// Cycles to shifts, with their ways.
class ShiftFinder {
 public:
  ShiftFinder(const CarSpec& car, const Gate& gate) : meter_(car, gate), gate_(gate) {}

  void add(const DriveSample& sample) {
    const bool was_open = meter_.is_open();
    const std::optional<ShiftRecord> ended = meter_.add(sample);
    if (ended) take(*ended);
    if (!meter_.is_open()) return;
    if (ended || !was_open) way_.clear();
    way_.add(sample.time(), sample.lever.proxy);
  }

  std::vector<RecordedShift> shifts() && { return std::move(shifts_); }

 private:
  void take(const ShiftRecord& record) {
    ShiftWays ways = way_.ways(record, gate_);
    shifts_.push_back({record, std::move(ways.driven), std::move(ways.ideal)});
  }

  ShiftMeter meter_;
  const Gate& gate_;
  ShiftWay way_;
  std::vector<RecordedShift> shifts_;
};

bool is_before(double time, const DriveSample& sample) noexcept {
  return time < sample.time();
}

}  // namespace

RecordedDrive::RecordedDrive(const std::filesystem::path& file, const std::stop_token& stop) {
  DriveReader reader(file);
  header_ = reader.header();
  gate_ = reader.gate();
  has_car_ = reader.car() != nullptr;
  if (has_car_) car_name_ = reader.car()->name;
  std::optional<ShiftFinder> finder;
  if (has_car_) finder.emplace(*reader.car(), gate_);
  const std::uint64_t every = stride(header_.config.rate, reader.cycles());
  samples_.reserve(reader.cycles() / every + 2);
  DriveSample sample;
  for (std::uint64_t cycle = 0; reader.next(sample); ++cycle) {
    if (stop.stop_requested()) throw FileError(file.string(), 0, "was not read to its end");
    if (finder && !reader.differs()) finder->add(sample);
    if (cycle % every == 0) samples_.push_back(sample);
  }
  if (samples_.empty()) throw FileError(file.string(), 0, "holds no cycles");
  if (sample.lever.time_ns != samples_.back().lever.time_ns) samples_.push_back(sample);
  if (finder) shifts_ = std::move(*finder).shifts();
  differs_ = reader.differs();
}

// The last cycle comes on top of these.
std::uint64_t RecordedDrive::stride(double rate, std::uint64_t cycles) noexcept {
  const auto apart = static_cast<std::uint64_t>(std::ceil(kApart * rate - kRounding));
  const std::uint64_t room = kMostSamples - 1;
  return std::max({std::uint64_t{1}, apart, (cycles + room - 1) / room});
}

const DriveSample& RecordedDrive::at(double time) const noexcept {
  const auto after = std::upper_bound(samples_.begin(), samples_.end(), time, is_before);
  return after == samples_.begin() ? samples_.front() : *(after - 1);
}

std::span<const DriveSample> RecordedDrive::between(double from, double to) const noexcept {
  const auto first = std::upper_bound(samples_.begin(), samples_.end(), from, is_before);
  const auto last = std::upper_bound(first, samples_.end(), std::max(from, to), is_before);
  return {first, last};
}

}  // namespace gearshift
