// Tests, byte by byte, the reports that are sent before and after streaming. Also checks that known deviations of real
// sticks from the PID specification are tolerated. The expected lines were derived by hand from the devices' report
// descriptors (tests/data/hid; its README.md names the sources). In a line, `set` means SET_REPORT(feature), `get`
// means GET_REPORT(feature) and `out` means an output report. The report ID comes first; numbers are little-endian.
#include "haptics/hardware/pid_setup.h"

#include <chrono>
#include <deque>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/haptics/device/still_hand.h"
#include "tests/haptics/hardware/stick_bench.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

using Lines = std::vector<std::string>;

struct SetupResult {
  PidAbility ability;
  Lines before, after;
  std::string error;  // message of the exception from PidDriver::prepare(); empty: none
};

SetupResult prepared(const EmulatedStickConfig& config, const EmulatedFaults& faults = {}) {
  StillHand hand;
  StickBench bench(config, hand);
  bench.stick.faults = faults;
  SetupResult result;
  try {
    result.ability = bench.driver.prepare(bench.port);
  } catch (const HidError& error) {
    result.error = error.what();
  }
  result.before = bench.lines();
  bench.stick.log.clear();
  bench.driver.finish(bench.port);
  result.after = bench.lines();
  CHECK_FALSE(bench.stick.actuators_on());
  CHECK(bench.stick.playing() == 0);
  return result;
}

EmulatedStickConfig stick_of(StickFamily family) {
  EmulatedStickConfig config;
  config.family = family;
  return config;
}

}  // namespace

// The bytes of Set Effect (report 0x01) after its ID: block, type (constant 1, spring 8, damper 9), duration of 300 ms
// (0x012C), trigger repeat, sample period, gain 0xFF, trigger button, axes (X 1, Y 2, direction 4), both directions
// (0x40 is 90 degrees, 0x80 is 180 degrees). Conditions (report 0x03) start with coefficients 0, full saturation and no dead
// band. Created blocks are numbered from 2, because block 1 is the device's own spring.
TEST_CASE("SideWinder Force Feedback 2: every byte before the first force") {
  const SetupResult result = prepared(stick_of(StickFamily::sidewinder));
  CHECK(result.before == Lines{"get 03 e0 04 27 01",  // memory pool: 1248 bytes, 39 effects
                               "out 0c 03",           // stop all
                               "out 0c 04",           // reset
                               "out 0c 03",           // stop all, the centring spring too
                               "out 0c 02",           // actuators off
                               "out 0d 00",           // gain
                               "set 01 01 00 00",
                               "get 02 02 01 c0 04",                                   // constant: block 2
                               "out 05 02 12 00",                                      // a slight magnitude
                               "out 01 02 01 2c 01 00 00 00 00 ff ff 04 40 40 00 00",  // X, 90 degrees
                               "out 05 02 00 00",                                      //
                               "get 02 02 01 c0 04",                                   // no error: duration accepted
                               "set 01 01 00 00",
                               "get 02 03 01 a0 04",                                   // constant: block 3
                               "out 05 03 12 00",                                      //
                               "out 01 03 01 2c 01 00 00 00 00 ff ff 04 80 80 00 00",  // Y, 180 degrees
                               "out 05 03 00 00",                                      //
                               "set 01 08 00 00",
                               "get 02 04 01 80 04",                                   // spring: block 4
                               "out 03 04 00 00 01 01 03 03 00",                       // X: a slight coefficient
                               "out 03 04 01 00 01 01 03 03 00",                       // Y
                               "out 01 04 08 2c 01 00 00 00 00 ff ff 03 40 40 00 00",  // X and Y
                               "out 03 04 00 00 00 00 ff ff 00",                       // X: coefficients 0
                               "out 03 04 01 00 00 00 ff ff 00",                       // Y: coefficients 0
                               "set 01 09 00 00",
                               "get 02 05 01 60 04",                                   // damper: block 5
                               "out 03 05 00 00 01 01 03 03 00",                       // X: a slight coefficient
                               "out 03 05 01 00 01 01 03 03 00",                       // Y
                               "out 01 05 09 2c 01 00 00 00 00 ff ff 03 40 40 00 00",  //
                               "out 03 05 00 00 00 00 ff ff 00",                       //
                               "out 03 05 01 00 00 00 ff ff 00",                       //
                               "out 0c 02",                                            // actuators off
                               "out 0d ff"});                                          // full gain
  CHECK(result.after == Lines{"out 0a 02 03 00", "out 0a 03 03 00", "out 0a 04 03 00", "out 0a 05 03 00",  // stop each
                              "out 0c 03", "out 0c 02",                            // stop all, actuators off
                              "out 0b 02", "out 0b 03", "out 0b 04", "out 0b 05",  // free the blocks
                              "out 0c 04", "out 0c 03", "out 0c 02"});             // reset, all off again
  CHECK(result.ability.spring);
  CHECK(result.ability.damper);
  CHECK(result.ability.finite);
  CHECK(result.ability.blocks == 4);
  CHECK(result.ability.notes.empty());
}

