// Inputs of the trace harnesses. The mutator starts from the recording of a drive with or without a car. It changes the
// contents of blocks and then corrects their checksums, because otherwise every input would be rejected at a checksum.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "app/vehicle/car_load.h"
#include "haptics/files/file_error.h"
#include "haptics/loop/block_codec.h"
#include "haptics/loop/simulated_run.h"
#include "haptics/loop/trace_recorder.h"
#include "tests/fuzz/fuzz_checks.h"
#include "tests/support/gates.h"
#include "tests/support/short_trace.h"

// NOLINTBEGIN(readability-identifier-naming): libFuzzer requires these names
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace gearshift::test {

using Bytes = std::vector<std::byte>;
using Random = std::minstd_rand;

inline constexpr const char* kTraceName = "fuzzed.trace";

inline Trace read_all(haptics::TraceReader& reader) {
  Trace trace{reader.header(), {}, 0};
  for (haptics::TraceSample sample; reader.next(sample);) trace.samples.push_back(sample);
  trace.hash = reader.hash();
  return trace;
}

// Returns the recording of a short drive through a small gate, because small inputs are quick.
inline Trace record_drive(bool with_car) {
  constexpr int kCycles = 3;
  const haptics::GateLayout layout =
      haptics::parse_gate_layout("name = \"a\"\n[sequential]\ngears = 5\nup = \"back\"\n", "small.toml");
  haptics::SimulatedRunConfig config;
  config.gate = haptics::compile_gate(layout, kPaperWorkspace);
  haptics::NoLoad no_load;
  vehicle::CarLoad hatchback(vehicle::read_car(GEARSHIFT_ASSETS "/cars/hatchback.toml"), config.gate, 30.0);
  haptics::LeverLoad& load = with_car ? static_cast<haptics::LeverLoad&>(hatchback) : no_load;
  haptics::IdleHand hand;
  haptics::SimulatedRun run(config, hand, &load);
  const haptics::TraceHeader header{
      "1.2.3", config.haptics, run.lever().spec(), "small.toml", layout.text, load.replay_parameters(), true};
  const FuzzedFile file("drive.trace");
  haptics::TraceRecorder recorder(file.path(), header);
  for (int i = 0; i < kCycles; ++i) {
    run.step();
    recorder.add(run.loop().published());
  }
  recorder.finish();
  return read_trace(file.path());
}

// Returns the trace of the input, or a recorded one if the input holds no intact cycle.
inline Trace trace_in(std::string_view bytes, bool with_car) {
  try {
    haptics::TraceReader reader(std::string(bytes), kTraceName, haptics::TornTrace::salvage);
    Trace trace = read_all(reader);
    if (!trace.samples.empty()) return trace;
  } catch (const haptics::FileError&) {  // the recorded trace is used
  }
  static const std::array kRecorded{record_drive(false), record_drive(true)};
  return kRecorded[with_car ? 1 : 0];
}

// Mutates either all bytes, which may change their count, or only eight bytes in place, as if one number changed.
inline void mutate(Bytes& bytes, Random& random) {
  auto* const data = reinterpret_cast<std::uint8_t*>(bytes.data());
  if (bytes.size() < 8 || random() % 4 != 0) {
    const std::size_t at = bytes.size() < 8 ? 0 : random() % (bytes.size() - 7);
    LLVMFuzzerMutate(data + at, std::min<std::size_t>(bytes.size(), 8), std::min<std::size_t>(bytes.size(), 8));
    return;
  }
  const std::size_t size = bytes.size();
  bytes.resize(size + 64);
  bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), size, bytes.size()));
}

inline void append(std::string& file, std::span<const std::byte> bytes) {
  file.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

// Builds a trace file with valid checksums from any header and samples. As in the reader, the hash of the run includes
// the decoded header.
inline std::string with_checksums(const Bytes& header, const std::vector<haptics::EncodedSample>& samples) {
  static haptics::BlockCodec codec;
  static Bytes coded;
  Bytes plain;
  haptics::RunHash hash = haptics::begin_hash(haptics::decode_header(header).value_or(haptics::TraceHeader{}));
  for (const haptics::EncodedSample& sample : samples) {
    plain.insert(plain.end(), sample.begin(), sample.end());
    hash.add(haptics::outputs_of(sample));
  }
  codec.encode(plain, coded);
  const auto end = haptics::encode_end({samples.size(), hash.value(), false});
  std::string file(haptics::kTraceMagic.begin(), haptics::kTraceMagic.end());
  file.append(reinterpret_cast<const char*>(&haptics::kTraceVersion), sizeof haptics::kTraceVersion);
  append(file, haptics::encode_frame(haptics::BlockKind::header, header));
  append(file, header);
  append(file, haptics::encode_frame(haptics::BlockKind::data, coded, samples.size()));
  append(file, coded);
  append(file, haptics::encode_frame(haptics::BlockKind::end, end));
  append(file, end);
  return file;
}

// The samples of a trace, encoded; at most those of one block.
inline std::vector<haptics::EncodedSample> encoded_samples(const Trace& trace) {
  std::vector<haptics::EncodedSample> samples;
  for (const haptics::TraceSample& sample : trace.samples) {
    if (samples.size() == haptics::kSamplesPerBlock) break;
    samples.push_back(haptics::encode_sample(sample));
  }
  return samples;
}

inline std::string mutated(const Trace& trace, Random& random) {
  Bytes header = haptics::encode_header(trace.header);
  std::vector<haptics::EncodedSample> samples = encoded_samples(trace);
  if (random() % 2 == 0) {
    mutate(header, random);
  } else {
    haptics::EncodedSample& sample = samples[random() % samples.size()];
    Bytes bytes(sample.begin(), sample.end());
    mutate(bytes, random);
    bytes.resize(haptics::kSampleBytes);
    std::copy(bytes.begin(), bytes.end(), sample.begin());
  }
  return with_checksums(header, samples);
}

inline bool same(const Trace& a, const Trace& b) {
  return a.hash == b.hash && haptics::encode_header(a.header) == haptics::encode_header(b.header) &&
         std::equal(a.samples.begin(), a.samples.end(), b.samples.begin(), b.samples.end(),
                    [](const haptics::TraceSample& x, const haptics::TraceSample& y) {
                      return haptics::encode_sample(x) == haptics::encode_sample(y);
                    });
}

// Returns true if `work` succeeds, and false if it rejects the file, which it must do in one sentence that begins with
// the file's name.
template <class Work>
bool is_accepted(const std::string& file_name, const Work& work) {
  try {
    work();
    return true;
  } catch (const haptics::FileError& refusal) {  // the only exception allowed
    check_sentence(refusal, file_name + ":");
    return false;
  }
}

}  // namespace gearshift::test

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  using namespace gearshift::test;
  Random random(seed);
  if (random() % 8 == 0) return LLVMFuzzerMutate(data, size, max_size);
  const std::string file = mutated(trace_in(text_of(data, size), random() % 2 == 0), random);
  const std::size_t copied = std::min(file.size(), max_size);
  std::copy_n(file.begin(), copied, data);
  return copied;
}
// NOLINTEND(readability-identifier-naming)
