// The port to an emulated stick meets the contract of haptics/hid/hid_port.h.
#include "tests/support/stick/stick_port.h"

#include <vector>

#include <doctest/doctest.h>

using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

constexpr std::int64_t kPortMs = 1'000'000;

HidBytes report(std::initializer_list<std::uint8_t> bytes) {
  HidBytes result;
  for (std::uint8_t byte : bytes) result.bytes[result.size++] = byte;
  return result;
}

struct Listener final : HidStream {
  void on_input(std::span<const std::uint8_t> bytes, std::int64_t time_ns) noexcept override {
    if (bytes[0] != 1) return;  // ignores state reports
    ++inputs;
    last_input_ns = time_ns;
  }
  HidBytes next_output(std::int64_t now_ns) noexcept override {
    polled_ns.push_back(now_ns);
    return output;
  }
  void on_sent(std::int64_t time_ns) noexcept override { sent_ns.push_back(time_ns); }
  bool should_end() const noexcept override { return sent_ns.size() >= 20; }

  HidBytes output;
  int inputs = 0;
  std::int64_t last_input_ns = 0;
  std::vector<std::int64_t> polled_ns, sent_ns;
};

struct PortRig {
  explicit PortRig(const EmulatedStickConfig& config) : stick(config, hand), port(stick, mutex, plugged) {}

  IdleHand hand;
  std::mutex mutex;
  std::atomic<bool> plugged{true};
  EmulatedStick stick;
  StickPort port;
};

EmulatedStickConfig port_stick(StickFamily family) {
  EmulatedStickConfig config;
  config.family = family;
  return config;
}

}  // namespace

TEST_CASE("identity, features and outputs, by a pipe or by SET_REPORT") {
  PortRig board(port_stick(StickFamily::openffboard));
  CHECK(board.port.identity().vendor == 0x1209);
  CHECK(board.port.identity().product == 0xffb0);
  CHECK(board.port.identity().name == "FFBoard");
  CHECK(board.port.identity().serial == "EMULATED01");
  CHECK(board.port.report_descriptor().size() == 1215);
  board.port.set_feature(report({0x11, 1, 0, 0}));
  const HidBytes load = board.port.get_feature(0x12, 5);
  CHECK(load.size == 5);
  CHECK(load.bytes[2] == 1);
  board.port.send(report({0x0C, 1}));
  CHECK(board.stick.actuators_on());

  PortRig feeder(port_stick(StickFamily::vjoy));
  feeder.port.send(report({0x1C, 1}));
  CHECK(feeder.stick.actuators_on());
}

TEST_CASE("a failed request throws HidError, an unplugged stick HidDisconnected") {
  PortRig rig(port_stick(StickFamily::sidewinder));
  CHECK_THROWS_AS(rig.port.get_feature(0x7E, 5), HidError);
  CHECK_THROWS_AS(rig.port.set_feature(report({0x7E, 1})), HidError);
  rig.stick.faults.stalls_outputs = true;
  CHECK_THROWS_AS(rig.port.send(report({0x0C, 1})), HidError);
  rig.stick.faults = {};
  rig.stick.faults.slow = 1.0;
  CHECK_THROWS_AS(rig.port.get_feature(0x03, 5), HidError);
  rig.plugged = false;
  Listener listener;
  CHECK_THROWS_AS(rig.port.get_feature(0x03, 5), HidDisconnected);
  CHECK_THROWS_AS(rig.port.send(report({0x0C, 1})), HidDisconnected);
  CHECK_THROWS_AS(rig.port.stream({}, listener), HidDisconnected);
}

TEST_CASE("a tick delivers a report and sends an output; a silent stick is polled, a dead one is an error") {
  EmulatedStickConfig config = port_stick(StickFamily::sidewinder);
  config.reports_only_changes = true;
  PortRig rig(config);
  Listener listener;
  StreamConfig stream;
  stream.lever_report = 1;
  listener.output = report({0x0C, 1});
  for (std::int64_t now = 0; now <= 100 * kPortMs; now += kPortMs) tick_stick(rig.stick, stream, listener, now);
  CHECK(listener.sent_ns.size() == 101);
  CHECK(rig.stick.actuators_on());
  CHECK(listener.inputs == 1 + 12);  // the stick's own report at 1 ms, then an answer to GET_REPORT every 8 ms
  CHECK(listener.last_input_ns == 97 * kPortMs);
  rig.stick.faults.silent = true;
  std::int64_t now = 101 * kPortMs;
  const auto tick_on = [&] {
    for (; now < 400 * kPortMs; now += kPortMs) tick_stick(rig.stick, stream, listener, now);
  };
  CHECK_THROWS_AS(tick_on(), HidError);
  CHECK(now == (97 + 250) * kPortMs);
}

TEST_CASE("a stream waits at least one tick between outputs, and ends on request") {
  PortRig rig(port_stick(StickFamily::openffboard));
  Listener listener;
  StreamConfig stream;
  stream.lever_report = 1;
  listener.output = report({0x0C, 1});
  rig.port.stream(stream, listener);
  CHECK(listener.sent_ns.size() == 20);
  CHECK(listener.inputs > 0);
  for (std::size_t i = 1; i < 20; ++i) CHECK(listener.sent_ns[i] - listener.sent_ns[i - 1] >= kPortMs);
}
