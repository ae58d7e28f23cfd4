// A whole trace in memory, for short traces.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "haptics/files/file_error.h"
#include "haptics/loop/replay.h"
#include "haptics/loop/trace_reader.h"
#include "haptics/loop/trace_writer.h"

namespace gearshift::test {

struct Trace {
  haptics::TraceHeader header;
  std::vector<haptics::TraceSample> samples;
  std::uint64_t hash = 0;  // recorded hash of parameters and outputs
};

inline Trace read_trace(const std::filesystem::path& file) {
  haptics::TraceReader reader(file);
  Trace trace{reader.header(), {}, 0};
  for (haptics::TraceSample sample; reader.next(sample);) trace.samples.push_back(sample);
  trace.hash = reader.hash();
  return trace;
}

inline void write_trace(const std::filesystem::path& file, const haptics::TraceHeader& header,
                        std::span<const haptics::TraceSample> samples) {
  haptics::TraceWriter writer(file, header);
  for (const haptics::TraceSample& sample : samples) writer.add(sample);
  writer.finish();
  if (!writer.problem().empty()) throw haptics::FileError(file.string(), 0, writer.problem());
}

inline haptics::ReplayResult replay(const Trace& trace, const haptics::LoadFactory& make_load = haptics::make_no_load) {
  haptics::Replayer replayer(trace.header, trace.header.gate_file, make_load);
  for (const haptics::TraceSample& sample : trace.samples)
    if (!replayer.step(sample)) break;
  return replayer.finish(trace.hash);
}

}  // namespace gearshift::test
