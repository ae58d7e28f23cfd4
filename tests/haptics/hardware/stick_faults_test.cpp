// Tests of faults while the user holds the lever: how soon the motors are off, and what switches them on again.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <random>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/files/number_text.h"
#include "haptics/loop/shift_script.h"
#include "tests/haptics/device/still_hand.h"
#include "tests/haptics/hardware/stick_loop.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using glm::dvec2;

namespace {

constexpr double kSilent = 0.1;  // [N] force at the knob that is too small to feel

EmulatedStickConfig gripped(StickFamily family) {
  EmulatedStickConfig config;
  config.family = family;
  config.lever.hand = kGripHand;
  return config;
}

// A fault that is injected while the user presses the lever into a wall, and how time passes after the injection.
struct Fault {
  const char* name;
  std::function<void(StickLoop&)> inject;
  std::function<void(StickLoop&)> run_millisecond;  // runs one millisecond
  double max_time;                                  // [s] maximum time until the motors are off
  bool own_power = false;
};

void run_cycle(StickLoop& run) {
  run.cycle();
}

const std::vector<Fault>& faults() {
  static const std::vector<Fault> all{
      {"stop button on the stick", [](StickLoop& run) { run.stick.held_buttons = 0b100; }, run_cycle, 0.005},
      {"stop in the program", [](StickLoop& run) { run.inputs.commands.push(LoopCommand::stop); }, run_cycle, 0.005},
      {"release()", [](StickLoop& run) { run.lever.release(); }, [](StickLoop& run) { run.tick(); }, 0.002},
      {"unplugged", [](StickLoop& run) { run.stick.unplug(); },
       [](StickLoop& run) { run.loop.cycle(run.now_ns += 1'000'000, 0); }, 0.0},
      {"unplugged, its motors fed from the wall", [](StickLoop& run) { run.stick.unplug(); },
       [](StickLoop& run) {
         run.stick.advance(run.now_ns += 1'000'000);
         run.loop.cycle(run.now_ns, 0);
       },
       0.301, true},
      {"no readings", [](StickLoop& run) { run.stick.faults.silent = true; }, run_cycle, 0.060},
      {"sensor stuck, in whatever place", [](StickLoop& run) { run.stick.faults.stuck = true; }, run_cycle, 3.100},
      {"loop too late, every cycle", [](StickLoop&) {},
       [](StickLoop& run) {
         run.tick();
         run.loop.cycle(run.now_ns, 1);
       },
       0.040},
      {"loop dead, USB thread alive", [](StickLoop&) {}, [](StickLoop& run) { run.tick(); }, 0.110},
      {"program dead", [](StickLoop&) {}, [](StickLoop& run) { run.stick.advance(run.now_ns += 1'000'000); }, 0.301},
  };
  return all;
}

double time_to_silence(StickFamily family, const Fault& fault, double before) {
  StillHand hand(hand_at({0.0, 0.0}));
  EmulatedStickConfig config = gripped(family);
  config.own_power = fault.own_power;
  StickLoop run(config, hand);
  run.loop.arm();
  run.cycle_for(0.8);
  hand.target = hand_at({0.012, 0.020});  // a point inside the neutral aisle's wall
  run.cycle_for(before);
  REQUIRE(glm::length(run.stick.force()) > 3.0);
  const std::int64_t begin = run.now_ns;
  std::int64_t loud = begin;
  fault.inject(run);
  for (int ms = 0; ms < 1000 * fault.max_time + 300; ++ms) {
    if (glm::length(run.stick.force()) > kSilent) loud = run.now_ns + 1'000'000;
    if (ms > 240 && run.stick.faults.silent) break;  // after this time the port itself reports the silence
    fault.run_millisecond(run);
  }
  if (fault.max_time < 0.2) CHECK_FALSE(run.stick.actuators_on());  // these faults also disable the motors
  return 1e-9 * static_cast<double>(loud - begin);
}

// A pause of the whole process for `ms`. Afterwards the loop's thread or the USB thread runs first.
struct Stall {
  std::int64_t ms = 0;
  bool loop_first = false;
};

void stop_process(StickLoop& run, const Stall& stall) {
  run.stick.advance(run.now_ns += 1'000'000 * stall.ms);
}

void resume_process(StickLoop& run, const Stall& stall) {
  run.now_ns += run.period_ns;
  if (!stall.loop_first) tick_stick(run.stick, run.stream, run.driver, run.now_ns);
  run.loop.cycle(run.now_ns, stall.ms);
}

// Calls `work` for each stick family, each length of the pause and each order in which the threads resume.
template <class Work>
void on_each_stall(std::initializer_list<std::int64_t> lengths, const Work& work) {
  for (const StickFamily family : kStickFamilies) {
    for (const std::int64_t ms : lengths) {
      for (const bool loop_first : {false, true}) {
        CAPTURE(name_of(family));
        CAPTURE(ms);
        CAPTURE(loop_first);
        StillHand hand(hand_at({0.0, 0.0}));
        StickLoop run(gripped(family), hand);
        run.loop.arm();
        run.cycle_for(0.8);
        work(run, hand, Stall{ms, loop_first});
      }
    }
  }
}

}  // namespace

