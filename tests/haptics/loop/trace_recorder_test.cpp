#include "haptics/loop/trace_recorder.h"

#include <signal.h>
#include <sys/resource.h>

#include <string>

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

// A real loop whose cycles are recorded.
class LoopRig {
 public:
  void run(int cycles, haptics::TraceRecorder& recorder) {
    for (int i = 0; i < cycles; ++i) {
      loop_.cycle(now_ns_ += kPeriodNs, 0);
      recorder.add(loop_.published());
    }
  }

 private:
  static constexpr std::int64_t kPeriodNs = 1'000'000;
  CountingLever lever_;
  haptics::NoLoad no_load_;
  haptics::LoopInputs inputs_;
  haptics::HapticLoop loop_{haptics::HapticConfig{}, paper_gate(), lever_, no_load_, inputs_};
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

TEST_CASE("recorder: every cycle of the loop is in the file, in order") {
  const TempFolder folder;
  LoopRig rig;
  haptics::TraceRecorder recorder(folder / "t.trace", paper_header());
  rig.run(20'000, recorder);
  const haptics::RecordingResult result = recorder.finish();
  CHECK(result.cycles == 20'000);
  CHECK_FALSE(result.torn);
  CHECK(result.problem.empty());
  const Trace trace = read_trace(folder / "t.trace");
  REQUIRE(trace.samples.size() == 20'000);
  CHECK(trace.samples[12'345].out.cycle == 12'345);
  CHECK(trace.samples[12'345].reading.sequence == 12'345);
  CHECK(trace.hash == result.hash);
}

TEST_CASE("recorder: a lost cycle tears the trace, which keeps every cycle before the loss") {
  const TempFolder folder;
  haptics::TraceRecorder recorder(folder / "t.trace", paper_header());
  for (std::uint64_t cycle = 0; cycle < 300; ++cycle) recorder.add(numbered(cycle));
  CHECK_FALSE(recorder.take_problem().has_value());
  for (std::uint64_t cycle = 307; cycle < 400; ++cycle) recorder.add(numbered(cycle));

  const std::optional<std::string> problem = recorder.take_problem();
  REQUIRE(problem.has_value());
  CHECK(problem->find("the recorder could not keep up") != std::string::npos);
  CHECK_FALSE(recorder.take_problem().has_value());  // reported once

  const haptics::RecordingResult result = recorder.finish();
  CHECK(result.torn);
  CHECK(result.cycles == 300);
  CHECK_THROWS_WITH_AS(read_trace(folder / "t.trace"),
                       doctest::Contains("is incomplete, because the recorder could not keep up"), haptics::FileError);
  CHECK(salvage(folder / "t.trace") == 300);
}

TEST_CASE("recorder: a recording that misses the first cycle is torn, because a replay needs every input") {
  const TempFolder folder;
  haptics::TraceRecorder recorder(folder / "t.trace", paper_header());
  recorder.add(numbered(1));
  const haptics::RecordingResult result = recorder.finish();
  CHECK(result.torn);
  CHECK(result.cycles == 0);
}

TEST_CASE("recorder: a file that cannot be created is refused before anything is recorded") {
  const TempFolder folder;
  const auto start = [&](const std::filesystem::path& file) { haptics::TraceRecorder recorder(file, paper_header()); };
  CHECK_THROWS_WITH_AS(start(folder / "no/such/folder.trace"), doctest::Contains("No such file or directory"),
                       haptics::FileError);
  CHECK_THROWS_WITH_AS(start(folder.path()), doctest::Contains("Is a directory"), haptics::FileError);
  CHECK_THROWS_WITH_AS(start("/dev/full"), doctest::Contains("No space left on device"), haptics::FileError);
}

TEST_CASE("recorder: a full disk is reported once, in one sentence, and the loop continues") {
  const TempFolder folder;
  haptics::RecordingResult result;
  {
    haptics::TraceRecorder before(folder / "room.trace", paper_header());
    LoopRig().run(512, before);
    REQUIRE(before.finish().problem.empty());
    const FullDisk disk(std::filesystem::file_size(folder / "room.trace"));
    haptics::TraceRecorder recorder(folder / "t.trace", paper_header());
    LoopRig().run(5000, recorder);
    const std::optional<std::string> problem = recorder.take_problem();
    REQUIRE(problem.has_value());
    CHECK(problem->find("the recording failed after ") == 0);
    CHECK(problem->find("File too large") != std::string::npos);
    CHECK_FALSE(recorder.take_problem().has_value());
    result = recorder.finish();
  }
  CHECK(result.problem.find("the recording failed after ") == 0);
  CHECK_THROWS_WITH_AS(read_trace(folder / "t.trace"), doctest::Contains("is incomplete, because it has no end block"),
                       haptics::FileError);
  std::uint64_t cycles = 0;
  haptics::TraceReader reader(folder / "t.trace", haptics::TornTrace::salvage);
  for (haptics::TraceSample sample; reader.next(sample);) ++cycles;
  CHECK(cycles == 512);  // complete blocks
}

TEST_CASE("recorder: a killed program leaves its cycles in a file that is recognised as torn") {
  const TempFolder folder;
  {
    haptics::TraceWriter writer(folder / "t.trace", paper_header());
    for (std::uint64_t cycle = 0; cycle < 1000; ++cycle) writer.add(numbered(cycle));
  }  // finish() is not called, as if the program was killed here
  CHECK_THROWS_WITH_AS(read_trace(folder / "t.trace"), doctest::Contains("is incomplete, because it has no end block"),
                       haptics::FileError);
  CHECK(salvage(folder / "t.trace") == 768);  // three complete blocks of 256 samples
}

}  // namespace gearshift::test
