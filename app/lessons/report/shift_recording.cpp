#include "app/lessons/report/shift_recording.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "app/lessons/assessment/pedal_edge.h"
#include "app/lessons/replay/drive_reader.h"
#include "app/lessons/replay/lever_path.h"
#include "haptics/files/file_error.h"

namespace gearshift::lessons {
namespace {

RecordedCycle cycle_of(const vehicle::DriveSample& sample, double time) {
  return {time,
          glm::length(sample.lever.f_h),
          sample.controls.pedals.clutch,
          sample.controls.pedals.throttle,
          sample.car.engine_speed,
          std::abs(sample.car.shaft_speed),
          sample.car.gear,
          sample.lever.lever,
          sample.lever.proxy};
}

// Collects the times of the clutch presses, as counted in the shift's record. If the pedal is still down at the end of
// the shift, the press ends there.
class Presses {
 public:
  explicit Presses(const vehicle::CarSpec* car) : pedal_(car ? car->clutch.bite : 1.0), has_car_(car != nullptr) {}

  void add(const vehicle::DriveSample& sample, double time) {
    if (!has_car_) return;
    pedal_.update(sample.car.pedals.clutch, time);
    if (pedal_.went_down()) is_down_ = true, down_at_ = pedal_.down_at();
    if (pedal_.went_up()) end(pedal_.up_at());
  }
  std::vector<ClutchPress> up_to(double time) {
    end(time);
    return std::move(presses_);
  }

 private:
  void end(double time) {
    if (is_down_ && time > 0.0) presses_.push_back({std::max(0.0, down_at_), time});
    is_down_ = false;
  }

  PedalEdge pedal_;
  bool has_car_;
  bool is_down_ = false;
  double down_at_ = 0.0;  // [s] since the shift began
  std::vector<ClutchPress> presses_;
};

}  // namespace

ShiftRecording read_shift(const std::filesystem::path& trace, const ShiftRecord& shift) {
  DriveReader reader(trace);  // also reads the incomplete recording of a killed process
  ShiftRecording recorded;
  recorded.gate = reader.gate();
  recorded.alarm = reader.header().config.over_push.warn_above;
  recorded.end = shift.end - shift.begin;
  LeverPath path;
  Presses presses(reader.car());
  for (vehicle::DriveSample sample; reader.next(sample);) {
    const double time = sample.time() - shift.begin;
    if (time > recorded.end + kRecordingMargin) break;
    if (time <= recorded.end) presses.add(sample, time);
    if (time >= -kRecordingMargin) recorded.cycles.push_back(cycle_of(sample, time));
    if (time >= 0.0) path.add(sample.time(), sample.lever.proxy);
  }
  const bool holds_it =
      !recorded.cycles.empty() && recorded.cycles.front().time <= recorded.end && recorded.cycles.back().time >= 0.0;
  if (!holds_it) throw haptics::FileError(trace.string(), 0, "does not contain this shift");
  recorded.has_car = reader.car() != nullptr && !reader.has_diverged();
  recorded.presses = presses.up_to(recorded.end);
  recorded.ideal = path.paths(shift, recorded.gate).ideal;
  return recorded;
}

}  // namespace gearshift::lessons