TEST_CASE("from a fault to silent motors within the stated time, whenever it happens") {
  std::mt19937 chance(3);
  std::string table = "\nfault | median ms | worst ms\n";
  for (const Fault& fault : faults()) {
    std::vector<double> times;
    for (const StickFamily family : kStickFamilies) {
      for (int i = 0; i < 8; ++i) {
        times.push_back(time_to_silence(family, fault, 0.5 + 1e-3 * static_cast<double>(chance() % 200)));
      }
    }
    std::sort(times.begin(), times.end());
    CAPTURE(std::string(fault.name));
    CHECK(times.back() <= fault.max_time);
    table += std::string(fault.name) + " | " + number_text(1e3 * times[times.size() / 2], 0) + " | " +
             number_text(1e3 * times.back(), 0) + '\n';
  }
  MESSAGE(table);
}

TEST_CASE("the process is stopped and resumed, whichever thread wakes first: no force until a person arms it") {
  on_each_stall({150, 400, 3000}, [](StickLoop& run, StillHand& hand, const Stall& stall) {
    hand.target = hand_at({0.012, 0.020});
    run.cycle_for(0.5);
    REQUIRE(glm::length(run.stick.force()) > 3.0);
    stop_process(run, stall);
    const bool has_ended = stall.ms > 300;  // the device's effects last 300 ms
    if (has_ended) CHECK(glm::length(run.stick.force()) < kSilent);
    resume_process(run, stall);
    for (int i = 0; i < 1000; ++i) {
      run.cycle();
      if (i > 4 || has_ended) CHECK(glm::length(run.stick.force()) < kSilent);
    }
    CHECK(run.loop.snapshot().guard == GuardState::released);
    CHECK_FALSE(run.stick.actuators_on());
    run.loop.arm();
    run.cycle_for(0.6);
    CHECK(run.loop.snapshot().guard == GuardState::running);
  });
}

TEST_CASE("a stop of up to 0.1 s does not interrupt the forces, whichever thread wakes first") {
  on_each_stall({15, 25, 60, 95}, [](StickLoop& run, StillHand&, const Stall& stall) {
    stop_process(run, stall);
    resume_process(run, stall);
    run.cycle_for(0.2);
    CHECK(run.loop.snapshot().guard == GuardState::running);
    CHECK(run.problems().empty());
  });
}

TEST_CASE("unplugged at any moment of a tour: silent until a person arms it again, and then the tour continues") {
  for (const StickFamily family : kStickFamilies) {
    CAPTURE(name_of(family));
    std::mt19937 chance(11);
    const EmulatedStickConfig config = gripped(family);
    const Gate gate = stick_gate("six_speed_r_left_up", config);
    const dvec2 start = rest_position(gate, kNeutralGear);
    ScriptedHandConfig script = touring_hand(start);
    script.effort_limit = 8.0;
    ScriptedHand hand(script, shift_strokes(gate, start, tour_order(gate)), 0.001);
    StickLoop run(config, calibration_of(config), HapticConfig{}, gate, hand);
    run.loop.arm();
    for (int time = 0; time < 5; ++time) {
      run.cycle_for(0.6 + 1e-3 * static_cast<double>(chance() % 1000));
      CHECK(run.loop.snapshot().guard == GuardState::running);
      run.stick.unplug();
      CHECK(run.stick.force() == dvec2(0.0));
      for (int ms = 0; ms < 300; ++ms) {  // the loop continues without the stick
        run.stick.advance(run.now_ns += 1'000'000);
        run.loop.cycle(run.now_ns, 0);
      }
      CHECK(run.loop.snapshot().guard == GuardState::damped);
      run.prepare();
      for (int ms = 0; ms < 300; ++ms) {
        run.cycle();
        CHECK(run.stick.force() == dvec2(0.0));
        CHECK_FALSE(run.stick.actuators_on());
      }
      CHECK(run.loop.snapshot().guard == GuardState::released);
      run.loop.arm();
      run.cycle_for(0.6);
      CHECK(run.loop.snapshot().guard == GuardState::running);
      CHECK(run.stick.actuators_on());
    }
    CHECK(run.problems().empty());
  }
}

