// The running lever on its own thread. Nothing here depends on how fast the machine is. Run it under the thread sanitizer.
#include <chrono>
#include <thread>

#include <doctest/doctest.h>

#include "tests/app/trainer/trainer_bench.h"

using namespace gearshift;

TEST_CASE("in real time, led through the paper's gate, the gears engage in order") {
  Trainer trainer(trainer_config(TrainerClock::real_time));
  trainer.arm();
  std::vector<int> gears;
  LeadingPerson person(trainer, [&] {
    sleep_ms(8);
    add_gears(trainer.take_events(), gears);
    (void)trainer.take_cycles();
    (void)trainer.health();
  });
  for (const int gear : kPaperTour) {
    CAPTURE(gear);
    person.shift_to(gear);
    CHECK(comes_true([&] { return trainer.snapshot().gear == gear; }));
  }
  add_gears(trainer.take_events(), gears);
  CHECK(gears == kPaperTour);
}

TEST_CASE("a frame that hangs for a second: the lever goes on, its wall holds, and no event is lost") {
  TrainerConfig config = trainer_config(TrainerClock::real_time);
  config.preset.haptics.rate = 4000.0;  // the fullest queues
  config.driver = touring_driver(paper_gate(), 1.0 / 4000.0);
  Trainer trainer(config);
  trainer.arm();
  REQUIRE(comes_true([&] { return trainer.snapshot().guard == GuardState::running; }));
  const HapticSnapshot before = trainer.snapshot();
  (void)trainer.take_cycles();
  sleep_ms(1000);
  const HapticSnapshot after = trainer.snapshot();
  const std::vector<DriveSample> cycles = trainer.take_cycles();
  CHECK(after.time_ns - before.time_ns > 500'000'000);
  CHECK(after.cycle > before.cycle + 100);
  REQUIRE(cycles.size() > 100);
  for (std::size_t i = 1; i < cycles.size(); ++i)
    CHECK(cycles[i].lever.cycle == cycles[i - 1].lever.cycle + 1);  // all of them
  CHECK(cycles.back().lever.cycle >= after.cycle);
  CHECK(trainer.health().events_lost == 0);
  // In control: it still obeys.
  trainer.stop();
  CHECK(comes_true([&] { return trainer.snapshot().guard == GuardState::released; }));
}

TEST_CASE("health on the real clock: lateness is there, ordered, and starts anew with each look") {
  Trainer trainer(trainer_config(TrainerClock::real_time));
  sleep_ms(200);
  const LoopHealth health = trainer.health();
  CHECK(health.late_worst > 0.0);
  CHECK(health.late_p50 <= health.late_p99);
  CHECK(health.late_p99 <= 1.02 * health.late_worst);   // the histogram tells at most 1/64 too much
  CHECK((health.realtime || !health.why_not.empty()));  // it may be real-time and yet have to tell of its memory
  const LoopHealth at_once = trainer.health();
  CHECK(at_once.late_p50 <= at_once.late_worst * 1.02);
}

TEST_CASE("it ends in any state, at once") {
  for (int i = 0; i < 3; ++i) {
    Trainer trainer(trainer_config(TrainerClock::real_time));
    if (i > 0) trainer.arm();
    if (i > 1) trainer.stop();
  }
  CHECK_THROWS_AS(Trainer(trainer_config(TrainerClock::real_time)).advance(0.1), std::logic_error);
}
