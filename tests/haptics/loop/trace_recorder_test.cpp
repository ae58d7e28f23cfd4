#include "haptics/loop/trace_recorder.h"

#include <signal.h>
#include <sys/resource.h>

#include <memory>
#include <string>
#include <thread>

#include <doctest/doctest.h>

#include "haptics/files/file_error.h"
#include "tests/haptics/loop/trace_bench.h"

namespace gearshift {
namespace {

// What HapticLoop does at the end of a cycle.
void push(LoopChannels& channels, const TraceSample& sample) {
  if (!channels.recording.load()) return;
  if (!channels.trace.push(sample)) channels.trace_lost.fetch_add(1);
}

TraceSample numbered(std::uint64_t cycle) {
  TraceSample sample;
  sample.out.cycle = cycle;
  sample.reading.position.x = static_cast<double>(cycle);
  return sample;
}

std::size_t salvage(const std::filesystem::path& file) {
  TraceReader reader(file, TornTrace::salvage);
  std::size_t cycles = 0;
  for (TraceSample sample; reader.next(sample); ++cycles) REQUIRE(sample.out.cycle == cycles);
  return cycles;
}

// Files may not grow beyond this for as long as it lives: a full disk without one.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = signal(SIGXFSZ, SIG_IGN);
    const rlimit small{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int) = SIG_DFL;
};

}  // namespace

