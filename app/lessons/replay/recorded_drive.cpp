#include "app/lessons/replay/recorded_drive.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "app/lessons/assessment/shift_meter.h"
#include "app/lessons/replay/drive_reader.h"
#include "app/lessons/replay/lever_path.h"
#include "haptics/files/file_error.h"

namespace gearshift::lessons {
namespace {

constexpr double kSampleSpacing = 0.004;  // [s] time between stored samples
constexpr double kRounding = 1e-9;        // [1] tolerance as a fraction of a cycle

// Finds the shifts in a sequence of cycles, with their paths.
class ShiftFinder {
 public:
  ShiftFinder(const vehicle::CarSpec& car, const haptics::Gate& gate) : meter_(car, gate), gate_(gate) {}

  void add(const vehicle::DriveSample& sample) {
    const bool was_open = meter_.is_open();
    const std::optional<ShiftRecord> ended = meter_.add(sample);
    if (ended) add_shift(*ended);
    if (!meter_.is_open()) return;
    if (ended || !was_open) path_.clear();
    path_.add(sample.time(), sample.lever.proxy);
  }

  std::vector<RecordedShift> shifts() && { return std::move(shifts_); }

 private:
  void add_shift(const ShiftRecord& record) {
    ShiftPaths paths = path_.paths(record, gate_);
    shifts_.push_back({record, std::move(paths.driven), std::move(paths.ideal)});
  }

  ShiftMeter meter_;
  const haptics::Gate& gate_;
  LeverPath path_;
  std::vector<RecordedShift> shifts_;
};

bool is_before(double time, const vehicle::DriveSample& sample) noexcept {
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
  vehicle::DriveSample sample;
  for (std::uint64_t cycle = 0; reader.next(sample); ++cycle) {
    if (stop.stop_requested()) throw haptics::FileError(file.string(), 0, "reading the trace was cancelled");
    if (finder && !reader.has_diverged()) finder->add(sample);
    if (cycle % every == 0) samples_.push_back(sample);
  }
  if (samples_.empty()) throw haptics::FileError(file.string(), 0, "the trace contains no cycles");
  if (sample.lever.time_ns != samples_.back().lever.time_ns) samples_.push_back(sample);
  if (finder) shifts_ = std::move(*finder).shifts();
  has_diverged_ = reader.has_diverged();
}

// Limits the samples to kMaxSamples - 1, because the last cycle is stored in addition.
std::uint64_t RecordedDrive::stride(double rate, std::uint64_t cycles) noexcept {
  const auto apart = static_cast<std::uint64_t>(std::ceil(kSampleSpacing * rate - kRounding));
  const std::uint64_t room = kMaxSamples - 1;
  return std::max({std::uint64_t{1}, apart, (cycles + room - 1) / room});
}

const vehicle::DriveSample& RecordedDrive::at(double time) const noexcept {
  const auto after = std::upper_bound(samples_.begin(), samples_.end(), time, is_before);
  return after == samples_.begin() ? samples_.front() : *(after - 1);
}

std::span<const vehicle::DriveSample> RecordedDrive::between(double from, double to) const noexcept {
  const auto first = std::upper_bound(samples_.begin(), samples_.end(), from, is_before);
  const auto last = std::upper_bound(first, samples_.end(), std::max(from, to), is_before);
  return {first, last};
}

}  // namespace gearshift::lessons
