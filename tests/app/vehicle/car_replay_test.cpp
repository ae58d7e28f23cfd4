// Records a drive with a car connected to the lever, and replays it. The replay uses only the recorded inputs and the
// load's replay parameters.
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "haptics/files/file_error.h"
#include "haptics/loop/replay.h"
#include "haptics/loop/trace_recorder.h"
#include "tests/app/vehicle/car_run.h"
#include "tests/support/short_trace.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

// The clutch is pressed most of the time. From 5 s to 8 s it stays up, so one shift lacks the clutch, and the engine
// stalls. At 8 s the clutch is pressed and the engine is restarted. The slope varies all the time.
DriverControls busy_feet(double time) {
  DriverControls feet = std::fmod(time, 1.1) < 0.9 ? clutch_down() : clutch_up(0.37);
  if (time > 5.0) feet = clutch_up();
  feet.slope = 0.031 * std::sin(time);
  feet.pedals.brake = time > 6.0 ? 0.9 : 0.0;
  feet.starter = time > 8.0;
  if (time > 8.0) feet.pedals.clutch = 1.0;
  return feet;
}

Trace recorded(const CarSpec& car, std::uint64_t seed = 5) {
  const TempFolder folder;
  const Gate gate = gate_of(car);
  ScriptedHand hand = shifting_hand(gate, 2, {3, 4, 3, 2, 1, kNeutralGear, 2});
  CarRun run(car, rolling_in(car, 2, 231.7), hand, busy_feet, seed);
  const GateLayout layout = read_gate_layout(GEARSHIFT_ASSETS "/gates/" + car.gate + ".toml");
  const SimulatedRunConfig config = gripped(gate, 2);
  const TraceHeader header{
      "test", config.haptics, run.run.lever().spec(), layout.file, layout.text, run.load.replay_parameters(), true};
  TraceRecorder recorder(folder / "car.trace", header);
  for (int i = 0; i < 9000; ++i) {
    run.step();
    recorder.add(run.run.loop().published());
  }
  recorder.finish();
  return read_trace(folder / "car.trace");
}

std::string refusal(const Trace& trace) {
  try {
    replay(trace, make_car_load);
  } catch (const FileError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("a drive replays bit for bit from the load's replay parameters, which contain the complete car: both cars") {
  for (const char* name : {"hatchback", "diesel"}) {
    CAPTURE(name);
    const Trace trace = recorded(shipped_car(name));
    const ReplayResult result = replay(trace, make_car_load);
    CHECK(result.bit_for_bit());
    CHECK(result.cycles == 9000);
    bool rolled = false;
    for (const TraceSample& sample : trace.samples) rolled = rolled || sample.out.road_speed > 3.0;
    CHECK(rolled);
    CHECK(recorded(shipped_car(name)).hash == trace.hash);
  }
}

TEST_CASE("a drive does not replay with a different seed, device force, car or start") {
  const Trace trace = recorded(shipped_car("hatchback"));
  const auto changed = [&](const std::string& from, const std::string& to) {
    Trace other = trace;
    const std::size_t at = other.header.load.find(from);
    REQUIRE(at != std::string::npos);
    other.header.load.replace(at, from.size(), to);
    const ReplayResult result = replay(other, make_car_load);
    return result.first.has_value();
  };
  CHECK(changed("car-3 31.7 5 ", "car-3 31.7 6 "));
  CHECK(changed("car-3 31.7 5 ", "car-3 31.6 5 "));
  CHECK(changed("mass_kg = 1373.4", "mass_kg = 1373.5"));
  CHECK(changed("friction = 0.10", "friction = 0.101"));
  const CarSpec car = shipped_car("hatchback");
  const CarLoad faster(car, gate_of(car), kPaperForce, rolling_in(car, 2, 231.8), 5);
  CHECK(changed(trace.header.load, faster.replay_parameters()));
}

TEST_CASE("a load's name gives the same load; without a car name there is none, and a bad car is rejected") {
  const CarSpec car = shipped_car("hatchback");
  const Gate gate = gate_of(car);
  CarStart start = rolling_in(car, 3, 123.456);
  start.distance = 1e6 / 3.0;
  const CarLoad load(car, gate, 31.7, start, 1234567890123456789u);
  const std::unique_ptr<LeverLoad> again = make_car_load(load.replay_parameters(), gate);
  REQUIRE(again);
  CHECK(std::string(again->replay_parameters()) == load.replay_parameters());
  for (const char* name :
       {"none", "", "car-3", "car-3 31.7 1", "car-3 31.7 1 0 0 1 0 0 0 0", "car-3 nan 1 0 0 1 0 0 0 0 0 0 0 40\nx\n"})
    CHECK(make_car_load(name, gate) == nullptr);

  for (const auto& [running, stalled] : {std::pair(true, false), std::pair(false, true), std::pair(false, false)}) {
    CarStart parked;
    parked.running = running;
    parked.stalled = stalled;
    const CarLoad engine(car, gate, 31.7, parked);
    const std::unique_ptr<CarLoad> same = make_car_load(engine.replay_parameters(), gate);
    REQUIRE(same);
    CHECK(same->state().running == running);
    CHECK(same->state().stalled == stalled);
    LeverInput in;
    in.controls.ignition = true;
    same->step(in, 0.001);
    CHECK(same->state().stalled == stalled);  // a stall stays reported while the ignition is on
    CHECK(start_from(same->state()).stalled == stalled);
  }

  Trace trace = recorded(car);
  trace.header.load.replace(trace.header.load.find("ratio_2 = 1.94"), 14, "ratio_2 = 9.94");
  CHECK(refusal(trace).find("cannot be replayed, because its car or lesson is invalid: hatchback.toml:") !=
        std::string::npos);
  CHECK(refusal(trace).find("must be less than ratio_1") != std::string::npos);
  for (const char* old : {"car 31.7 5 0 0 1 83.8 83.8 0 0", "car-2 31.7 5 0 0 1 83.8 83.8 0 0 0 0 0 40"}) {
    trace.header.load = old + ("\nhatchback.toml\n" + car.text);
    CHECK(refusal(trace).find("an earlier version recorded it, whose car drives differently") != std::string::npos);
  }
  trace.header.load = "a \x1b[31mship\nof wood";
  CHECK(refusal(trace).find("the lever load \"a ?[31mship\" is not known to this program") != std::string::npos);
}
