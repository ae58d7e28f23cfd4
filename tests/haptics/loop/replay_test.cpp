#include "haptics/loop/replay.h"

#include <bit>
#include <cstdint>
#include <future>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include <doctest/doctest.h>

#include "haptics/files/file_error.h"
#include "haptics/rt/broadcast.h"
#include "haptics/rt/realtime_thread.h"
#include "tests/haptics/loop/recorded_drive.h"
#include "tests/support/short_trace.h"

namespace gearshift::test {
namespace {

const Trace& recorded_trace() {
  static const Trace trace = [] {
    const TempFolder folder;
    RecordedDrive drive;
    drive.record(folder / "drive.trace");
    return read_trace(folder / "drive.trace");
  }();
  return trace;
}

void flip_lowest_bit(double& value) {
  value = std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) ^ 1u);
}

// Calls visit(full name, double&) for every double in a struct and its nested structs.
template <class T, class Visit>
void each_double(T& value, const std::string& prefix, const Visit& visit) {
  haptics::each_field(value, [&](const char* name, auto& member) {
    using Member = std::remove_cvref_t<decltype(member)>;
    if constexpr (std::is_same_v<Member, double>)
      visit(prefix + name, member);
    else if constexpr (!haptics::LeafField<Member>)
      each_double(member, prefix + name + ".", visit);
  });
}

std::vector<std::string> names_of_doubles(const haptics::HapticConfig& config) {
  std::vector<std::string> names;
  haptics::HapticConfig copy = config;
  each_double(copy, "", [&](const std::string& name, double&) { names.push_back(name); });
  return names;
}

void flip(haptics::HapticConfig& config, const std::string& wanted) {
  each_double(config, "", [&](const std::string& name, double& value) {
    if (name == wanted) flip_lowest_bit(value);
  });
}

std::string refusal(const Trace& trace) {
  try {
    replay(trace);
  } catch (const haptics::FileError& error) {
    return error.what();
  }
  return {};
}

bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

// A load with memory: a spring whose rest position slowly follows the lever.
class CreepingSpring final : public haptics::LeverLoad {
 public:
  haptics::LeverOutput step(const haptics::LeverInput& in, double period) noexcept override {
    rest_ += period * (in.position - rest_);
    haptics::LeverOutput out;
    out.force = 20.0 * (rest_ - in.position) * (1.0 + in.controls.pedals.throttle);
    out.road_speed = 100.0 * rest_.x;
    return out;
  }
  const char* replay_parameters() const noexcept override { return "creeping spring 20 N/m"; }

 private:
  glm::dvec2 rest_{0.0};
};

}  // namespace

TEST_CASE("replay: the drive of these tests contains everything it is meant to contain") {
  std::set<haptics::GuardState> guards;
  std::set<haptics::GuardFault> faults;
  std::set<int> gears;
  std::uint64_t contacts = 0;
  for (const haptics::TraceSample& sample : recorded_trace().samples) {
    guards.insert(sample.out.guard);
    faults.insert(sample.out.fault);
    gears.insert(sample.out.gear);
    contacts += sample.out.flags & haptics::kFlagContact ? 1 : 0;
  }
  CHECK(recorded_trace().samples.size() == RecordedDrive::kCycles);
  CHECK(guards.count(haptics::GuardState::idle) + guards.count(haptics::GuardState::running) +
            guards.count(haptics::GuardState::damped) ==
        3);
  CHECK(guards.count(haptics::GuardState::released) == 1);
  CHECK(faults.count(haptics::GuardFault::stale_reading) == 1);
  CHECK(recorded_trace().samples[3300].out.fault == haptics::GuardFault::stopped);
  CHECK(recorded_trace().samples[3319].out.guard == haptics::GuardState::released);
  CHECK(recorded_trace().samples[3700].out.guard == haptics::GuardState::running);
  CHECK(gears.size() >= 3);
  CHECK(contacts > 500);
}

TEST_CASE("replay: a recorded drive replays bit for bit from its inputs alone") {
  const haptics::ReplayResult result = replay(recorded_trace());
  CHECK(result.bit_for_bit());
  CHECK_FALSE(result.first.has_value());
  CHECK(result.cycles == RecordedDrive::kCycles);
  CHECK(result.replayed_hash == recorded_trace().hash);
  CHECK(result.seconds == doctest::Approx(4.012).epsilon(1e-12));  // 4000 periods of 1 ms, plus 12 missed deadlines
}

TEST_CASE("replay: running the same drive twice gives the same hash") {
  const TempFolder folder;
  RecordedDrive drive;
  CHECK(drive.record(folder / "again.trace").hash == recorded_trace().hash);
}

