// Tests of StickConnection with its own thread and the real clock: it reconnects after any interruption, and never
// switches forces on by itself. Run these tests under the thread sanitizer.
#include "haptics/hardware/stick_connection.h"

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/hardware/pid_lever.h"
#include "haptics/rt/realtime_scope.h"
#include "tests/haptics/device/still_hand.h"
#include "tests/haptics/hardware/calibrated.h"
#include "tests/support/stick/stick_port.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using glm::dvec2;

namespace {

using Lines = std::vector<std::string>;

constexpr const char* kName = "SideWinder Force Feedback 2 Joystick";

EmulatedStickConfig gripped() {
  EmulatedStickConfig config;
  config.lever.hand = kGripHand;
  return config;
}

// A stick that can be unplugged, and its connection.
struct ConnectedStick {
  explicit ConnectedStick(const std::function<void()>& before_open = [] {})
      : stick(gripped(), hand), driver(stick.report_descriptor()), before(before_open) {}

  void connect() {
    connection = std::make_unique<StickConnection>(
        driver,
        [this]() -> std::unique_ptr<HidPort> {
          before();
          if (!plugged) throw HidDisconnected("the stick 045e:001b is not plugged in");
          return std::make_unique<StickPort>(stick, mutex, plugged);
        },
        1'000'000);
  }
  void unplug() {
    plugged = false;
    const std::lock_guard lock(mutex);
    stick.unplug();
  }
  dvec2 force() {
    const std::lock_guard lock(mutex);
    return stick.force();
  }
  bool is_off() {
    const std::lock_guard lock(mutex);
    return stick.force() == dvec2(0.0) && stick.playing() == 0;
  }
  Lines messages() const {
    Lines all;
    while (const auto sentence = connection->take_message()) all.push_back(*sentence);
    return all;
  }

