// Fuzzes the replay of traces, both as by the verb `replay` and as by the trainer, their writer and the exported
// table. A trace must be rejected in one sentence or replayed to its end or its first difference.
#include <algorithm>

#include "app/lessons/replay/recorded_drive.h"
#include "haptics/loop/replay.h"
#include "haptics/loop/trace_csv.h"
#include "tests/fuzz/trace_inputs.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

FuzzedFile& the_trace() {
  static FuzzedFile file(kTraceName);
  return file;
}

std::unique_ptr<LeverLoad> make_load(const std::string& name, const Gate& gate) {
  std::unique_ptr<LeverLoad> no_load = make_no_load(name, gate);
  return no_load ? std::move(no_load) : make_car_load(name, gate);
}

void check_csv(const Trace& trace) {
  const auto commas = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
  for (const TraceSample& sample : trace.samples) {
    const std::string line = trace_csv_line(sample, trace.samples.front().deadline_ns);
    check_invariant(is_printable(line) && commas(line) == commas(trace_csv_header()),
                    "each cycle is one line of the table");
  }
}

void check_written(const Trace& trace) {
  static FuzzedFile copy("copy.trace");
  write_trace(copy.path(), trace.header, trace.samples);
  check_invariant(same(read_trace(copy.path()), trace), "a trace is written and read back the same");
}

void check_replay(const Trace& trace) {
  Replayer replayer(trace.header, the_trace().path().string(), make_load);
  for (const TraceSample& sample : trace.samples)
    if (!replayer.step(sample)) break;
  const ReplayResult result = replayer.finish(trace.hash);
  check_invariant(result.cycles <= trace.samples.size(), "no more cycles are run than recorded");
  check_invariant(!result.first || !result.first->field.empty(), "a difference has a name");
}

void check_drive() {
  const RecordedDrive drive(the_trace().path());
  check_invariant(!drive.samples().empty(), "a drive has a sample");
  check_invariant(drive.begin() <= drive.end(), "a drive ends after it began");
  const auto falls = [](const DriveSample& a, const DriveSample& b) { return !(a.time() < b.time()); };
  check_invariant(std::adjacent_find(drive.samples().begin(), drive.samples().end(), falls) == drive.samples().end(),
                  "the times of a drive rise");
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer requires this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string name = the_trace().put(text_of(data, size)).string();
  is_accepted(name, check_drive);
  Trace trace;
  if (!is_accepted(name, [&] { trace = read_trace(the_trace().path()); })) return 0;
  ++accepted_inputs;
  check_csv(trace);
  check_written(trace);
  is_accepted(name, [&] { check_replay(trace); });
  return 0;
}
