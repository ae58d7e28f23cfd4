#include "app/report/shift_recording.h"

#include <glm/geometric.hpp>

#include "haptics/files/file_error.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/loop/trace_reader.h"

namespace gearshift {
namespace {

RecordedCycle cycle_of(const TraceSample& sample, double time) {
  return {time,
          glm::length(sample.out.f_h),
          sample.controls.clutch,
          sample.controls.throttle,
          sample.out.lever,
          sample.out.proxy};
}

}  // namespace

RecordedShift read_shift(const std::filesystem::path& trace, const ShiftRecord& shift) {
  TraceReader reader(trace, TornTrace::salvage);  // what is intact of a killed drive is worth seeing
  const TraceHeader& header = reader.header();
  RecordedShift recorded;
  recorded.gate = compile_gate(parse_gate_layout(header.gate_text, header.gate_file), header.device.workspace,
                               header.device.yoke_radius);
  recorded.alarm = header.config.over_push.warn_above;
  recorded.end = shift.end - shift.begin;
  for (TraceSample sample; reader.next(sample);) {
    const double time = 1e-9 * static_cast<double>(sample.out.time_ns) - shift.begin;
    if (time > recorded.end + kAround) break;
    if (time >= -kAround) recorded.cycles.push_back(cycle_of(sample, time));
  }
  const bool holds_it =
      !recorded.cycles.empty() && recorded.cycles.front().time <= recorded.end && recorded.cycles.back().time >= 0.0;
  if (!holds_it) throw FileError(trace.string(), 0, "does not hold this shift");
  return recorded;
}

}  // namespace gearshift