TEST_CASE("replay: the hash covers every parameter, down to its lowest bit") {
  haptics::TraceHeader header = recorded_trace().header;
  const std::uint64_t plain = haptics::begin_hash(header).value();
  const auto check = [&](const std::string& name, double& value) {
    CAPTURE(name);
    const double before = value;
    flip_lowest_bit(value);
    CHECK(haptics::begin_hash(header).value() != plain);
    value = before;
  };
  each_double(header.config, "", check);
  each_double(header.device, "", check);
  CHECK(haptics::begin_hash(header).value() == plain);
  header.device.delay += 1;
  CHECK(haptics::begin_hash(header).value() != plain);
  header.device.delay -= 1;
  header.config.guard.overruns_in_row += 1;
  CHECK(haptics::begin_hash(header).value() != plain);
}

TEST_CASE("replay: a changed parameter that affects no output still breaks the replay") {
  Trace trace = recorded_trace();
  flip_lowest_bit(trace.header.config.ghost_offset);
  const haptics::ReplayResult result = replay(trace);
  CHECK_FALSE(result.first.has_value());
  CHECK_FALSE(result.bit_for_bit());
}

// These parameters are only compared with other values, or rounded to whole nanoseconds or cycles, so their last bit
// almost never changes an output. The hash covers them anyway (see the test case above).
const std::set<std::string> only_compared = {
    "rate",
    "estimator.speed_limit",
    "guard.stale_time",
    "guard.position_margin",
    "over_push.warn_above",
    "over_push.clear_below",
    "gear_debounce",
    "ghost_offset",
};

TEST_CASE("replay: the lowest bit of every parameter that makes a force changes an output") {
  for (const std::string& name : names_of_doubles(recorded_trace().header.config)) {
    if (only_compared.count(name) != 0) continue;
    CAPTURE(name);
    Trace trace = recorded_trace();
    const haptics::HapticConfig before = trace.header.config;
    flip(trace.header.config, name);
    // Every recorded cycle also contains the tuning. The bit is flipped there, too, because otherwise the tuning itself
    // could be the first field that differs, instead of an output.
    for (haptics::TraceSample& sample : trace.samples) {
      haptics::HapticConfig as_sampled = before;
      as_sampled.tuning = sample.tuning;
      flip(as_sampled, name);
      sample.tuning = as_sampled.tuning;
    }
    const haptics::ReplayResult result = replay(trace);
    REQUIRE(result.first.has_value());
    CHECK(result.first->field.find("out.") == 0);
  }
}

TEST_CASE("replay: names the first cycle and field that differ, with both values") {
  SUBCASE("an input changed") {
    Trace trace = recorded_trace();
    flip_lowest_bit(trace.samples[1234].reading.position.y);
    const haptics::ReplayResult result = replay(trace);
    REQUIRE(result.first.has_value());
    CHECK(result.first->cycle == 1234);
    CHECK(result.first->field == "out.lever.y");
    CHECK(result.first->recorded != result.first->replayed);
    CHECK(result.cycles == 1235);
  }
  SUBCASE("an output changed") {
    Trace trace = recorded_trace();
    trace.samples[7].out.commanded.x = 12.5;
    const haptics::ReplayResult result = replay(trace);
    REQUIRE(result.first.has_value());
    CHECK(result.first->cycle == 7);
    CHECK(result.first->field == "out.commanded.x");
    CHECK(result.first->recorded == "12.5");
  }
  SUBCASE("a command lost") {
    Trace trace = recorded_trace();
    trace.samples[2600].command = haptics::LoopCommand::none;
    const haptics::ReplayResult result = replay(trace);
    REQUIRE(result.first.has_value());
    CHECK(result.first->cycle == 2600);
  }
  SUBCASE("never armed") {
    Trace trace = recorded_trace();
    trace.header.armed = false;
    const haptics::ReplayResult result = replay(trace);
    REQUIRE(result.first.has_value());
    CHECK(result.first->cycle == 0);
    CHECK(result.first->field == "out.commanded.x");
    CHECK(result.first->replayed == "0");
  }
  SUBCASE("another gate") {
    Trace trace = recorded_trace();
    const std::string key = "detent_force_n = 6";
    trace.header.gate_text.replace(trace.header.gate_text.find(key), key.size(), "detent_force_n = 7");
    const haptics::ReplayResult result = replay(trace);
    REQUIRE(result.first.has_value());
    CHECK(result.first->field == "out.feel_force.y");
  }
  SUBCASE("a deadline skipped that was not") {
    Trace trace = recorded_trace();
    trace.samples[2005].skipped = 0;
    CHECK_FALSE(replay(trace).bit_for_bit());
  }
}

