// Fuzzes the reader of traces, in memory. A file must be rejected in one sentence, or its cycles must be the same after
// they are written and read back.
#include "tests/fuzz/trace_inputs.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

void check_round_trip(const Trace& trace) {
  if (trace.samples.size() > kSamplesPerBlock) return;  // with_checksums() writes one block
  TraceReader reader(with_checksums(encode_header(trace.header), encoded_samples(trace)), kTraceName,
                     TornTrace::salvage);
  check_invariant(same(read_all(reader), trace), "a trace is written and read back the same");
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer requires this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(text_of(data, size));
  const auto read_as = [&](TornTrace torn) {
    TraceReader reader(bytes, kTraceName, torn);
    return read_all(reader);
  };
  Trace trace;
  if (is_accepted(kTraceName, [&] { trace = read_as(TornTrace::refuse); })) {
    ++accepted_inputs;
    check_round_trip(trace);
  } else {
    is_accepted(kTraceName, [&] { read_as(TornTrace::salvage); });
  }
  return 0;
}