  StillHand hand;
  EmulatedStick stick;
  std::mutex mutex;
  std::atomic<bool> plugged{true};
  PidDriver driver;
  std::function<void()> before;
  std::unique_ptr<StickConnection> connection;
};

// Returns true as soon as the condition holds, or false after five seconds.
bool becomes_true(const std::function<bool()>& what) {
  for (int ms = 0; ms < 5000; ++ms) {
    if (what()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

}  // namespace

TEST_CASE("unplugged and plugged in again 20 times while driving: reconnects each time, with forces off until armed") {
  ConnectedStick rig;
  rig.connect();
  PidLever lever(calibration_of(gripped()), rig.driver, 0.001);
  bool armed = false;
  const auto cycle = [&] {  // one cycle of a loop that disarms when the lever reports a stop
    if (lever.read(0).stop) armed = false;
    lever.write(armed ? dvec2{5.0, 0.0} : dvec2(0.0));
  };
  for (int time = 0; time < 20; ++time) {
    REQUIRE(becomes_true([&] { return rig.connection->connected(); }));
    for (int ms = 0; ms < 20; ++ms) {
      cycle();
      CHECK(rig.force() == dvec2(0.0));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    armed = true;
    REQUIRE(becomes_true([&] {
      cycle();
      return glm::length(rig.force()) > 4.0;
    }));
    rig.unplug();
    CHECK(rig.force() == dvec2(0.0));
    REQUIRE(becomes_true([&] {
      cycle();
      return !rig.connection->connected();
    }));
    if (time % 2 == 0) cycle();
    rig.plugged = true;
  }
  REQUIRE(becomes_true([&] { return rig.connection->connected(); }));
  Lines expected;
  for (int time = 0; time < 20; ++time) {
    expected.push_back(std::string(kName) + " was unplugged, so its motors are off");
    expected.push_back(std::string(kName) + " is connected again; its motors are still off");
  }
  CHECK(rig.messages() == expected);
  CHECK(rig.connection->ability()->spring);
}

TEST_CASE("destroying the connection switches the motors off, at any moment") {
  for (const int ms : {0, 1, 3, 10, 60}) {
    ConnectedStick rig;
    rig.connect();
    PidLever lever(calibration_of(gripped()), rig.driver, 0.001);
    for (int i = 0; i < ms; ++i) {
      lever.read(0);
      lever.write({5.0, 0.0});
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    rig.connection.reset();
    CHECK(rig.is_off());
    rig.connect();  // the driver must be able to connect again
    CHECK(becomes_true([&] { return rig.connection->connected(); }));
  }
}

TEST_CASE("a failure to open is reported once and retried: no exception leaves the thread") {
  std::atomic<int> tries{0};
  std::atomic<bool> works{false};
  ConnectedStick rig([&] {
    if (works) return;
    const int turn = tries++ % 4;
    if (turn == 0) throw HidError("the stick may not be used by this user");
    if (turn == 1) throw HidDisconnected("the stick 045e:001b is not plugged in");
    if (turn == 2) throw std::runtime_error("out of everything");
    throw 7;  // NOLINT: an exception that is not a std::exception
  });
  rig.connect();
  REQUIRE(becomes_true([&] { return tries > 5; }));
  works = true;
  REQUIRE(becomes_true([&] { return rig.connection->connected(); }));
  CHECK(rig.messages() == Lines{"the stick may not be used by this user", "the stick 045e:001b is not plugged in",
                                "out of everything", "the stick cannot be used because of an unknown error"});
}

TEST_CASE("a stick that first refuses its effects or outputs is retried until it accepts them") {
  ConnectedStick rig;
  rig.stick.faults.refuses_effects = true;
  rig.connect();
  Lines messages;
  const auto was_reported = [&](const std::string& part) {
    return becomes_true([&] {
      for (const std::string& sentence : rig.messages()) messages.push_back(sentence);
      return !messages.empty() && messages.back().find(part) != std::string::npos;
    });
  };
  CHECK(was_reported("a constant force cannot be created, because the stick reports an error"));
  CHECK_FALSE(rig.connection->ability().has_value());
  {
    const std::lock_guard lock(rig.mutex);
    rig.stick.faults = {};
  }
  REQUIRE(becomes_true([&] { return rig.connection->connected(); }));

  PidLever lever(calibration_of(gripped()), rig.driver, 0.001);
  REQUIRE(becomes_true([&] {
    lever.read(0);
    lever.write({5.0, 0.0});
    return glm::length(rig.force()) > 4.0;
  }));
  {
    const std::lock_guard lock(rig.mutex);
    rig.stick.faults.stalls_outputs = true;
  }
  CHECK(becomes_true([&] { return !rig.connection->connected(); }));
  {
    const std::lock_guard lock(rig.mutex);
    rig.stick.faults = {};
  }
  CHECK(was_reported(std::string(kName) + " is connected again; its motors are still off"));
  CHECK(rig.force() == dvec2(0.0));
  for (const std::string& sentence : messages) CHECK(std::count(messages.begin(), messages.end(), sentence) == 1);
}

// A report to a blocked pipe fails only after 250 ms (180 ms in this test). The time until the failure must not count
// as time in which the stick worked.
TEST_CASE("a slow failure is also reported only once") {
  class Deaf final : public StickPort {
   public:
    using StickPort::StickPort;
    void send(const HidBytes&) override {
      std::this_thread::sleep_for(std::chrono::milliseconds(180));
      throw HidError("the stick did not answer");
    }
  };
  ConnectedStick rig;
  std::atomic<int> opened{0};
  rig.connection = std::make_unique<StickConnection>(
      rig.driver,
      [&] {
        ++opened;
        return std::make_unique<Deaf>(rig.stick, rig.mutex, rig.plugged);
      },
      1'000'000);
  REQUIRE(becomes_true([&] { return opened == 3; }));
  CHECK(rig.messages() == Lines{"the stick did not answer"});
}

// Searching for an absent stick takes milliseconds. A real-time thread would take this time from the haptic loop.
TEST_CASE("the thread is real-time while it streams, if permitted, and not while it looks for the stick") {
  bool allowed = false;
  std::thread([&] { allowed = schedule_fifo(70).empty(); }).join();
  std::atomic<int> opening{-1}, streaming{-1};
  class Watched final : public StickPort {
   public:
    Watched(ConnectedStick& rig, std::atomic<int>& policy)
        : StickPort(rig.stick, rig.mutex, rig.plugged), policy_(policy) {}
    void stream(const StreamConfig& config, HidStream& stream) override {
      policy_ = sched_getscheduler(0) & ~SCHED_RESET_ON_FORK;
      StickPort::stream(config, stream);
    }

   private:
    std::atomic<int>& policy_;
  };
  ConnectedStick rig;
  const auto open = [&] {
    opening = sched_getscheduler(0) & ~SCHED_RESET_ON_FORK;
    if (!rig.plugged) throw HidDisconnected("the stick is not plugged in");
    return std::make_unique<Watched>(rig, streaming);
  };
  rig.connection = std::make_unique<StickConnection>(rig.driver, open, 1'000'000);
  REQUIRE(becomes_true([&] { return streaming >= 0; }));
  CHECK(streaming == (allowed ? SCHED_FIFO : SCHED_OTHER));
  rig.unplug();
  opening = -1;
  REQUIRE(becomes_true([&] { return opening >= 0; }));
  CHECK(opening == SCHED_OTHER);
}