// On the OpenFFBoard, Device Control (report 0x0C) has one bit per command: off 0x02, stop all 0x04, reset 0x08. Set
// Effect (report 0x01) has the start delay before the gain, 2-byte directions of 0 to 36000 (9000 = 0x2328, 18000 =
// 0x4650), and two type-specific offsets at its end. The maximum saturation is 0x7FFF.
TEST_CASE("OpenFFBoard: the same sequence, with bits and other fields") {
  const SetupResult result = prepared(stick_of(StickFamily::openffboard));
  CHECK(result.before == Lines{"get 13 00 05 28 01",  //
                               "out 0c 04",
                               "out 0c 08",
                               "out 0c 04",
                               "out 0c 02",
                               "out 0d 00",
                               "set 11 01 00 00",
                               "get 12 01 01 e0 04",
                               "out 05 01 f6 08",
                               "out 01 01 01 2c 01 00 00 00 00 00 00 ff ff 04 28 23 28 23 00 00 00 00",
                               "out 05 01 00 00",
                               "get 12 01 01 e0 04",
                               "set 11 01 00 00",
                               "get 12 02 01 c0 04",
                               "out 05 02 f6 08",
                               "out 01 02 01 2c 01 00 00 00 00 00 00 ff ff 04 50 46 50 46 00 00 00 00",
                               "out 05 02 00 00",
                               "set 11 08 00 00",
                               "get 12 03 01 a0 04",
                               "out 03 03 00 00 00 48 01 48 01 48 01 48 01 00 00",
                               "out 03 03 01 00 00 48 01 48 01 48 01 48 01 00 00",
                               "out 01 03 08 2c 01 00 00 00 00 00 00 ff ff 03 28 23 28 23 00 00 00 00",
                               "out 03 03 00 00 00 00 00 00 00 ff 7f ff 7f 00 00",
                               "out 03 03 01 00 00 00 00 00 00 ff 7f ff 7f 00 00",
                               "set 11 09 00 00",
                               "get 12 04 01 80 04",
                               "out 03 04 00 00 00 48 01 48 01 48 01 48 01 00 00",
                               "out 03 04 01 00 00 48 01 48 01 48 01 48 01 00 00",
                               "out 01 04 09 2c 01 00 00 00 00 00 00 ff ff 03 28 23 28 23 00 00 00 00",
                               "out 03 04 00 00 00 00 00 00 00 ff 7f ff 7f 00 00",
                               "out 03 04 01 00 00 00 00 00 00 ff 7f ff 7f 00 00",
                               "out 0c 02",  // off again, because Set Effect switched the actuators on
                               "out 0d ff"});
  CHECK(result.after == Lines{"out 0a 01 03 00", "out 0a 02 03 00", "out 0a 03 03 00", "out 0a 04 03 00", "out 0c 04",
                              "out 0c 02", "out 0b 01", "out 0b 02", "out 0b 03", "out 0b 04", "out 0c 08", "out 0c 04",
                              "out 0c 02"});
}

