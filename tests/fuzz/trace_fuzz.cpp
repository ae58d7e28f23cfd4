// Fuzzes traces. A file must be rejected in one sentence, or its cycles must be the same after they are written and
// read back. The cycles are also exported, and replayed both as by the verb `replay` and as by the trainer. The mutator
// starts from the recording of a drive with or without a car. It changes the contents of blocks and then corrects their
// checksums, because otherwise every input would be rejected at a checksum.
#include <algorithm>
#include <optional>
#include <random>
#include <vector>

#include "app/lessons/replay/recorded_drive.h"
#include "app/vehicle/car_load.h"
#include "haptics/files/file_error.h"
#include "haptics/loop/block_codec.h"
#include "haptics/loop/replay.h"
#include "haptics/loop/simulated_run.h"
#include "haptics/loop/trace_csv.h"
#include "haptics/loop/trace_recorder.h"
#include "tests/fuzz/fuzz_checks.h"
#include "tests/support/gates.h"
#include "tests/support/short_trace.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::vehicle;

// NOLINTBEGIN(readability-identifier-naming): libFuzzer requires these names
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

using Bytes = std::vector<std::byte>;
using Random = std::minstd_rand;

constexpr int kCycles = 6;

FuzzedFile& the_trace() {
  static FuzzedFile file("drive.trace");
  return file;
}

std::unique_ptr<LeverLoad> make_load(const std::string& name, const Gate& gate) {
  std::unique_ptr<LeverLoad> no_load = make_no_load(name, gate);
  return no_load ? std::move(no_load) : make_car_load(name, gate);
}

// Returns the recording of a drive of kCycles cycles.
Trace sample_trace(bool with_car) {
  const GateLayout layout = read_gate_layout(GEARSHIFT_ASSETS "/gates/paper.toml");
  SimulatedRunConfig config;
  config.gate = compile_gate(layout, kPaperWorkspace);
  const CarSpec car = read_car(GEARSHIFT_ASSETS "/cars/hatchback.toml");
  NoLoad no_load;
  CarLoad hatchback(car, config.gate, 30.0);
  LeverLoad& load = with_car ? static_cast<LeverLoad&>(hatchback) : no_load;
  IdleHand hand;
  SimulatedRun run(config, hand, &load);
  const TraceHeader header{
      "1.2.3", config.haptics, run.lever().spec(), "paper.toml", layout.text, load.replay_parameters(), true};
  TraceRecorder recorder(the_trace().path(), header);
  for (int i = 0; i < kCycles; ++i) {
    run.step();
    recorder.add(run.loop().published());
  }
  recorder.finish();
  return read_trace(the_trace().path());
}

std::optional<Trace> trace_in(std::string_view bytes) {
  try {
    TraceReader reader(the_trace().put(bytes), TornTrace::salvage);
    Trace trace{reader.header(), {}, 0};
    for (TraceSample sample; reader.next(sample);) trace.samples.push_back(sample);
    if (!trace.samples.empty()) return trace;
  } catch (const FileError&) {  // the caller then uses a newly recorded trace
  }
  return std::nullopt;
}

// Mutates either all bytes, which may change their count, or only eight bytes in place, as if one number changed.
void mutate(Bytes& bytes, Random& random) {
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

void append(std::string& file, std::span<const std::byte> bytes) {
  file.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

// Builds a trace file with valid checksums from any header and samples. As in the reader, the hash of the run includes
// the decoded header.
std::string with_checksums(const Bytes& header, const std::vector<EncodedSample>& samples) {
  Bytes plain, coded;
  RunHash hash = begin_hash(decode_header(header).value_or(TraceHeader{}));
  for (const EncodedSample& sample : samples) {
    plain.insert(plain.end(), sample.begin(), sample.end());
    hash.add(outputs_of(sample));
  }
  BlockCodec().encode(plain, coded);
  const auto end = encode_end({samples.size(), hash.value(), false});
  std::string file(kTraceMagic.begin(), kTraceMagic.end());
  file.append(reinterpret_cast<const char*>(&kTraceVersion), sizeof kTraceVersion);
  append(file, encode_frame(BlockKind::header, header));
  append(file, header);
  append(file, encode_frame(BlockKind::data, coded, samples.size()));
  append(file, coded);
  append(file, encode_frame(BlockKind::end, end));
  append(file, end);
  return file;
}

std::string mutated(const Trace& trace, Random& random) {
  Bytes header = encode_header(trace.header);
  std::vector<EncodedSample> samples;
  for (const TraceSample& sample : trace.samples) samples.push_back(encode_sample(sample));
  samples.resize(std::min(samples.size(), kSamplesPerBlock));
  if (random() % 2 == 0) {
    mutate(header, random);
  } else {
    EncodedSample& sample = samples[random() % samples.size()];
    Bytes bytes(sample.begin(), sample.end());
    mutate(bytes, random);
    bytes.resize(kSampleBytes);
    std::copy(bytes.begin(), bytes.end(), sample.begin());
  }
  return with_checksums(header, samples);
}

bool same(const Trace& a, const Trace& b) {
  return a.hash == b.hash && encode_header(a.header) == encode_header(b.header) &&
         std::equal(a.samples.begin(), a.samples.end(), b.samples.begin(), b.samples.end(),
                    [](const TraceSample& x, const TraceSample& y) { return encode_sample(x) == encode_sample(y); });
}

// Returns true if `work` succeeds, and false if it rejects the file, which it must do in one sentence.
template <class Work>
bool is_accepted(const Work& work) {
  try {
    work();
    return true;
  } catch (const FileError& refusal) {  // the only exception allowed
    check_sentence(refusal, the_trace().path().string() + ":");
    return false;
  }
}

void check_csv(const Trace& trace) {
  const auto commas = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
  for (const TraceSample& sample : trace.samples) {
    const std::string line = trace_csv_line(sample, trace.samples.front().deadline_ns);
    check_invariant(is_printable(line) && commas(line) == commas(trace_csv_header()),
                    "each cycle is one line of the table");
  }
}

void check_round_trip(const Trace& trace) {
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

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  Random random(seed);
  if (random() % 8 == 0) return LLVMFuzzerMutate(data, size, max_size);
  const std::optional<Trace> trace = trace_in(text_of(data, size));
  const std::string file = mutated(trace ? *trace : sample_trace(random() % 2 == 0), random);
  const std::size_t copied = std::min(file.size(), max_size);
  std::copy_n(file.begin(), copied, data);
  return copied;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  the_trace().put(text_of(data, size));
  Trace trace;
  const bool is_complete = is_accepted([&] { trace = read_trace(the_trace().path()); });
  is_accepted([&] {
    const auto salvaged = TraceReader(the_trace().path(), TornTrace::salvage);
    check_invariant(!is_complete || salvaged.cycles() == trace.samples.size(),
                    "a complete trace is salvaged completely");
  });
  is_accepted(check_drive);
  if (!is_complete) return 0;
  ++accepted_inputs;
  check_csv(trace);
  check_round_trip(trace);
  is_accepted([&] { check_replay(trace); });
  return 0;
}
// NOLINTEND(readability-identifier-naming)