TEST_CASE("armed while unplugged: must be armed again after the reconnect") {
  StillHand hand(hand_at({0.0, 0.012}));
  StickLoop run(gripped(StickFamily::vjoy), hand);
  run.loop.arm();
  run.cycle_for(0.8);
  run.stick.unplug();
  for (int ms = 0; ms < 100; ++ms) run.loop.cycle(run.now_ns += 1'000'000, 0);
  run.loop.arm();
  for (int ms = 0; ms < 100; ++ms) run.loop.cycle(run.now_ns += 1'000'000, 0);
  run.prepare();
  run.cycle_for(0.3);
  CHECK(run.loop.snapshot().guard == GuardState::released);
  CHECK_FALSE(run.stick.actuators_on());
}

TEST_CASE("a loop that stopped and resumed: silent until armed") {
  StillHand hand(hand_at({0.012, 0.020}));
  StickLoop run(gripped(StickFamily::openffboard), hand);
  run.loop.arm();
  run.cycle_for(1.0);
  for (int ms = 0; ms < 150; ++ms) run.tick();
  CHECK(run.stick.force() == dvec2(0.0));
  for (int ms = 0; ms < 300; ++ms) {
    run.cycle();
    CHECK_FALSE(run.stick.actuators_on());
  }
  CHECK(run.loop.snapshot().guard == GuardState::released);
}

TEST_CASE("a faulty stick in a hand: jumps do not move it, and useless readings end in silence") {
  for (const StickFamily family : kStickFamilies) {
    CAPTURE(name_of(family));
    for (const bool jumps : {true, false}) {
      StillHand hand;
      StickLoop run(gripped(family), hand);
      run.loop.arm();
      run.cycle_for(0.8);
      hand.target = hand_at({0.012, 0.020});
      run.cycle_for(0.5);
      // Largest force within 0.2 s [N]. A single sample would miss the kicks from wall damping and coarse counts.
      const auto strongest = [&run] {
        double force = 0.0;
        for (int ms = 0; ms < 200; ++ms) {
          run.cycle();
          force = std::max(force, glm::length(run.stick.force()));
        }
        return force;
      };
      const double before = strongest();
      run.stick.faults.jump = jumps;
      run.stick.faults.wrong_length = !jumps;
      CHECK(strongest() < before + 2.0);
      CHECK(run.loop.snapshot().guard == (jumps ? GuardState::running : GuardState::damped));
      if (!jumps) CHECK(run.stick.force() == dvec2(0.0));
      CHECK(run.problems().size() == 1);
    }
  }
}