// vJoy's report IDs start at 0x11, and its Device Control is a command number. A full turn is 0x7FFF, so 90 degrees are
// 0x2000 and 180 degrees are 0x4000. The maximum saturation is 10000 (0x2710).
TEST_CASE("vJoy: the same sequence, with other IDs") {
  const SetupResult result = prepared(stick_of(StickFamily::vjoy));
  CHECK(result.before == Lines{"get 13 80 0c 64 01",
                               "out 1c 03",
                               "out 1c 04",
                               "out 1c 03",
                               "out 1c 02",
                               "out 1d 00",
                               "set 11 01 00 00",
                               "get 12 01 01 60 0c",
                               "out 15 01 bc 02",
                               "out 11 01 01 2c 01 00 00 00 00 00 00 ff ff 04 00 20 00 20 00 00 00 00",
                               "out 15 01 00 00",
                               "get 12 01 01 60 0c",
                               "set 11 01 00 00",
                               "get 12 02 01 40 0c",
                               "out 15 02 bc 02",
                               "out 11 02 01 2c 01 00 00 00 00 00 00 ff ff 04 00 40 00 40 00 00 00 00",
                               "out 15 02 00 00",
                               "set 11 08 00 00",
                               "get 12 03 01 20 0c",
                               "out 13 03 00 00 00 64 00 64 00 64 00 64 00 00 00",
                               "out 13 03 01 00 00 64 00 64 00 64 00 64 00 00 00",
                               "out 11 03 08 2c 01 00 00 00 00 00 00 ff ff 03 00 20 00 20 00 00 00 00",
                               "out 13 03 00 00 00 00 00 00 00 10 27 10 27 00 00",
                               "out 13 03 01 00 00 00 00 00 00 10 27 10 27 00 00",
                               "set 11 09 00 00",
                               "get 12 04 01 00 0c",
                               "out 13 04 00 00 00 64 00 64 00 64 00 64 00 00 00",
                               "out 13 04 01 00 00 64 00 64 00 64 00 64 00 00 00",
                               "out 11 04 09 2c 01 00 00 00 00 00 00 ff ff 03 00 20 00 20 00 00 00 00",
                               "out 13 04 00 00 00 00 00 00 00 10 27 10 27 00 00",
                               "out 13 04 01 00 00 00 00 00 00 10 27 10 27 00 00",
                               "out 1c 02",
                               "out 1d ff"});
  CHECK(result.after == Lines{"out 1a 01 03 00", "out 1a 02 03 00", "out 1a 03 03 00", "out 1a 04 03 00", "out 1c 03",
                              "out 1c 02", "out 1b 01", "out 1b 02", "out 1b 03", "out 1b 04", "out 1c 04", "out 1c 03",
                              "out 1c 02"});
}

TEST_CASE("a device that refuses a duration gets endless effects, and a note says so") {
  for (const StickFamily family : kStickFamilies) {
    CAPTURE(name_of(family));
    EmulatedStickConfig config = stick_of(family);
    config.finite_refused = true;
    const SetupResult result = prepared(config);
    CHECK(result.error.empty());
    CHECK_FALSE(result.ability.finite);
    CHECK(result.ability.notes == Lines{"the stick's effects do not end by themselves; if this program crashes, unplug "
                                        "the stick to stop the last force"});
  }
}

TEST_CASE("effects that do not fit into the pool are left out, except constant forces") {
  for (const StickFamily family : kStickFamilies) {
    CAPTURE(name_of(family));
    EmulatedStickConfig config = stick_of(family);
    config.blocks = 3;
    const SetupResult three = prepared(config);
    CHECK(three.ability.spring);
    CHECK_FALSE(three.ability.damper);
    CHECK(three.ability.blocks == 3);
    CHECK(three.ability.notes ==
          Lines{"the stick is used without a damper; a damper cannot be created, because the stick's memory "
                "for effects is full; unplug it and plug it in again"});
    config.blocks = 2;
    CHECK(prepared(config).ability.notes.size() == 2);
    config.blocks = 1;
    CHECK(prepared(config).error ==
          "a constant force cannot be created, because the stick's memory for effects is full; unplug it and plug it "
          "in again");
  }
}

