// The keeper on its own thread and the real clock: whatever comes between, it serves the stick again, and never by itself
// drives it. Run it under the thread sanitizer.
#include "haptics/hardware/lever_keeper.h"

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

using namespace gearshift;
using glm::dvec2;
using Lines = std::vector<std::string>;

namespace {

constexpr const char* kName = "SideWinder Force Feedback 2 Joystick";

EmulatedStickConfig gripped() {
  EmulatedStickConfig config;
  config.lever.hand = kGripHand;
  return config;
}

// A stick that can be unplugged, and who keeps it open.
struct KeptStick {
  explicit KeptStick(const std::function<void()>& before_open = [] {})
      : stick(gripped(), hand), driver(stick.report_descriptor()), before(before_open) {}

  void keep() {
    keeper = std::make_unique<LeverKeeper>(
        driver,
        [this]() -> std::unique_ptr<HidPort> {
          before();
          if (!plugged) throw HidGone("the stick 045e:001b is not plugged in");
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
  Lines news() const {
    Lines all;
    while (const auto sentence = keeper->take_news()) all.push_back(*sentence);
    return all;
  }

  StillHand hand;
  EmulatedStick stick;
  std::mutex mutex;
  std::atomic<bool> plugged{true};
  PidDriver driver;
  std::function<void()> before;
  std::unique_ptr<LeverKeeper> keeper;
};

// Within five seconds, which nothing here should take.
bool comes(const std::function<bool()>& what) {
  for (int ms = 0; ms < 5000; ++ms) {
    if (what()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

}  // namespace

TEST_CASE("unplugged and plugged in again, 20 times while it drives: back each time, and silent until it is armed") {
  KeptStick kept;
  kept.keep();
  PidLever lever(calibration_of(gripped()), kept.driver, 0.001);
  bool armed = false;
  const auto cycle = [&] {  // of a loop that obeys
    if (lever.read(0).stop) armed = false;
    lever.write(armed ? dvec2{5.0, 0.0} : dvec2(0.0));
  };
  for (int time = 0; time < 20; ++time) {
    REQUIRE(comes([&] { return kept.keeper->connected(); }));
    for (int ms = 0; ms < 20; ++ms) {
      cycle();
      CHECK(kept.force() == dvec2(0.0));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    armed = true;
    REQUIRE(comes([&] {
      cycle();
      return glm::length(kept.force()) > 4.0;
    }));
    kept.unplug();
    CHECK(kept.force() == dvec2(0.0));
    REQUIRE(comes([&] {
      cycle();
      return !kept.keeper->connected();
    }));
    if (time % 2 == 0) cycle();
    kept.plugged = true;
  }
  REQUIRE(comes([&] { return kept.keeper->connected(); }));
  Lines expected;
  for (int time = 0; time < 20; ++time) {
    expected.push_back(std::string(kName) + " was unplugged: its motors are off");
    expected.push_back(std::string(kName) + " is back: its motors are off");
  }
  CHECK(kept.news() == expected);
  CHECK(kept.keeper->ability()->spring);
}

TEST_CASE("who leaves leaves it silent, in whatever moment") {
  for (const int ms : {0, 1, 3, 10, 60}) {
    KeptStick kept;
    kept.keep();
    PidLever lever(calibration_of(gripped()), kept.driver, 0.001);
    for (int i = 0; i < ms; ++i) {
      lever.read(0);
      lever.write({5.0, 0.0});
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    kept.keeper.reset();
    CHECK(kept.is_off());
    kept.keep();  // and the driver serves again
    CHECK(comes([&] { return kept.keeper->connected(); }));
  }
}

TEST_CASE("what keeps it from being opened is told once, and tried again: no exception leaves the thread") {
  std::atomic<int> tries{0};
  std::atomic<bool> works{false};
  KeptStick kept([&] {
    if (works) return;
    const int turn = tries++ % 4;
    if (turn == 0) throw HidError("the stick may not be used by this user");
    if (turn == 1) throw HidGone("the stick 045e:001b is not plugged in");
    if (turn == 2) throw std::runtime_error("out of everything");
    throw 7;  // NOLINT: whatever it is
  });
  kept.keep();
  REQUIRE(comes([&] { return tries > 5; }));
  works = true;
  REQUIRE(comes([&] { return kept.keeper->connected(); }));
  CHECK(kept.news() == Lines{"the stick may not be used by this user", "the stick 045e:001b is not plugged in",
                             "out of everything", "the stick cannot be used, for no reason that is known"});
}

TEST_CASE("a stick that refuses its effects, then takes them; that takes no outputs, then does") {
  KeptStick kept;
  kept.stick.faults.refuses_effects = true;
  kept.keep();
  Lines news;
  const auto told = [&](const std::string& part) {
    return comes([&] {
      for (const std::string& sentence : kept.news()) news.push_back(sentence);
      return !news.empty() && news.back().find(part) != std::string::npos;
    });
  };
  CHECK(told("the stick refuses a constant force: it says that there was an error"));
  CHECK_FALSE(kept.keeper->ability().has_value());
  {
    const std::lock_guard lock(kept.mutex);
    kept.stick.faults = {};
  }
  REQUIRE(comes([&] { return kept.keeper->connected(); }));

  PidLever lever(calibration_of(gripped()), kept.driver, 0.001);
  REQUIRE(comes([&] {
    lever.read(0);
    lever.write({5.0, 0.0});
    return glm::length(kept.force()) > 4.0;
  }));
  {
    const std::lock_guard lock(kept.mutex);
    kept.stick.faults.stalls_outputs = true;
  }
  CHECK(comes([&] { return !kept.keeper->connected(); }));
  {
    const std::lock_guard lock(kept.mutex);
    kept.stick.faults = {};
  }
  CHECK(told(std::string(kName) + " is back: its motors are off"));
  CHECK(kept.force() == dvec2(0.0));
  for (const std::string& sentence : news) CHECK(std::count(news.begin(), news.end(), sentence) == 1);
}

// A pipe that takes nothing costs 250 ms each time: whoever fails slowly works no longer for it.
TEST_CASE("what fails slowly is told once, too") {
  class Deaf final : public StickPort {
   public:
    using StickPort::StickPort;
    void send(const HidBytes&) override {
      std::this_thread::sleep_for(std::chrono::milliseconds(180));
      throw HidError("the stick did not answer");
    }
  };
  KeptStick kept;
  std::atomic<int> opened{0};
  kept.keeper = std::make_unique<LeverKeeper>(
      kept.driver,
      [&] {
        ++opened;
        return std::make_unique<Deaf>(kept.stick, kept.mutex, kept.plugged);
      },
      1'000'000);
  REQUIRE(comes([&] { return opened == 3; }));
  CHECK(kept.news() == Lines{"the stick did not answer"});
}

// Looking for an absent stick takes milliseconds, which a real-time thread would take from the loop.
TEST_CASE("its thread is real-time while it streams, where it may be, and not while it looks for the stick") {
  bool allowed = false;
  std::thread([&] { allowed = schedule_fifo(70).empty(); }).join();
  std::atomic<int> opening{-1}, streaming{-1};
  class Watched final : public StickPort {
   public:
    Watched(KeptStick& kept, std::atomic<int>& policy)
        : StickPort(kept.stick, kept.mutex, kept.plugged), policy_(policy) {}
    void stream(const StreamConfig& config, HidStream& stream) override {
      policy_ = sched_getscheduler(0) & ~SCHED_RESET_ON_FORK;
      StickPort::stream(config, stream);
    }

   private:
    std::atomic<int>& policy_;
  };
  KeptStick kept;
  const auto open = [&] {
    opening = sched_getscheduler(0) & ~SCHED_RESET_ON_FORK;
    if (!kept.plugged) throw HidGone("the stick is not plugged in");
    return std::make_unique<Watched>(kept, streaming);
  };
  kept.keeper = std::make_unique<LeverKeeper>(kept.driver, open, 1'000'000);
  REQUIRE(comes([&] { return streaming >= 0; }));
  CHECK(streaming == (allowed ? SCHED_FIFO : SCHED_OTHER));
  kept.unplug();
  opening = -1;
  REQUIRE(comes([&] { return opening >= 0; }));
  CHECK(opening == SCHED_OTHER);
}