TEST_CASE("replay: a load with memory replays, and only that load") {
  const TempFolder folder;
  CreepingSpring spring;
  RecordedDrive drive(&spring);
  drive.record(folder / "drive.trace");
  const Trace trace = read_trace(folder / "drive.trace");
  CHECK(trace.hash != recorded_trace().hash);

  const auto make_spring = [](const std::string& name, const haptics::Gate&) -> std::unique_ptr<haptics::LeverLoad> {
    auto load = std::make_unique<CreepingSpring>();
    return name == load->replay_parameters() ? std::move(load) : nullptr;
  };
  CHECK(replay(trace, make_spring).bit_for_bit());
  CHECK(contains(refusal(trace), "the lever load \"creeping spring 20 N/m\" is not known to this program"));
}

TEST_CASE("replay: a trace that cannot be replayed is refused in one sentence") {
  Trace trace = recorded_trace();
  SUBCASE("began in the middle") {
    trace.samples.erase(trace.samples.begin(), trace.samples.begin() + 500);
    CHECK(contains(refusal(trace), "recording began in the middle of a run, at cycle 500"));
  }
  SUBCASE("a rate that is no number") {
    trace.header.config.rate = std::numeric_limits<double>::quiet_NaN();
    CHECK(contains(refusal(trace), "cannot be replayed, because loop.rate_hz"));
  }
  SUBCASE("a device that is no number") {
    trace.header.device.axis_x.mass = std::numeric_limits<double>::infinity();
    CHECK(contains(refusal(trace), "device.axis_x.mass_kg = inf"));
    trace.header.device.axis_x.mass = -std::numeric_limits<double>::quiet_NaN();
    CHECK(contains(refusal(trace), "device.axis_x.mass_kg = -nan"));
  }
  SUBCASE("a device that acts before the command") {
    trace.header.device.delay = -1;
    CHECK(contains(refusal(trace), "delay of the device = -1"));
  }
  SUBCASE("a layout that is none") {
    trace.header.gate_text = "name = 5";
    CHECK(contains(refusal(trace), "its gate is invalid: paper.toml:1"));
  }
  SUBCASE("a layout beyond the device") {
    trace.header.device.workspace = {0.01, 0.01};
    CHECK(contains(refusal(trace), "its gate is invalid: paper.toml"));
  }
}

TEST_CASE(
    "replay: a drive on a real-time thread, recorded beside it, comes out bit for bit, late cycles "
    "included") {
  constexpr std::uint64_t kEnough = 300;
  const TempFolder folder;
  haptics::SimulatedLeverConfig lever_config;
  lever_config.hand = haptics::kGripHand;
  const haptics::Gate gate = paper_gate();
  const int gears[] = {1, 2};
  haptics::ScriptedHand hand(haptics::touring_hand({0.0, 0.0}), haptics::shift_strokes(gate, {0.0, 0.0}, gears), 0.001);
  haptics::SimulatedLever lever(lever_config, 1'000'000, hand);
  haptics::NoLoad load;
  haptics::LoopInputs inputs;
  haptics::TraceHeader header = paper_header();
  header.config = haptics::HapticConfig{};
  header.device = lever.spec();
  header.armed = false;
  haptics::HapticLoop loop(header.config, gate, lever, load, inputs);

  haptics::TraceRecorder recorder(folder / "live.trace", header);
  haptics::Broadcast<haptics::TraceSample> cycles(8192);
  haptics::Broadcast<haptics::TraceSample>::Reader reader(cycles);
  haptics::RealtimeThread thread;
  std::promise<void> enough;
  thread.start({}, [&](const haptics::CycleCall& call) {
    loop.cycle(call.deadline_ns, call.skipped);
    cycles.push(loop.published());
    if (loop.snapshot().cycle == kEnough) enough.set_value();
  });
  REQUIRE(inputs.commands.push(haptics::LoopCommand::arm));  // arms the loop while it runs, as a user does
  enough.get_future().wait();
  thread.stop();
  for (haptics::TraceSample cycle; reader.pop(cycle);) recorder.add(cycle);
  const haptics::RecordingResult recorded = recorder.finish();
  CHECK(recorded.problem.empty());
  CHECK(recorded.cycles >= kEnough);
  const haptics::ReplayResult result = replay(read_trace(folder / "live.trace"));
  CHECK(result.bit_for_bit());
  CHECK(result.replayed_hash == recorded.hash);
}

}  // namespace gearshift::test