TEST_CASE("a device that refuses every effect is refused in one sentence, and silenced") {
  for (const StickFamily family : kStickFamilies) {
    EmulatedFaults faults;
    faults.refuses_effects = true;
    CHECK(prepared(stick_of(family), faults).error ==
          "a constant force cannot be created, because the stick reports an error");
    faults = {};
    faults.pool_full = true;
    CHECK(prepared(stick_of(family), faults).error ==
          "a constant force cannot be created, because the stick's memory for effects is full; unplug it and plug it "
          "in again");
    faults = {};
    faults.stalls_outputs = true;
    CHECK_FALSE(prepared(stick_of(family), faults).error.empty());
  }
}

TEST_CASE("a slow device is waited for") {
  EmulatedFaults faults;
  faults.slow = 0.003;
  const SetupResult result = prepared(stick_of(StickFamily::vjoy), faults);
  CHECK(result.error.empty());
  CHECK(result.ability.blocks == 4);
}

namespace {

// A port that returns scripted answers and records the requests.
class ScriptedPort final : public HidPort {
 public:
  const HidIdentity& identity() const noexcept override { return identity_; }
  const std::vector<std::uint8_t>& report_descriptor() const noexcept override { return descriptor_; }
  HidBytes get_feature(std::uint8_t id, std::size_t size) override {
    ++gets;
    if (loads_.empty()) throw HidError("no answer");
    HidBytes answer;
    answer.size = size;
    answer.bytes = {id, loads_.front().first, loads_.front().second};
    if (loads_.size() > 1) loads_.pop_front();
    return answer;
  }
  void set_feature(const HidBytes& report) override { sent.push_back(report.id()); }
  void send(const HidBytes& report) override {
    if (disconnect_after-- == 0) throw HidDisconnected("gone");
    sent.push_back(report.id());
  }
  void stream(const StreamConfig&, HidStream&) override {}

  // Appends an answer to the script of get_feature(). The last answer is repeated.
  void answer(int block, int status) {
    loads_.push_back({static_cast<std::uint8_t>(block), static_cast<std::uint8_t>(status)});
  }

  int gets = 0, disconnect_after = -1;
  std::vector<int> sent;

 private:
  std::deque<std::pair<std::uint8_t, std::uint8_t>> loads_;
  HidIdentity identity_;
  std::vector<std::uint8_t> descriptor_;
};

PidLayout vjoy_layout() {
  StillHand hand;
  return PidDriver(EmulatedStick(stick_of(StickFamily::vjoy), hand).report_descriptor()).layout();
}

}  // namespace

TEST_CASE("block load is polled until it has an answer, up to 60 times") {
  PidLayout pid = vjoy_layout();
  pid.pool = {};
  ScriptedPort patient;
  for (int i = 0; i < 7; ++i) patient.answer(0, 0);                  // no status yet
  for (const int block : {1, 1, 2, 3, 4}) patient.answer(block, 1);  // block 1 is reported twice, which is no error
  CHECK(prepare_stick(patient, pid).blocks == StickBlocks{1, 2, 3, 4});
  CHECK(patient.gets == 12);

  ScriptedPort silent;
  silent.answer(0, 0);
  CHECK_THROWS_WITH_AS(prepare_stick(silent, pid),
                       "a constant force cannot be created, because the stick does not confirm the effect", HidError);
  CHECK(silent.gets == 60);

  ScriptedPort faulty;
  faulty.answer(7, 1);  // assigns block 7 to every effect
  CHECK_THROWS_WITH_AS(prepare_stick(faulty, pid), "the stick assigned effect block 7 twice; this stick cannot be used",
                       HidError);
  ScriptedPort blockless;
  blockless.answer(0, 1);
  CHECK_THROWS_WITH_AS(prepare_stick(blockless, pid),
                       "a constant force cannot be created, because the stick assigns no effect block", HidError);
}