TEST_CASE("recorder: every cycle that the loop pushed is in the file, in order") {
  const TempFolder folder;
  auto channels = std::make_unique<LoopChannels>();
  TraceRecorder recorder(folder / "t.trace", paper_header(), *channels, TracePump::by_caller);
  CHECK(channels->recording.load());
  for (std::uint64_t cycle = 0; cycle < 20'000; ++cycle) {
    push(*channels, numbered(cycle));
    if (cycle % 5000 == 0) recorder.pump();
  }
  const RecordingResult result = recorder.finish();
  CHECK_FALSE(channels->recording.load());
  CHECK(result.cycles == 20'000);
  CHECK_FALSE(result.torn);
  CHECK(result.problem.empty());
  const Trace trace = read_trace(folder / "t.trace");
  REQUIRE(trace.samples.size() == 20'000);
  CHECK(trace.samples[12'345].reading.position.x == 12'345.0);
  CHECK(trace.hash == result.hash);
}

TEST_CASE("recorder: beside the loop on its own thread none is lost") {
  const TempFolder folder;
  auto channels = std::make_unique<LoopChannels>();
  TraceRecorder recorder(folder / "t.trace", paper_header(), *channels, TracePump::own_thread);
  std::thread loop([&] {
    for (std::uint64_t cycle = 0; cycle < 50'000; ++cycle)
      while (!channels->trace.push(numbered(cycle))) std::this_thread::yield();
  });
  loop.join();
  const RecordingResult result = recorder.finish();
  CHECK(result.cycles == 50'000);
  CHECK(result.problem.empty());
  CHECK(read_trace(folder / "t.trace").samples.size() == 50'000);
}

TEST_CASE("recorder: a queue that overflows tears the trace, which keeps every cycle before the first loss") {
  const TempFolder folder;
  auto channels = std::make_unique<LoopChannels>();
  const std::uint64_t room = channels->trace.capacity();
  TraceRecorder recorder(folder / "t.trace", paper_header(), *channels, TracePump::by_caller);
  for (std::uint64_t cycle = 0; cycle < 100; ++cycle) push(*channels, numbered(cycle));
  recorder.pump();
  CHECK_FALSE(recorder.take_problem().has_value());
  for (std::uint64_t cycle = 100; cycle < 100 + room + 7; ++cycle) push(*channels, numbered(cycle));
  REQUIRE(channels->trace_lost.load() == 7);
  recorder.pump();
  CHECK_FALSE(channels->recording.load());  // closed: no cycle after a gap is of use

  const std::optional<std::string> told = recorder.take_problem();
  REQUIRE(told.has_value());
  CHECK(told->find("the recorder could not keep up") != std::string::npos);
  CHECK_FALSE(recorder.take_problem().has_value());  // once

  const RecordingResult result = recorder.finish();
  CHECK(result.torn);
  CHECK(result.cycles == 100 + room);
  CHECK_THROWS_WITH_AS(read_trace(folder / "t.trace"),
                       doctest::Contains("is torn: the recorder could not keep up"), FileError);
  CHECK(salvage(folder / "t.trace") == 100 + room);
}

TEST_CASE("recorder: a loss between two cycles that did arrive is a gap, and the trace ends before it") {
  const TempFolder folder;
  auto channels = std::make_unique<LoopChannels>();
  TraceRecorder recorder(folder / "t.trace", paper_header(), *channels, TracePump::by_caller);
  for (std::uint64_t cycle = 0; cycle < 50; ++cycle) push(*channels, numbered(cycle));
  for (std::uint64_t cycle = 51; cycle < 90; ++cycle) push(*channels, numbered(cycle));
  const RecordingResult result = recorder.finish();
  CHECK(result.torn);
  CHECK(result.cycles == 50);
  CHECK(salvage(folder / "t.trace") == 50);
}

TEST_CASE("recorder: a file that cannot be created is refused before anything is recorded") {
  const TempFolder folder;
  auto channels = std::make_unique<LoopChannels>();
  const auto start = [&](const std::filesystem::path& file) {
    TraceRecorder recorder(file, paper_header(), *channels, TracePump::by_caller);
  };
  CHECK_THROWS_WITH_AS(start(folder / "no/such/folder.trace"), doctest::Contains("No such file or directory"),
                       FileError);
  CHECK_THROWS_WITH_AS(start(folder.path()), doctest::Contains("Is a directory"), FileError);
  CHECK_THROWS_WITH_AS(start("/dev/full"), doctest::Contains("No space left on device"), FileError);
  CHECK_FALSE(channels->recording.load());
}

TEST_CASE("recorder: a disk that fills up is told once, in one sentence, and the loop goes on") {
  const TempFolder folder;
  auto channels = std::make_unique<LoopChannels>();
  RecordingResult result;
  {
    const FullDisk disk(300'000);
    TraceRecorder recorder(folder / "t.trace", paper_header(), *channels, TracePump::by_caller);
    for (std::uint64_t cycle = 0; cycle < 5000; ++cycle) {
      push(*channels, numbered(cycle));
      if (cycle % 100 == 0) recorder.pump();
    }
    const std::optional<std::string> told = recorder.take_problem();
    REQUIRE(told.has_value());
    CHECK(told->find("the recording failed after ") == 0);
    CHECK(told->find("File too large") != std::string::npos);
    CHECK_FALSE(recorder.take_problem().has_value());
    result = recorder.finish();
  }
  CHECK(result.problem.find("the recording failed after ") == 0);
  CHECK_THROWS_WITH_AS(read_trace(folder / "t.trace"), doctest::Contains("is torn: it has no end block"),
                       FileError);
  CHECK(salvage(folder / "t.trace") >= 512);
}

TEST_CASE("recorder: what another recording left in the queue does not get into the next one") {
  const TempFolder folder;
  auto channels = std::make_unique<LoopChannels>();
  for (std::uint64_t cycle = 500; cycle < 510; ++cycle) (void)channels->trace.push(numbered(cycle));
  channels->trace_lost.store(3);  // torn was the one before
  TraceRecorder recorder(folder / "t.trace", paper_header(), *channels, TracePump::by_caller);
  push(*channels, numbered(0));
  push(*channels, numbered(1));
  const RecordingResult result = recorder.finish();
  CHECK(result.cycles == 2);
  CHECK_FALSE(result.torn);
}

TEST_CASE("recorder: a program that is killed leaves its cycles in a file that is known to be torn") {
  const TempFolder folder;
  {
    TraceWriter writer(folder / "t.trace", paper_header());
    for (std::uint64_t cycle = 0; cycle < 1000; ++cycle) writer.add(numbered(cycle));
  }  // no finish(): as if killed here
  CHECK_THROWS_WITH_AS(read_trace(folder / "t.trace"), doctest::Contains("is torn: it has no end block"),
                       FileError);
  CHECK(salvage(folder / "t.trace") == 768);  // whole blocks of 256
}

}  // namespace gearshift
