#include "haptics/loop/trace_recorder.h"

#include <signal.h>
#include <sys/resource.h>

#include <memory>
#include <string>
#include <thread>

#include <doctest/doctest.h>

#include "haptics/files/file_error.h"
#include "tests/haptics/loop/trace_bench.h"
#include "tests/support/gates.h"

namespace gearshift::test {
namespace {

// A lever at rest, which numbers its readings from 0.
class CountingLever final : public haptics::HapticDevice {
 public:
  const haptics::DeviceSpec& spec() const noexcept override { return spec_; }
  haptics::LeverReading read(std::int64_t now_ns) noexcept override {
    haptics::LeverReading reading;
    reading.sequence = readings_++;
    reading.time_ns = now_ns;
    return reading;
  }
  void write(glm::dvec2) noexcept override {}
  void release() noexcept override {}

 private:
  haptics::DeviceSpec spec_;
  std::uint64_t readings_ = 0;
};

// A real loop whose cycles are recorded, or lost when the queue is full.
class LoopRig {
 public:
  haptics::LoopChannels channels;

  void run(int cycles) {
    for (int i = 0; i < cycles; ++i) loop_.cycle(now_ns_ += kPeriodNs, 0);
  }

 private:
  static constexpr std::int64_t kPeriodNs = 1'000'000;
  CountingLever lever_;
  haptics::NoLoad no_load_;
  haptics::HapticLoop loop_{haptics::HapticConfig{}, paper_gate(), lever_, no_load_, channels};
  std::int64_t now_ns_ = 0;
};

haptics::TraceSample numbered(std::uint64_t cycle) {
  haptics::TraceSample sample;
  sample.out.cycle = cycle;
  return sample;
}

std::size_t salvage(const std::filesystem::path& file) {
  haptics::TraceReader reader(file, haptics::TornTrace::salvage);
  std::size_t cycles = 0;
  for (haptics::TraceSample sample; reader.next(sample); ++cycles) REQUIRE(sample.out.cycle == cycles);
  return cycles;
}

// Simulates a full disk: limits the size of all files while the object exists.
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
  LoopRig rig;
  haptics::TraceRecorder recorder(folder / "t.trace", paper_header(), rig.channels, haptics::TracePump::by_caller);
  CHECK(rig.channels.recording.load());
  for (int thousand = 0; thousand < 20; ++thousand) {
    rig.run(1000);
    recorder.pump();
  }
  const haptics::RecordingResult result = recorder.finish();
  CHECK_FALSE(rig.channels.recording.load());
  CHECK(result.cycles == 20'000);
  CHECK_FALSE(result.torn);
  CHECK(result.problem.empty());
  const haptics::Trace trace = haptics::read_trace(folder / "t.trace");
  REQUIRE(trace.samples.size() == 20'000);
  CHECK(trace.samples[12'345].out.cycle == 12'345);
  CHECK(trace.samples[12'345].reading.sequence == 12'345);
  CHECK(trace.hash == result.hash);
}

TEST_CASE("recorder: on its own thread beside the loop no cycle is lost") {
  const TempFolder folder;
  auto channels = std::make_unique<haptics::LoopChannels>();
  haptics::TraceRecorder recorder(folder / "t.trace", paper_header(), *channels, haptics::TracePump::by_recorder);
  std::thread loop([&] {
    for (std::uint64_t cycle = 0; cycle < 50'000; ++cycle)
      while (!channels->trace.push(numbered(cycle))) std::this_thread::yield();
  });
  loop.join();
  const haptics::RecordingResult result = recorder.finish();
  CHECK(result.cycles == 50'000);
  CHECK(result.problem.empty());
  CHECK(haptics::read_trace(folder / "t.trace").samples.size() == 50'000);
}

TEST_CASE("recorder: a queue that overflows tears the trace, which keeps every cycle before the first loss") {
  const TempFolder folder;
  LoopRig rig;
  const std::uint64_t room = rig.channels.trace.capacity();
  haptics::TraceRecorder recorder(folder / "t.trace", paper_header(), rig.channels, haptics::TracePump::by_caller);
  rig.run(100);
  recorder.pump();
  CHECK_FALSE(recorder.take_problem().has_value());
  rig.run(static_cast<int>(room) + 7);
  REQUIRE(rig.channels.trace_lost.load() == 7);
  recorder.pump();
  CHECK_FALSE(rig.channels.recording.load());  // recording stops, because a trace cannot be replayed beyond a gap

  const std::optional<std::string> problem = recorder.take_problem();
  REQUIRE(problem.has_value());
  CHECK(problem->find("the recorder could not keep up") != std::string::npos);
  CHECK_FALSE(recorder.take_problem().has_value());  // reported once

  const haptics::RecordingResult result = recorder.finish();
  CHECK(result.torn);
  CHECK(result.cycles == 100 + room);
  CHECK_THROWS_WITH_AS(haptics::read_trace(folder / "t.trace"),
                       doctest::Contains("is incomplete, because the recorder could not keep up"), haptics::FileError);
  CHECK(salvage(folder / "t.trace") == 100 + room);
}

TEST_CASE("recorder: a loss between two cycles that arrived is a gap, and the trace ends before it") {
  const TempFolder folder;
  LoopRig rig;
  haptics::TraceRecorder recorder(folder / "t.trace", paper_header(), rig.channels, haptics::TracePump::by_caller);
  rig.run(50);
  rig.channels.recording.store(false);
  rig.run(1);
  rig.channels.recording.store(true);
  rig.run(39);
  const haptics::RecordingResult result = recorder.finish();
  CHECK(result.torn);
  CHECK(result.cycles == 50);
  CHECK(salvage(folder / "t.trace") == 50);
}

TEST_CASE("recorder: a file that cannot be created is refused before anything is recorded") {
  const TempFolder folder;
  auto channels = std::make_unique<haptics::LoopChannels>();
  const auto start = [&](const std::filesystem::path& file) {
    haptics::TraceRecorder recorder(file, paper_header(), *channels, haptics::TracePump::by_caller);
  };
  CHECK_THROWS_WITH_AS(start(folder / "no/such/folder.trace"), doctest::Contains("No such file or directory"),
                       haptics::FileError);
  CHECK_THROWS_WITH_AS(start(folder.path()), doctest::Contains("Is a directory"), haptics::FileError);
  CHECK_THROWS_WITH_AS(start("/dev/full"), doctest::Contains("No space left on device"), haptics::FileError);
  CHECK_FALSE(channels->recording.load());
}

TEST_CASE("recorder: a full disk is reported once, in one sentence, and the loop continues") {
  const TempFolder folder;
  LoopRig rig;
  haptics::RecordingResult result;
  {
    haptics::TraceRecorder before(folder / "room.trace", paper_header(), rig.channels, haptics::TracePump::by_caller);
    rig.run(600);
    REQUIRE(before.finish().problem.empty());
    const FullDisk disk(std::filesystem::file_size(folder / "room.trace"));
    haptics::TraceRecorder recorder(folder / "t.trace", paper_header(), rig.channels, haptics::TracePump::by_caller);
    for (int hundred = 0; hundred < 50; ++hundred) {
      rig.run(100);
      recorder.pump();
    }
    const std::optional<std::string> problem = recorder.take_problem();
    REQUIRE(problem.has_value());
    CHECK(problem->find("the recording failed after ") == 0);
    CHECK(problem->find("File too large") != std::string::npos);
    CHECK_FALSE(recorder.take_problem().has_value());
    result = recorder.finish();
  }
  CHECK(result.problem.find("the recording failed after ") == 0);
  CHECK_THROWS_WITH_AS(haptics::read_trace(folder / "t.trace"),
                       doctest::Contains("is incomplete, because it has no end block"), haptics::FileError);
  std::uint64_t cycles = 0;
  haptics::TraceReader reader(folder / "t.trace", haptics::TornTrace::salvage);
  for (haptics::TraceSample sample; reader.next(sample);) ++cycles;
  CHECK(cycles == 512);  // complete blocks
}

TEST_CASE("recorder: samples that an earlier recording left in the queue are not recorded") {
  const TempFolder folder;
  LoopRig rig;
  rig.channels.recording.store(true);
  rig.run(10);
  rig.channels.trace_lost.store(3);  // a count left by an earlier, interrupted recording
  haptics::TraceRecorder recorder(folder / "t.trace", paper_header(), rig.channels, haptics::TracePump::by_caller);
  rig.run(2);
  const haptics::RecordingResult result = recorder.finish();
  CHECK_FALSE(result.torn);
  const haptics::Trace trace = haptics::read_trace(folder / "t.trace");
  REQUIRE(trace.samples.size() == 2);
  CHECK(trace.samples[0].out.cycle == 10);
}

TEST_CASE("recorder: a killed program leaves its cycles in a file that is recognised as torn") {
  const TempFolder folder;
  {
    haptics::TraceWriter writer(folder / "t.trace", paper_header());
    for (std::uint64_t cycle = 0; cycle < 1000; ++cycle) writer.add(numbered(cycle));
  }  // finish() is not called, as if the program was killed here
  CHECK_THROWS_WITH_AS(haptics::read_trace(folder / "t.trace"),
                       doctest::Contains("is incomplete, because it has no end block"), haptics::FileError);
  CHECK(salvage(folder / "t.trace") == 768);  // three complete blocks of 256 samples
}

}  // namespace gearshift::test