// A hand without tremor is the hardest case. While it leans on a wall, the position may stay at the same count for
// seconds (one count is 137 um on one stick). Until the count changes, the driver fades the wall's force.
TEST_CASE("leaning on a wall for half a minute is not mistaken for a dead sensor, and the fading is hardly felt") {
  for (const StickFamily family : kStickFamilies) {
    CAPTURE(name_of(family));
    StillHand hand;
    StickLoop run(gripped(family), hand);
    run.loop.arm();
    run.cycle_for(0.7);
    hand.target = hand_at({0.012, 0.020});  // a point inside the neutral aisle's wall
    run.cycle_for(1.5);
    double min_force = 1e9, sum = 0.0;
    for (int ms = 0; ms < 30'000; ++ms) {
      run.cycle();
      min_force = std::min(min_force, glm::length(run.stick.force()));
      sum += glm::length(run.stick.force());
    }
    MESSAGE(name_of(family), ": at least ", min_force, " N of ", sum / 30'000);
    CHECK(run.loop.snapshot().guard == GuardState::running);
    CHECK(run.problems().empty());
    CHECK(min_force > 0.75 * sum / 30'000);
  }
}

// A wall that is stable on a fast device can vibrate on a slow one, so the device's delay must be known.
TEST_CASE("a stick that is 3 ms late: quiet on the wall with its own calibration, not with that of a faster stick") {
  const auto shaking = [](double claimed) {
    EmulatedStickConfig config = gripped(StickFamily::openffboard);
    config.lever.hand = {};
    config.delay = 0.003;
    DeviceCalibration known = calibration_of(config);
    for (LeverAxisCalibration* axis : {&known.select, &known.shift}) axis->spring_sign = axis->damper_sign = 0;
    known.timing.delay = claimed;
    if (claimed == 0.0) known.timing.input_interval = known.timing.output_interval = 0.0005;
    StillHand hand;
    StickLoop run(config, known, HapticConfig{}, stick_gate("six_speed_r_left_up", config), hand);
    run.loop.arm();
    run.cycle_for(0.7);
    hand.target = hand_pushing({0.0, 6.0});  // pushes forward into the end of the slot
    run.cycle_for(0.4);
    double low = 1.0, high = -1.0;
    for (int ms = 0; ms < 100; ++ms) {
      run.cycle();
      low = std::min(low, run.stick.position().y);
      high = std::max(high, run.stick.position().y);
    }
    return high - low;
  };
  const double honest = shaking(0.003), boasting = shaking(0.0);
  MESSAGE("peak to peak at the wall: ", 1e3 * honest, " mm, and ", 1e3 * boasting, " mm with an unknown delay");
  CHECK(honest < 1e-4);
  CHECK(boasting > 1e-3);
}

// A force comes back by a person only: whatever ended the forces, and although its cause is gone.
TEST_CASE("no power, an open switch or a replugged stick: one sentence, and no force until a person arms it again") {
  struct Cause {
    const char* name;
    bool from_start;
    std::function<void(StickLoop&)> begin, end;
    const char* sentence;    // "": the connection says it
    double patience = 15.0;  // [s] until the cause ends
  };
  const auto power = [](bool lost) { return [lost](StickLoop& run) { run.stick.faults.no_power = lost; }; };
  const auto opening = [](bool open) { return [open](StickLoop& run) { run.stick.faults.open_switch = open; }; };
  const auto unplug = [](StickLoop& run) { run.stick.unplug(); };
  const auto replug = [](StickLoop& run) { run.prepare(); };
  const auto disable = [](StickLoop& run) { run.stick.output(std::vector<std::uint8_t>{0x0c, 0x02}); };
  const auto nothing = [](StickLoop&) {};
  const char* const no_power =
      "the stick reported that its motors have no power, so they are off; check its power supply, "
      "then turn them on again";
  const char* const open_switch =
      "the stick reported that its safety switch is open, so its motors are off; close the "
      "switch, then turn them on again";
  const Cause causes[] = {
      {"no power from the start", true, power(true), power(false), no_power},
      {"open switch from the start", true, opening(true), opening(false), open_switch},
      {"power back before it was noticed", true, power(true), power(false), no_power, 0.0},
      {"switch closed before it was noticed", true, opening(true), opening(false), open_switch, 0.0},
      {"power lost", false, power(true), power(false), no_power},
      {"switch opened", false, opening(true), opening(false), open_switch},
      {"switched off by itself", false, disable, nothing,
       "the stick switched its motors off by itself; they stay off until you turn them on again"},
      {"replugged", false, unplug, replug, ""},
  };
  std::string table = "cause | family | off after s | force without a person N | armed again N\n";
  for (const Cause& cause : causes) {
    for (const StickFamily family : {StickFamily::sidewinder, StickFamily::openffboard}) {
      CAPTURE(std::string(cause.name));
      CAPTURE(name_of(family));
      const EmulatedStickConfig config = gripped(family);
      const Gate gate = stick_gate("six_speed_r_left_up", config);
      StillHand hand(hand_at({0.012, 0.0}));
      StickLoop run(config, calibration_of(config), HapticConfig{}, gate, hand);
      if (cause.from_start) {
        run.stick.unplug();
        cause.begin(run);
        run.stick.advance(run.now_ns += 10'000'000);
        run.prepare();
      }
      run.cycle_for(0.1);
      // The hand presses into the wall again and again, as a person does who feels none.
      const auto cycle = [&] {
        hand.target = hand_at({0.012, std::fmod(run.time(), 0.8) < 0.4 ? 0.020 : 0.0});
        run.cycle();
      };
      const auto strongest = [&](double seconds) {
        double force = 0.0;
        for (const double end = run.time() + seconds; run.time() < end;) {
          cycle();
          force = std::max(force, glm::length(run.stick.force()));
        }
        return force;
      };
      run.loop.arm();
      if (!cause.from_start) {
        REQUIRE(strongest(1.5) > 3.0);
        cause.begin(run);
      }
      const double begin = run.time();
      const auto is_off = [&] {
        return !run.stick.actuators_on() && run.loop.snapshot().guard != GuardState::armed &&
               run.loop.snapshot().guard != GuardState::ramping;
      };
      if (*cause.sentence != '\0') strongest(0.001);
      while (run.time() < begin + cause.patience && !is_off() && *cause.sentence != '\0') cycle();
      const double off_after = run.time() - begin;
      strongest(0.05);
      CHECK((off_after < 15.0 || cause.patience == 0.0));
      if (cause.patience == 0.0) {
        strongest(0.2);
        cause.end(run);
      }
      double alone = cause.patience == 0.0 ? strongest(0.05) : 0.0;
      const std::vector<std::string> problems = run.problems();
      if (*cause.sentence != '\0') CHECK(problems == std::vector<std::string>{cause.sentence});
      if (cause.patience > 0.0) cause.end(run);
      alone = std::max(alone, strongest(3.0));
      CHECK(alone == 0.0);
      CHECK_FALSE(run.stick.actuators_on());
      run.loop.arm();
      const double armed = strongest(1.5);
      CHECK(armed > 3.0);
      table += std::string(cause.name) + " | " + name_of(family) + " | " + number_text(off_after, 3) + " | " +
               number_text(alone, 1) + " | " + number_text(armed, 1) + '\n';
    }
  }
  MESSAGE(table);
}

// From the motion alone, a stick without power is the same as a hand that is stronger than the stick.
TEST_CASE("a stick that reports no state and has no power: a person who feels no wall is asked to check its power") {
  std::string table = "family | power | sentence after s\n";
  for (const StickFamily family : kStickFamilies) {
    for (const double lost_after : {0.0, 2.0, 1e9}) {  // [s] the last one never
      CAPTURE(name_of(family));
      CAPTURE(lost_after);
      EmulatedStickConfig config = gripped(family);
      config.habits.state_sent = StateSent::never;
      StillHand hand(hand_at({0.012, 0.0}));
      StickLoop run(config, hand);
      run.loop.arm();
      double said_after = -1.0;
      while (run.time() < 8.0 && said_after < 0.0) {
        run.stick.faults.no_power = run.time() >= lost_after;
        hand.target = hand_at({0.012, std::fmod(run.time(), 0.8) < 0.4 ? 0.020 : 0.0});
        run.cycle();
        for (const std::string& problem : run.problems()) {
          CAPTURE(problem);
          const bool is_asked = problem.starts_with("the lever moved by ") &&
                                problem.ends_with(
                                    "mm against the stick's full force; if you felt no force, check the "
                                    "stick's power supply and its safety switch");
          // Before its forces were ever seen, an axis may rest for so long that it looks like a stuck sensor first.
          const bool looks_stuck = problem.starts_with("the stick's position has not changed") &&
                                   problem.ends_with("check the stick's power supply and its safety switch");
          CHECK((is_asked || (looks_stuck && family == StickFamily::sidewinder)));
          said_after = run.time() - lost_after;
        }
      }
      CHECK((said_after >= 0.0) == (lost_after < 8.0));
      table += name_of(family) + " | " + (lost_after > 8.0 ? "always" : "until " + number_text(lost_after, 0) + " s") +
               " | " + number_text(said_after, 2) + '\n';
    }
  }
  MESSAGE(table);
}