TEST_CASE("reports that a device lacks are left out") {
  const PidLayout complete = vjoy_layout();
  const auto prepared_with = [](const PidLayout& pid, ScriptedPort& port) { return prepare_stick(port, pid); };

  ScriptedPort port;  // answers nothing
  PidLayout pid = complete;
  pid.create = {};
  pid.block_load = {};
  const PreparedStick fixed = prepared_with(pid, port);
  CHECK(fixed.blocks == StickBlocks{1, 2, 3, 4});
  CHECK(fixed.ability.notes == Lines{"the stick does not report how many effects it can store"});

  pid = complete;
  pid.block_load = {};
  CHECK(prepared_with(pid, port).blocks == StickBlocks{1, 2, 3, 4});

  pid.pool = {};
  pid.set_condition = {};
  pid.gain = {};
  pid.block_free = {};
  const PreparedStick bare = prepared_with(pid, port);
  CHECK(bare.blocks == StickBlocks{1, 2, 0, 0});
  CHECK(bare.ability.notes == Lines{"the stick has no spring effect", "the stick has no damper effect"});

  pid.device_control = {};
  port.sent.clear();
  CHECK(prepared_with(pid, port).ability.notes.size() == 4);
  // For each of the two axes: create the effect, set the magnitude, the effect, and the magnitude again.
  CHECK(port.sent == std::vector<int>{0x11, 0x15, 0x11, 0x15, 0x11, 0x15, 0x11, 0x15});
}

TEST_CASE("unplugged at any moment of the setup: HidDisconnected, and nothing more is sent") {
  const PidLayout pid = vjoy_layout();
  int outputs = 0;
  for (bool has_completed = false; !has_completed; ++outputs) {
    ScriptedPort port;
    for (const int block : {9, 1, 1, 2, 3, 4}) port.answer(block, 1);
    port.disconnect_after = outputs;
    try {
      prepare_stick(port, pid);
      has_completed = true;
    } catch (const HidDisconnected&) {
      CHECK(port.disconnect_after == -1);
    }
  }
  // The setup has 23 outputs: 5 clear the stick, 3 + 3 + 5 + 5 set the four effects, 2 finish. Each output fails in one
  // round; the 24th round has no failure.
  CHECK(outputs == 24);
  ScriptedPort disconnected;
  disconnected.disconnect_after = 0;
  silence_stick(disconnected, pid, {1, 2, 3, 4});
  CHECK(disconnected.disconnect_after == -1);
}

namespace {

// Loses the first reports.
class LossyPort final : public StickPort {
 public:
  using StickPort::StickPort;
  void send(const HidBytes& report) override {
    ++sent;
    if (losses-- > 0) throw HidError("the stick did not answer");
    StickPort::send(report);
  }
  int losses = 0, sent = 0;
};

}  // namespace

TEST_CASE("the last reports are lost: repeated until the motors are off, for a second at most") {
  for (const StickFamily family : kStickFamilies) {
    for (const int losses : {0, 1, 3, 6, 7, 12, 13, 40}) {
      CAPTURE(name_of(family));
      CAPTURE(losses);
      EmulatedStickConfig config;
      config.family = family;
      StillHand hand;
      StickBench bench(config, hand);
      bench.prepare();
      bench.tick_for(0.2, pushing(0.5, 0.5));
      REQUIRE(bench.stick.actuators_on());
      LossyPort port(bench.stick, bench.mutex, bench.plugged);
      port.losses = losses;
      bench.driver.finish(port);
      CHECK_FALSE(bench.stick.actuators_on());
      CHECK(bench.stick.force() == glm::dvec2(0.0));
    }
  }
  EmulatedStickConfig config;
  StillHand hand;
  StickBench bench(config, hand);
  bench.prepare();
  LossyPort deaf(bench.stick, bench.mutex, bench.plugged);
  deaf.losses = 1'000'000;
  const auto begin = std::chrono::steady_clock::now();
  bench.driver.finish(deaf);
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(1300));
  CHECK(deaf.sent > 100);
  LossyPort gone(bench.stick, bench.mutex, bench.plugged);
  bench.plugged = false;
  bench.driver.finish(gone);
  CHECK(gone.sent == 1);
}
