#include "app/report/shift_recording.h"

#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "app/replay/drive_reader.h"
#include "app/replay/shift_way.h"
#include "haptics/files/file_error.h"

namespace gearshift {
namespace {

RecordedCycle cycle_of(const DriveSample& sample, double time) {
  return {time,
          glm::length(sample.lever.f_h),
          sample.controls.clutch,
          sample.controls.throttle,
          sample.car.engine_speed,
          std::abs(sample.car.shaft_speed),
          sample.car.gear,
          sample.lever.lever,
          sample.lever.proxy};
}

}  // namespace

ShiftRecording read_shift(const std::filesystem::path& trace, const ShiftRecord& shift) {
  DriveReader reader(trace);  // what is intact of a killed drive is worth seeing
  ShiftRecording recorded;
  recorded.gate = reader.gate();
  recorded.alarm = reader.header().config.over_push.warn_above;
  recorded.end = shift.end - shift.begin;
  ShiftWay way;
  for (DriveSample sample; reader.next(sample);) {
    const double time = sample.time() - shift.begin;
    if (time > recorded.end + kAround) break;
    if (time >= -kAround) recorded.cycles.push_back(cycle_of(sample, time));
    if (time >= 0.0) way.add(sample.time(), sample.lever.proxy);
  }
  const bool holds_it =
      !recorded.cycles.empty() && recorded.cycles.front().time <= recorded.end && recorded.cycles.back().time >= 0.0;
  if (!holds_it) throw FileError(trace.string(), 0, "does not hold this shift");
  recorded.has_car = reader.car() != nullptr && !reader.differs();
  recorded.ideal = way.ways(shift, recorded.gate).ideal;
  return recorded;
}

}  // namespace gearshift
